#include "lib/base/mesh_arrays.hpp"

#include <cmath>
#include <limits>

#include "lib/base/text.hpp"

namespace powercell {

void check_simplices(std::span<const double> vertices, std::span<const std::uint32_t> elements, int corners,
                     const std::string& element, const std::string& elements_name) {
  auto refuse = [](const std::string& why) { throw Error(ErrorCode::invalid_domain, why); };
  const std::size_t rows = elements.size() / static_cast<std::size_t>(corners);
  if (vertices.size() % 3 != 0) {
    refuse("vertices need 3 coordinates each, got " + std::to_string(vertices.size()) + " numbers");
  }
  if (elements.size() % static_cast<std::size_t>(corners) != 0) {
    refuse(elements_name + " need " + std::to_string(corners) + " vertex indices each, got " +
           std::to_string(elements.size()) + " numbers");
  }
  if (rows == 0) refuse("the domain is empty: it has no " + elements_name);
  // Positions in the array of indices have 32 bits, indices of vertices on the device 31.
  constexpr std::size_t most_rows = std::numeric_limits<std::uint32_t>::max(),
                        most_vertices = (std::size_t{1} << 31) - 1;
  if (rows > most_rows / static_cast<std::size_t>(corners)) {
    refuse(std::to_string(rows) + " " + elements_name + " are more than the limit of " +
           std::to_string(most_rows / static_cast<std::size_t>(corners)) + " for one domain");
  }
  if (vertices.size() / 3 > most_vertices) {
    refuse(std::to_string(vertices.size() / 3) + " vertices are more than the limit of " +
           std::to_string(most_vertices) + " for one domain");
  }
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (!std::isfinite(vertices[k])) {
      refuse("vertex " + std::to_string(k / 3) + ": coordinate " + "xyz"[k % 3] + " is " +
             digits(vertices[k]) + "; coordinates must be finite");
    }
  }
  for (std::size_t k = 0; k < elements.size(); ++k) {
    if (elements[k] >= vertices.size() / 3) {
      refuse(element + " " + std::to_string(k / static_cast<std::size_t>(corners)) + ": vertex index " +
             std::to_string(elements[k]) + " is out of range, there are " +
             std::to_string(vertices.size() / 3) + " vertices (indices from 0)");
    }
  }
}

void check_magnitude(double largest) {
  if (largest <= 1e100 && largest >= 1e-100) return;
  throw Error(ErrorCode::invalid_domain,
              "the largest coordinate of the domain has the magnitude " + digits(largest) +
                  ": outside 1e-100 .. 1e100 measures leave the range of double; scale the domain");
}

}  // namespace powercell
