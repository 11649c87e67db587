#include "lib/integrate/moment_sums.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "lib/base/compiler.hpp"
#include "lib/base/memory.hpp"
#include "lib/base/threads.hpp"
#include "lib/scene/variant.hpp"

namespace powercell {
namespace {

constexpr std::size_t least_shared = 4096;  // ranks; fewer are faster on one thread
constexpr std::size_t ahead = 16;           // ranks between a prefetch and its use

cl::Kernel gather_kernel(const std::shared_ptr<cl::Context>& context, const DomainBuffers& domain) {
  Variant variant;
  variant.dimension = domain.mesh().dimension;
  variant.cell_dimension = variant.dimension;  // which does not matter: one program for both
  variant.float32 = domain.float32();
  variant.capacity = {1, 1};
  return {context, context->program("integrate/gather.cl", variant.defines()), "gather"};
}

/// Value `k` of an array in the device's precision.
double real_at(const std::byte* reals, std::size_t k, bool float32) {
  if (!float32) {
    double value;
    std::memcpy(&value, reals + k * sizeof value, sizeof value);
    return value;
  }
  float value;
  std::memcpy(&value, reals + k * sizeof value, sizeof value);
  return value;
}

}  // namespace

void clear_cell(Measures& measures, std::size_t i) {
  const auto d = static_cast<std::size_t>(measures.dimension);
  measures.mass[i] = measures.second_moment[i] = 0;
  std::fill_n(&measures.centroid[i * d], d, std::numeric_limits<double>::quiet_NaN());
  measures.status[i] = SeedStatus::hidden;
}

MomentSums::MomentSums(const DomainBuffers& domain, const SeedSet& seeds, double domain_measure, int threads)
    : domain_(domain),
      seeds_(seeds),
      threads_(threads),
      columns_(2 + static_cast<std::size_t>(domain.mesh().dimension)),
      row_bytes_(columns_ * (domain.float32() ? sizeof(float) : sizeof(double))) {
  const std::size_t n = seeds.input_count;
  measures_.dimension = domain.mesh().dimension;
  measures_.domain_measure = domain_measure;
  resize_populated(measures_.mass, n, threads);
  resize_populated(measures_.centroid, n * static_cast<std::size_t>(measures_.dimension), threads,
                   std::numeric_limits<double>::quiet_NaN());
  resize_populated(measures_.second_moment, n, threads);
  resize_populated(measures_.status, n, threads, SeedStatus::hidden);
  for (const std::uint32_t i : seeds.duplicate) measures_.status[i] = SeedStatus::duplicate;
}

bool MomentSums::one_pair_per_rank(const std::vector<std::uint64_t>& pair_offset, std::uint64_t begin,
                                   std::uint64_t end, std::uint32_t first, std::uint32_t last) {
  if (end - begin != std::uint64_t{last} - first + 1 || pair_offset[last + 1] != end) return false;
  for (std::uint32_t rank = first; rank <= last; ++rank)
    if (pair_offset[rank] != begin + (rank - first)) return false;
  return true;
}

const cl::RawBuffer& MomentSums::sum_on_device(const std::vector<std::uint64_t>& pair_offset,
                                               std::uint64_t begin, std::uint64_t end, std::uint32_t first,
                                               std::uint32_t last, const cl::RawBuffer& moments) {
  Summing& device = summing_.try_emplace(moments.context().get(), moments.context()).first->second;
  const std::size_t count = std::size_t{last} - first + 1;
  chunk_offset_.resize(count + 1);
  chunk_offset_[0] = 0;
  for (std::size_t t = 0; t < count; ++t)
    chunk_offset_[t + 1] = static_cast<std::uint32_t>(std::min(pair_offset[first + t + 1], end) - begin);
  device.offset.upload(chunk_offset_);
  const bool goes_on = pair_offset[first] < begin;
  device.before.reserve(row_bytes_);
  if (goes_on) device.before.write(open_.data(), row_bytes_);
  device.sums.reserve(count * row_bytes_);
  if (!device.gather) device.gather.emplace(gather_kernel(moments.context(), domain_));
  device.gather
      ->args(static_cast<cl_uint>(count), device.offset, static_cast<cl_int>(goes_on), device.before, moments,
             device.sums)
      .launch(count);
  return device.sums;
}

void MomentSums::set(std::uint32_t rank, std::span<const double> moments) {
  const auto d = static_cast<std::size_t>(measures_.dimension);
  const double scale = domain_.frame().scale, unit = domain_.frame().unit(1);
  // One factor at a time: a power of a long domain's size may overflow although its measure does not.
  const auto unscaled = [&](double integral, int power) {
    for (; power > 0; --power) integral *= unit;
    return integral;
  };
  const int power = domain_.mesh().cell_dimension;
  const double mass = moments[0];
  if (!(mass > 0)) return;
  const std::size_t i = seeds_.input[rank];
  measures_.status[i] = SeedStatus::ok;
  measures_.mass[i] =
      std::max(unscaled(mass, power), std::numeric_limits<double>::min());  // a cell that is not empty
  for (std::size_t c = 0; c < d; ++c)
    measures_.centroid[i * d + c] = seeds_.positions[rank * d + c] + moments[1 + c] / mass / scale;
  measures_.second_moment[i] = unscaled(moments[1 + d], power + 2);
}

const std::byte* MomentSums::sum_on_host(const std::vector<std::uint64_t>& pair_offset, std::uint64_t begin,
                                         std::uint64_t end, std::uint32_t first, std::uint32_t last,
                                         const std::byte* moments) {
  const std::size_t count = std::size_t{last} - first + 1;
  const bool goes_on = pair_offset[first] < begin;
  host_sums_.assign(count * row_bytes_, std::byte{0});
  if (goes_on) std::copy(open_.begin(), open_.end(), host_sums_.begin());
  // In the order of the pairs, as the kernel does (kernels/integrate/gather.cl).
  const auto sum = [&]<class Real>(const Real* rows, Real* sums) {
    parallel_for(threads_for(end - begin, threads_, least_shared), count,
                 [&](std::size_t from, std::size_t to) {
                   for (std::size_t t = from; t < to; ++t)
                     for (std::uint64_t pair = std::max(begin, pair_offset[first + t]);
                          pair < std::min(end, pair_offset[first + t + 1]); ++pair)
                       for (std::size_t c = 0; c < columns_; ++c)
                         sums[t * columns_ + c] += rows[(pair - begin) * columns_ + c];
                 });
  };
  std::byte* const to = host_sums_.data();
  domain_.float32() ? sum(reinterpret_cast<const float*>(moments), reinterpret_cast<float*>(to))
                    : sum(reinterpret_cast<const double*>(moments), reinterpret_cast<double*>(to));
  return to;
}

std::array<double, 5> MomentSums::row_at(const std::byte* row) const {
  std::array<double, 5> moments{};
  for (std::size_t c = 0; c < columns_; ++c) moments[c] = real_at(row, c, domain_.float32());
  return moments;
}

void MomentSums::set_measures(std::uint32_t first, std::uint32_t last, const std::byte* sums) {
  const auto d = static_cast<std::size_t>(measures_.dimension);
  parallel_for(threads_for(last - first, threads_, least_shared), last - first,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t t = begin; t < end; ++t) {
                   if (t + ahead < end) {
                     const std::size_t next = seeds_.input[first + t + ahead];
                     prefetch(&measures_.status[next]);
                     prefetch(&measures_.mass[next]);
                     prefetch(&measures_.centroid[next * d]);
                     prefetch(&measures_.second_moment[next]);
                   }
                   set(static_cast<std::uint32_t>(first + t), row_at(sums + t * row_bytes_));
                 }
               });
}

