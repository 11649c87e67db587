#include "lib/clip/row_reader.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace powercell {
namespace {

/// Up to this many entries, used or not, are read unpacked.
constexpr std::size_t few_entries = std::size_t{1} << 16;

}  // namespace

RowReader::Packer::Packer(const std::shared_ptr<cl::Context>& context)
    : pack(context, context->program("clip/pack.cl", {}), "pack_rows"),
      scan(context, ExclusiveScan::Type::uint32),
      packed(context) {}

void RowReader::read_ahead(cl::Reads& reads, const cl::Buffer<std::uint32_t>& counts, std::size_t capacity,
                           const cl::Buffer<std::int32_t>& border, const cl::RawBuffer& wall,
                           std::size_t real_bytes) {
  const std::size_t entries = (counts.size() - 1) * capacity;
  if (entries > few_entries) return;
  const std::array<const cl::RawBuffer*, 3> from{&counts.raw(), &border.raw(), &wall};
  const std::array<std::size_t, 3> bytes{counts.size() * sizeof(std::uint32_t),
                                         entries * sizeof(std::int32_t), entries * real_bytes};
  for (std::size_t k = 0; k < from.size(); ++k) {
    ahead_[k].bytes.resize(bytes[k]);
    reads.add(*from[k], ahead_[k].bytes.data(), bytes[k]);
    ahead_[k].memory = from[k]->handle();
  }
}

std::vector<std::byte>* RowReader::ahead(cl_mem memory) {
  for (Ahead& read : ahead_) {
    if (read.memory != memory) continue;
    read.memory = nullptr;
    return &read.bytes;
  }
  return nullptr;
}

void RowReader::read_counts(cl::Buffer<std::uint32_t>& counts, std::size_t capacity,
                            std::vector<std::uint32_t>& offset, bool allow_map) {
  rows_ = counts.size() - 1;
  capacity_ = capacity;
  few_ = rows_ * capacity_ <= few_entries;
  maps_ = allow_map && !few_ && context_->info().type == DeviceInfo::Type::cpu;
  offset.resize(counts.size());
  if (few_ || maps_) {
    if (const std::vector<std::byte>* const read = ahead(counts.handle()))
      std::memcpy(offset.data(), read->data(), offset.size() * sizeof offset[0]);
    else
      counts.download(std::span(offset));
    std::exclusive_scan(offset.begin(), offset.end(), offset.begin(), std::uint32_t{0});
  } else {
    if (!packer_) packer_.emplace(context_);
    packer_->scan.enqueue(counts.handle(), static_cast<std::uint32_t>(counts.size()));
    counts.download(std::span(offset));
  }
  device_offset_ = counts.handle();
  offset_ = &offset;
  total_ = offset.back();
}

void RowReader::unmap() {
  for (cl::Mapping& mapping : mappings_) mapping.end();
  mappings_.clear();
}

template <class T>
void RowReader::read_few(const cl::RawBuffer& rows, std::size_t width, std::vector<T>& to) {
  const std::size_t row_bytes = capacity_ * width * sizeof(T);
  if (std::vector<std::byte>* const read = ahead(rows.handle())) {
    raw_.swap(*read);
  } else {
    raw_.resize(rows_ * row_bytes);
    rows.read(raw_.data(), raw_.size());
  }
  for (std::size_t row = 0; row < rows_; ++row) {
    const std::size_t first = (*offset_)[row], count = (*offset_)[row + 1] - first;
    if (count > 0) std::memcpy(&to[first * width], &raw_[row * row_bytes], count * width * sizeof(T));
  }
}

template <class T>
void RowReader::read_values(const cl::RawBuffer& rows, std::size_t width, std::vector<T>& to) {
  to.resize(total_ * width);
  if (to.empty()) return;
  if (few_) return read_few(rows, width, to);
  const std::size_t bytes = to.size() * sizeof(T);
  cl::RawBuffer& packed = packer_->packed;
  if (bytes > packed.bytes()) packed.reserve(bytes + bytes / 4);  // the next launch needs about as much
  packer_->pack
      .args(static_cast<cl_uint>(rows_), static_cast<cl_uint>(capacity_),
            static_cast<cl_uint>(width * sizeof(T) / sizeof(cl_uint)), device_offset_, rows, packed)
      .launch(rows_);
  packed.read(to.data(), bytes);
}

void RowReader::read(const cl::Buffer<std::int32_t>& rows, std::size_t width, std::vector<std::int32_t>& to) {
  read_values(rows.raw(), width, to);
}

void RowReader::read(const cl::Buffer<std::uint32_t>& rows, std::size_t width,
                     std::vector<std::uint32_t>& to) {
  read_values(rows.raw(), width, to);
}

void RowReader::read_reals(const cl::RawBuffer& rows, bool float32, std::size_t width,
                           std::vector<double>& to) {
  if (!float32) return read_values(rows, width, to);
  read_values(rows, width, narrow_);
  to.resize(narrow_.size());
  std::copy(narrow_.begin(), narrow_.end(), to.begin());
}

}  // namespace powercell
