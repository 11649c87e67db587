#include "lib/applications/linear/laplacian.hpp"

#include <limits>
#include <numeric>
#include <powercell/error.hpp>

namespace powercell {

Laplacian make_laplacian(std::span<const std::uint64_t> offset, std::span<const std::uint32_t> neighbor,
                         std::span<const double> conductance, std::span<const double> shift,
                         std::size_t beyond) {
  const std::size_t n = offset.size() - 1;
  if (neighbor.size() + n > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw Error(ErrorCode::unsupported, "a linear system of " + std::to_string(neighbor.size() + n) +
                                            " entries: the solver takes fewer than 2^31");
  Laplacian system;
  system.singular = shift.empty();
  SparseRows& matrix = system.matrix;
  matrix.resize(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n + beyond));
  matrix.resizeNonZeros(static_cast<Eigen::Index>(neighbor.size() + n));
  std::int32_t* const outer = matrix.outerIndexPtr();
  std::int32_t* const inner = matrix.innerIndexPtr();
  double* const value = matrix.valuePtr();
  std::size_t at = 0;
  for (std::size_t i = 0; i < n; ++i) {
    outer[i] = static_cast<std::int32_t>(at);
    std::size_t diagonal = at;  // moves behind the neighbours j < i
    double sum = shift.empty() ? 0 : shift[i];
    ++at;
    for (std::uint64_t k = offset[i]; k < offset[i + 1]; ++k) {
      sum += conductance[k];
      if (neighbor[k] < i) {
        inner[at - 1] = static_cast<std::int32_t>(neighbor[k]);
        value[at - 1] = -conductance[k];
        diagonal = at++;
      } else {
        inner[at] = static_cast<std::int32_t>(neighbor[k]);
        value[at++] = -conductance[k];
      }
    }
    inner[diagonal] = static_cast<std::int32_t>(i);
    value[diagonal] = sum;
  }
  outer[n] = static_cast<std::int32_t>(at);
  return system;
}

std::size_t connected_components(const SparseRows& matrix) {
  std::vector<char> seen(static_cast<std::size_t>(matrix.rows()));
  std::vector<std::int32_t> open;
  std::size_t parts = 0;
  for (std::int32_t start = 0; start < matrix.rows(); ++start) {
    if (seen[static_cast<std::size_t>(start)]) continue;
    ++parts;
    seen[static_cast<std::size_t>(start)] = 1;
    open.push_back(start);
    while (!open.empty()) {
      const std::int32_t i = open.back();
      open.pop_back();
      for (SparseRows::InnerIterator entry(matrix, i); entry; ++entry) {
        char& known = seen[static_cast<std::size_t>(entry.col())];
        if (known || entry.value() == 0) continue;
        known = 1;
        open.push_back(static_cast<std::int32_t>(entry.col()));
      }
    }
  }
  return parts;
}

}  // namespace powercell