void MomentSums::replace(std::span<const std::uint32_t> ranks, const PairMoments& moments) {
  std::optional<cl::Mapping> mapping;
  if (!moments.on_host) mapping.emplace(moments.on_device(), ranks.size() * row_bytes_);
  const std::byte* const sums = moments.on_host ? moments.on_host : mapping->data();
  for (std::size_t k = 0; k < ranks.size(); ++k) {
    clear_cell(measures_, seeds_.input[ranks[k]]);
    set(ranks[k], row_at(sums + k * row_bytes_));
  }
  if (mapping) mapping->end();
}

void MomentSums::add(const std::vector<std::uint64_t>& pair_offset, std::uint64_t begin, std::uint64_t end,
                     std::uint32_t first, std::uint32_t last, const PairMoments& moments) {
  const bool summed = one_pair_per_rank(pair_offset, begin, end, first, last);
  const std::size_t ranks = std::size_t{last} - first + 1;
  const bool open = pair_offset[last + 1] > end;
  if (moments.on_host) {
    const std::byte* const sums =
        summed ? moments.on_host : sum_on_host(pair_offset, begin, end, first, last, moments.on_host);
    set_measures(first, open ? last : last + 1, sums);
    if (open) open_.assign(sums + (ranks - 1) * row_bytes_, sums + ranks * row_bytes_);
    return;
  }
  const cl::RawBuffer& on_device = moments.on_device();
  cl::Mapping sums(summed ? on_device : sum_on_device(pair_offset, begin, end, first, last, on_device),
                   ranks * row_bytes_);
  set_measures(first, open ? last : last + 1, sums.data());
  // Keep the row of the previous chunk until the map has ended: if that fails the chunk is repeated.
  std::vector<std::byte> row;
  if (open) row.assign(sums.data() + (ranks - 1) * row_bytes_, sums.data() + ranks * row_bytes_);
  sums.end();
  if (open) open_ = std::move(row);
}

}  // namespace powercell
