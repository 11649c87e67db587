// What a mesh domain was made without, and its overlaps, as sentences.
#include <powercell/domain.hpp>
#include <string>

#include "lib/base/text.hpp"

namespace powercell {
namespace {

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

std::vector<std::string> Domain::notes() const {
  const bool solid = cell_dimension() == 3 && !is_solid();
  const std::string one = solid ? "tetrahedron" : "triangle", many = solid ? "tetrahedra" : "triangles";
  const MeshReport& found = report();
  std::vector<std::string> notes;
  if (!found.flat.empty())
    notes.push_back("left out " +
                    counted(found.flat.size(), (is_solid() ? "degenerate " : "flat ") + one,
                            (is_solid() ? "degenerate " : "flat ") + many) +
                    ", the first is " + one + " " + std::to_string(found.flat[0]));
  if (!found.repeated.empty() && is_solid()) {
    const auto [index, earlier] = found.repeated[0];
    notes.push_back("left out " + counted(found.repeated.size(), "pair", "pairs") +
                    " of triangles with the same corners, as of a face between two bodies; the first is " +
                    std::to_string(earlier) + " and " + std::to_string(index));
  } else if (!found.repeated.empty()) {
    const auto [index, earlier] = found.repeated[0];
    notes.push_back("left out " + counted(found.repeated.size(), one, many) +
                    " given twice, with the corners of an earlier one; the first is " + one + " " +
                    std::to_string(index) + ", the same as " + std::to_string(earlier));
  }
  if (found.overlaps > 0) {
    const Overlap& o = found.largest;
    notes.push_back(
        counted(found.overlaps, "pair of " + many + " overlaps", "pairs of " + many + " overlap") + " and " +
        (found.overlaps == 1 ? "counts" : "count") + " twice " + digits(found.overlap / measure(), 2) +
        " of the " + (solid ? "volume" : "area") + ", most of all " + std::to_string(o.first) + " and " +
        std::to_string(o.second) + " around " + place_text(o.at.data()));
  }
  return notes;
}

}  // namespace powercell
