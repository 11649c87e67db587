#include "apps/bench/sizes.hpp"

#include <fmt/format.h>

#include "apps/common.hpp"

namespace powercell::app {
namespace {

constexpr std::size_t few_seeds = 10'000, many_seeds = 100'000;
constexpr double bytes_a_seed = 2500;  // upper estimate of a diagram's memory
constexpr double longest_run = 30;     // seconds

}  // namespace

std::vector<std::size_t> row_sizes(const std::string& domain, bool quick) {
  const bool headline = domain == headline_domain;
  if (quick) return headline ? std::vector{few_seeds, quick_headline_seeds} : std::vector{few_seeds};
  return headline ? std::vector{few_seeds, many_seeds, headline_seeds} : std::vector{few_seeds, many_seeds};
}

double share_of_time(std::size_t n) {
  return n < many_seeds ? 1 : n < headline_seeds ? 3 : 9;
}

std::string why_left_out(std::size_t n, std::uint64_t device_memory, double rate) {
  const auto seeds = static_cast<double>(n), memory = static_cast<double>(device_memory);
  if (seeds * bytes_a_seed > memory)
    return fmt::format("it may take {:.1f} GB of device memory, and there are {:.1f}",
                       1e-9 * seeds * bytes_a_seed, 1e-9 * memory);
  if (rate > 0 && seeds / rate > longest_run)
    return fmt::format("each run would take about {:.0f} s", seeds / rate);
  return {};
}

std::vector<std::size_t> transfer_sizes() {
  std::vector<std::size_t> sizes;
  for (std::size_t bytes = std::size_t{4} << 10; bytes <= std::size_t{256} << 20; bytes *= 4)
    sizes.push_back(bytes);
  return sizes;
}

std::string bytes_text(std::size_t bytes) {
  constexpr std::size_t mebi = std::size_t{1} << 20;
  return bytes < mebi ? fmt::format("{} KiB", bytes >> 10) : fmt::format("{} MiB", bytes / mebi);
}

}  // namespace powercell::app
