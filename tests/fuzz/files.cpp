// The readers of files, and the domains made of what they read.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "apps/io/read/domain.hpp"
#include "apps/io/tables/read_seeds.hpp"
#include "tests/fuzz/refusals.hpp"

namespace powercell::fuzz {
namespace {

void require_finite(const std::vector<double>& values, const char* what) {
  require(std::ranges::all_of(values, [](double x) { return std::isfinite(x); }),
          std::string(what) + " that is not finite was read");
}

void check_domain(const Domain& domain) {
  require(std::isfinite(domain.measure()) && domain.measure() > 0, "a domain of no or infinite measure");
  require(domain.region_count() > 0, "a domain without regions");
}

/// What a mesh reader promises; then the library decides whether it is a domain.
void check_arrays(const io::DomainArrays& arrays) {
  if (arrays.kind == DomainKind::polygon) {
    std::size_t points = 0;
    for (const PolygonPart& part : arrays.parts) {
      points += part.outer.size();
      for (const Ring& hole : part.holes) points += hole.size();
    }
    if (points <= 200) check_domain(Domain::polygon(arrays.parts));
    return;
  }
  const std::size_t corners = arrays.kind == DomainKind::volume ? 4 : 3;
  require(!arrays.elements.empty() && arrays.elements.size() % corners == 0, "no whole number of elements");
  require(arrays.vertices.size() % 3 == 0, "no whole number of vertices");
  require_finite(arrays.vertices, "a coordinate");
  for (const std::uint32_t v : arrays.elements)
    require(v < arrays.vertices.size() / 3, "an index out of range was read");
  if (arrays.elements.size() > 400) return;
  check_domain(arrays.kind == DomainKind::volume ? Domain::volume(arrays.vertices, arrays.elements)
                                                 : Domain::surface(arrays.vertices, arrays.elements));
}

/// Runs `read`; a refusal must be one of a file or of the domain in it.
template <class Read>
void read_or_refuse(Read read) {
  accepted({ErrorCode::invalid_file, ErrorCode::invalid_domain, ErrorCode::invalid_seed,
            ErrorCode::invalid_argument},
           read);
}

template <std::size_t Count>
void read_file_of(const char* const (&extensions)[Count], Bytes input) {
  if (input.empty()) return;
  const std::size_t choice = input[0] % (4 * Count);
  constexpr std::optional<DomainKind> kKinds[] = {{}, {}, DomainKind::surface, DomainKind::volume};
  const std::string_view bytes(reinterpret_cast<const char*>(input.data()) + 1, input.size() - 1);
  read_or_refuse([&] {
    check_arrays(io::parse_domain(bytes, extensions[choice % Count], kKinds[choice / Count], "file"));
  });
}

}  // namespace

void meshes(Bytes input) {
  read_file_of({".off", ".obj", ".ply", ".stl", ".mesh", ".msh", ".tet", ".txt"}, input);
}

void grids(Bytes input) {
  read_file_of({".vtk", ".vtu"}, input);
}

void polygons(Bytes input) {
  read_file_of({".geojson", ".wkt", ".svg"}, input);
}

void seeds(Bytes input) {
  if (input.empty()) return;
  const int dimension = 2 + (input[0] & 1);
  const std::size_t format = input[0] / 2 % 3;
  const std::string text(reinterpret_cast<const char*>(input.data()) + 1, input.size() - 1);
  read_or_refuse([&] {
    if (format == 2) {
      io::parse_random_spec("random:" + text);
      return;
    }
    const io::SeedTable table = format == 0 ? io::parse_seeds_text(text, dimension, "file")
                                            : io::parse_seeds_npy(text, dimension, "file");
    require(table.dimension == dimension, "seeds of another dimension than asked for");
    require(table.positions.size() == table.count() * static_cast<std::size_t>(dimension),
            "positions and weights of different numbers of seeds");
    require_finite(table.positions, "a coordinate");
    require_finite(table.weights, "a weight");
  });
}

}  // namespace powercell::fuzz
