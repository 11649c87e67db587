#include "lib/cell/exact_cell.hpp"

#include <tuple>
#include <utility>

#include "lib/cell/exact_planes.hpp"
#include "lib/cell/host_clip.hpp"

namespace powercell {

/// Seeds some 60 bits wide between facets along the axes need the first; a box that is far larger than its
/// seeds the second; seeds or tetrahedra of many bits the third; triangles of a surface, whose edges have
/// normals of three times the bits, the fourth.
struct ExactCell::Planes {
  std::tuple<ExactPlanes<WideRow<1, 2>>, ExactPlanes<WideRow<1, 3>>, ExactPlanes<WideRow<2, 4>>,
             ExactPlanes<WideRow<3, 6>>, ExactPlanes<UnboundedRow>>
      of_kind;
};

namespace {

/// Shorter kinds seldom serve on surfaces.
constexpr std::size_t first_kind = 0, first_kind_on_surfaces = 3;

/// Sign of a determinant with infinitesimals: the first factor of a seed that is not 0, in the order that
/// breaks ties. `seed[k]` is that of factor k, or below 0; the factor of `self` is minus the sum of theirs.
template <class Factor, std::size_t count>
int infinitesimal_sign(const HostScene& scene, const std::array<Factor, count>& factor,
                       const std::array<std::int32_t, count>& seed, std::int32_t self) {
  std::int32_t first = -1;
  int sign = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (seed[k] < 0 || (first >= 0 && !scene.breaks_ties_before(seed[k], first))) continue;
    const int sign_here = sign_of(factor[k]);
    if (sign_here == 0) continue;
    first = seed[k];
    sign = sign_here;
  }
  if (first >= 0 && scene.breaks_ties_before(first, self)) return sign;
  Factor own{};
  for (std::size_t k = 0; k < count; ++k)
    if (seed[k] >= 0) own = own - factor[k];
  const int sign_here = sign_of(own);
  if (sign_here != 0) return sign_here;
  return sign;  // not 0: the last factor is the denominator of the vertex
}

}  // namespace

ExactCell::ExactCell(const HostScene& scene) : scene_(&scene), planes_(std::make_unique<Planes>()) {}
ExactCell::~ExactCell() = default;
ExactCell::ExactCell(ExactCell&&) noexcept = default;

void ExactCell::start(std::uint32_t rank, std::uint32_t region) {
  rank_ = rank;
  region_ = region;
  met_tie_ = false;
  start_kind(scene_->mesh->dimension != scene_->mesh->cell_dimension ? first_kind_on_surfaces : first_kind);
}

void ExactCell::start_kind(std::size_t kind) {
  kind_ = kind;
  std::apply(
      [&](auto&... planes) {
        std::size_t k = 0;
        ((k++ == kind ? planes.start(*scene_, rank_, region_) : void()), ...);
      },
      planes_->of_kind);
}

/// use(planes, row...) with rows of the shortest kind, not before `kind`, that all planes met so far fit.
template <std::size_t kind, std::size_t count, class Use>
auto ExactCell::with(const std::array<std::int32_t, count>& borders, const Use& use) {
  auto& planes = std::get<kind>(planes_->of_kind);
  constexpr std::size_t next = kind + 1 == std::tuple_size_v<decltype(planes_->of_kind)> ? kind : kind + 1;
  if (kind_ == kind) {
    const auto rows = planes.rows(borders);
    if (rows[0] != nullptr) return std::apply([&](auto... row) { return use(planes, *row...); }, rows);
    start_kind(next);  // of the last kind all fit
  }
  return this->template with<next>(borders, use);
}

bool ExactCell::is_outside(const ExactVertex& vertex, std::int32_t other) {
  const auto side = [&](const auto& factor, int determinant, const auto& seed) {
    met_tie_ = met_tie_ || determinant == 0;
    const int sign = determinant != 0
                         ? determinant
                         : infinitesimal_sign(*scene_, factor, seed, static_cast<std::int32_t>(rank_));
    return sign * sign_of(factor.back()) > 0;
  };
  if (vertex[0] == other || vertex[1] == other) return false;
  if (scene_->mesh->dimension == 2)
    return with<0>(std::array{vertex[0], vertex[1], other}, [&](const auto&, const auto& a, const auto& b,
                                                                const auto& p) {
      const auto factor = factors_in_plane(a, b, p);
      if (sign_of(factor.back()) == 0) return is_corner_outside(corner_in_line(vertex), other);
      return side(factor, determinant_sign(a, b, p, factor), std::array{vertex[0], vertex[1], other});
    });
  const bool solid = scene_->mesh->cell_dimension == 3;
  if (solid && vertex[2] == other) return false;
  const std::array<std::int32_t, 4> borders{vertex[0], vertex[1], solid ? vertex[2] : ground_border, other};
  return with<0>(borders, [&](const auto&, const auto& a, const auto& b, const auto& c, const auto& p) {
    const auto factor = factors_in_space(a, b, c, p);
    return side(factor, determinant_sign(a, b, c, p, factor), borders);
  });
}

