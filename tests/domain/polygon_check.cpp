// The check of polygons against GEOS, which decides rightly on small integers.
#include "lib/domain/polygon_check.hpp"

#include <doctest/doctest.h>
#include <geos_c.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>

#include "lib/domain/orientation.hpp"
#include "tests/domain/check_mesh.hpp"
#include "tests/domain/polygon_shapes.hpp"

namespace powercell {
namespace {

using test::Polygon;
using test::Random;
using test::random_polygon;
using Corner = std::array<double, 2>;

class Geos {
 public:
  Geos() : handle_(GEOS_init_r()) {}
  ~Geos() { GEOS_finish_r(handle_); }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;

  /// What is wrong with the polygon; nothing if it is valid.
  std::string defect(const IndexedRings& rings) {
    std::vector<Geometry> parts;
    for (std::size_t first = 0, last = 0; first < rings.rings.size(); first = last) {
      while (last < rings.rings.size() && rings.rings[last].part == rings.rings[first].part) ++last;
      parts.push_back(polygon(rings, rings.part(first, last)));
      char* reason = nullptr;
      const char valid = GEOSisValidDetail_r(handle_, parts.back().get(), 0, &reason, nullptr);
      const std::string text = reason == nullptr ? "" : reason;
      GEOSFree_r(handle_, reason);
      REQUIRE(valid <= 1);
      if (valid == 0) return text;
    }
    for (std::size_t p = 0; p < parts.size(); ++p)
      for (std::size_t q = 0; q < p; ++q) {
        const char overlap = GEOSRelatePattern_r(handle_, parts[q].get(), parts[p].get(), "T********");
        REQUIRE(overlap <= 1);
        if (overlap == 1) return "parts overlap";
      }
    return "";
  }

 private:
  using Geometry = std::unique_ptr<GEOSGeometry, std::function<void(GEOSGeometry*)>>;

  Geometry polygon(const IndexedRings& rings, std::span<const IndexedRing> of_part) {
    std::vector<GEOSGeometry*> closed;
    for (const IndexedRing& ring : of_part) {
      const auto count = static_cast<unsigned>(ring.vertex.size());
      GEOSCoordSequence* points = GEOSCoordSeq_create_r(handle_, count + 1, 2);
      for (unsigned k = 0; k <= count; ++k) {
        const double* at = rings.at(ring.vertex[k % count]);
        GEOSCoordSeq_setXY_r(handle_, points, k, at[0], at[1]);
      }
      closed.push_back(GEOSGeom_createLinearRing_r(handle_, points));
    }
    return {GEOSGeom_createPolygon_r(handle_, closed[0], closed.data() + 1,
                                     static_cast<unsigned>(closed.size() - 1)),
            [this](GEOSGeometry* geometry) { GEOSGeom_destroy_r(handle_, geometry); }};
  }

