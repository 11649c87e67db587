#include "lib/domain/simplex_input.hpp"

#include <cmath>
#include <limits>

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
  constexpr std::size_t limit = std::numeric_limits<std::uint32_t>::max();
  if (elements.size() > limit || vertices.size() / 3 > limit) {
    refuse("too many " + elements_name + " or vertices: " + std::to_string(rows) + " and " +
           std::to_string(vertices.size() / 3));
  }
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    if (!std::isfinite(vertices[k])) {
      refuse("vertex " + std::to_string(k / 3) + ": coordinate " + "xyz"[k % 3] + " is " +
             std::to_string(vertices[k]));
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

}  // namespace powercell