bool ExactCell::lies_in(const ExactVertex& vertex, std::int32_t border) {
  if (vertex[0] == border || vertex[1] == border) return true;
  if (scene_->mesh->dimension == 2)
    return with<0>(std::array{vertex[0], vertex[1], border},
                   [&](const auto&, const auto& a, const auto& b, const auto& p) {
                     const auto factor = factors_in_plane(a, b, p);
                     if (sign_of(factor.back()) == 0) return corner_lies_in(corner_in_line(vertex), border);
                     return determinant_sign(a, b, p, factor) == 0;
                   });
  const bool solid = scene_->mesh->cell_dimension == 3;
  if (solid && vertex[2] == border) return true;
  return with<0>(std::array{vertex[0], vertex[1], solid ? vertex[2] : ground_border, border},
                 [](const auto&, const auto& a, const auto& b, const auto& c, const auto& p) {
                   return determinant_sign(a, b, c, p, factors_in_space(a, b, c, p)) == 0;
                 });
}

ClosePoint ExactCell::place(const ExactVertex& vertex) {
  if (scene_->mesh->dimension == 2)
    return with<0>(std::array{vertex[0], vertex[1]}, [](const auto& planes, const auto& a, const auto& b) {
      return meeting_in_plane(a, b, planes.exponent());
    });
  const bool solid = scene_->mesh->cell_dimension == 3;
  return with<0>(std::array{vertex[0], vertex[1], solid ? vertex[2] : ground_border},
                 [](const auto& planes, const auto& a, const auto& b, const auto& c) {
                   return meeting_in_space(a, b, c, planes.exponent());
                 });
}

bool ExactCell::are_parallel(std::int32_t face, std::int32_t a, std::int32_t b) {
  if (scene_->mesh->dimension == 2)
    return with<0>(std::array{a, b}, [](const auto&, const auto& p, const auto& q) {
      return sign_of(p.normal[0] * q.normal[1] - p.normal[1] * q.normal[0]) == 0;
    });
  const bool solid = scene_->mesh->cell_dimension == 3;
  return with<0>(std::array{solid ? face : ground_border, a, b},
                 [](const auto&, const auto& n, const auto& p, const auto& q) {
                   return sign_of(dot_of(n.normal, cross_of(p.normal, q.normal))) == 0;
                 });
}

bool ExactCell::is_corner_outside(std::uint32_t corner, std::int32_t other) const {
  const int side = corner_side(*scene_, rank_, corner, other);
  return side != 0 ? side > 0 : scene_->breaks_ties_before(other, static_cast<std::int32_t>(rank_));
}

bool ExactCell::is_facet_outside(std::uint32_t facet, std::int32_t other) const {
  const auto side = [&](std::uint32_t k) {
    return corner_side(*scene_, rank_, corner_of_region(*scene_->mesh, region_, k), other);
  };
  return side(facet) >= 0 && side(facet + 1) >= 0;
}

/// Polygons have corners within an edge where other pieces of the domain have theirs.
/// \return the vertex of the domain
std::uint32_t ExactCell::corner_in_line(const ExactVertex& vertex) const {
  const auto before = static_cast<std::uint32_t>(~vertex[0]), behind = static_cast<std::uint32_t>(~vertex[1]);
  const RegionMesh& mesh = *scene_->mesh;  // facet f goes from corner f to the next
  const std::uint32_t between = corner_of_region(mesh, region_, before + 1);
  return between == corner_of_region(mesh, region_, behind) ? between
                                                            : corner_of_region(mesh, region_, before);
}

bool ExactCell::corner_lies_in(std::uint32_t corner, std::int32_t border) const {
  if (border >= 0) return corner_side(*scene_, rank_, corner, border) == 0;
  return is_in_line_of_facet(*scene_, region_, corner, static_cast<std::uint32_t>(~border));
}

}  // namespace powercell