  GEOSContextHandle_t handle_;
};

/// Why the polygon is refused; nothing if it is not.
std::string refusal_of(const Polygon& polygon) {
  const std::string why = test::refusal([&] { check_polygon(index_rings(polygon)); });
  return why == "(accepted)" ? "" : why;
}

/// Whether all rings enclose an area, so that GEOS can be asked.
bool has_area(const Polygon& polygon) {
  return test::refusal([&] { index_rings(polygon); }) == "(accepted)";
}

/// Images under these have the same defects. Coordinates of up to 2^8 stay exact.
Corner image(int map, const Corner& x) {
  switch (map) {
    case 0:
      return {3 * x[0] - 4 * x[1], 4 * x[0] + 3 * x[1]};  // turned
    case 1:
      return {-x[0], x[1]};  // mirrored
    case 2:
      return {x[0] + 0x1p40 * x[1], x[1] + 0x1p30};  // sheared and far away
    case 3:
      return {0x1p25 * x[0] + (0x1p25 - 1) * x[1], (0x1p25 + 1) * x[0] + 0x1p25 * x[1]};  // all but flat
    case 4:
      return {0x1p-300 * x[0], 0x1p-900 * x[1]};  // products underflow
    case 5:
      return {0x1p-1070 * x[1], 0x1p300 * x[0]};
    default:
      return {0x1p-700 * x[0], 0x1p320 * x[1]};
  }
}
constexpr int maps = 7;

TEST_CASE("GEOS refuses the same polygons, and so do all affine images of them") {
  Geos geos;
  std::map<std::string, int> seen;
  Random random(1);
  for (int trial = 0; trial < 24000; ++trial) {
    CAPTURE(trial);
    const Polygon polygon = random_polygon(trial % test::families, random);
    CAPTURE(test::text_of(polygon));
    if (!has_area(polygon)) continue;
    const std::string defect = geos.defect(index_rings(polygon)), why = refusal_of(polygon);
    CAPTURE(defect);
    CAPTURE(why);
    REQUIRE(defect.empty() == why.empty());
    ++seen[defect];
    const int map = trial % maps;
    CAPTURE(map);
    const std::string of_image =
        refusal_of(test::moved(polygon, [&](const Corner& x) { return image(map, x); }));
    CAPTURE(of_image);
    REQUIRE(defect.empty() == of_image.empty());
  }
  for (const char* defect : {"", "Self-intersection", "Ring Self-intersection", "Hole lies outside shell",
                             "Holes are nested", "Interior is disconnected", "parts overlap"}) {
    CAPTURE(defect);
    CHECK(seen[defect] > 100);
  }
}

TEST_CASE("GEOS refuses the same polygons where points are beside edges by one unit of a fine grid") {
  Geos geos;
  Random random(2);
  int valid = 0, invalid = 0;
  for (int trial = 0; trial < 24000; ++trial) {
    CAPTURE(trial);
    const std::uint64_t often = 2 + random() % 12;
    const auto jitter = [&] { return random() % often == 0 ? double(random() % 3) - 1 : 0; };
    const Polygon polygon = test::moved(random_polygon(trial % test::families, random), [&](const Corner& x) {
      const Corner turned = image(trial % 2 ? 0 : 1, x);
      return Corner{0x1p16 * turned[0] + jitter(), 0x1p16 * turned[1] + jitter()};
    });
    CAPTURE(test::text_of(polygon));
    if (!has_area(polygon)) continue;
    const std::string defect = geos.defect(index_rings(polygon)), why = refusal_of(polygon);
    CAPTURE(defect);
    CAPTURE(why);
    REQUIRE(defect.empty() == why.empty());
    ++(defect.empty() ? valid : invalid);
  }
  CHECK(valid > 2000);
  CHECK(invalid > 10000);
}

TEST_CASE("the order of rings and parts, where they begin, how they turn, and the axes do not matter") {
  Random random(3);
  int valid = 0;
  for (int trial = 0; trial < 16000; ++trial) {
    CAPTURE(trial);
    const double angle = trial % 7;
    const Polygon polygon = test::moved(random_polygon(trial % test::families, random), [&](const Corner& x) {
      // Rounding moves corners off edges that they lay on.
      return Corner{std::cos(angle) * x[0] - std::sin(angle) * x[1],
                    std::sin(angle) * x[0] + std::cos(angle) * x[1]};
    });
    CAPTURE(test::text_of(polygon));
    const std::uint64_t axes = random() % 8;
    Polygon other = test::moved(polygon, [&](const Corner& x) {
      const Corner y = {axes & 1 ? -x[0] : x[0], axes & 2 ? -x[1] : x[1]};
      return axes & 4 ? Corner{y[1], y[0]} : y;
    });
    const auto shuffle = [&](Ring& ring) {
      std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(random() % ring.size()),
                  ring.end());
      if (random() % 2) std::ranges::reverse(ring);
    };
    for (PolygonPart& part : other) {
      shuffle(part.outer);
      for (Ring& hole : part.holes) shuffle(hole);
      std::ranges::shuffle(part.holes, random);
    }
    std::ranges::shuffle(other, random);
    const std::string why = refusal_of(polygon), of_other = refusal_of(other);
    CAPTURE(why);
    CAPTURE(of_other);
    REQUIRE(why.empty() == of_other.empty());
    valid += why.empty() ? 1 : 0;
  }
  CHECK(valid > 3000);
}

TEST_CASE("rings have all vertices that lie on their edges, in order") {
  Random random(4);
  std::size_t added = 0;
  for (int trial = 0; trial < 12000; ++trial) {
    CAPTURE(trial);
    const Polygon polygon = random_polygon(trial % test::families, random);
    CAPTURE(test::text_of(polygon));
    if (!has_area(polygon)) continue;
    const IndexedRings before = index_rings(polygon);
    IndexedRings after = before;
    if (test::refusal([&] { split_touched_edges(after, check_polygon(before)); }) != "(accepted)") continue;
    for (std::size_t r = 0; r < before.rings.size(); ++r) {
      const std::vector<std::uint32_t>& ring = before.rings[r].vertex;
      std::vector<std::uint32_t> expected;
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const std::uint32_t a = ring[k], b = ring[(k + 1) % ring.size()];
        std::vector<std::uint32_t> on_edge;
        for (std::uint32_t v = 0; v < before.vertex_count(); ++v)
          if (strictly_between(before.at(a), before.at(v), before.at(b))) on_edge.push_back(v);
        if (b < a) std::ranges::reverse(on_edge);
        expected.push_back(a);
        expected.insert(expected.end(), on_edge.begin(), on_edge.end());
        added += on_edge.size();
      }
      REQUIRE(after.rings[r].vertex == expected);
    }
  }
  CHECK(added > 1000);
}

}  // namespace
}  // namespace powercell
