#include "apps/io/read/domain_box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "apps/io/printable.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::io {
namespace {

constexpr std::string_view box_prefix = "box:", lattice_prefix = "lattice:";

[[noreturn]] void refuse(const std::string& spec, const std::string& why) {
  throw Error(ErrorCode::invalid_argument, fmt::format("domain {}: {}", readable(spec), why));
}

/// Rows of equally many numbers, 2 or 3.
std::vector<std::vector<double>> parse_rows(const std::string& spec, std::string_view text, char separator) {
  std::vector<std::vector<double>> rows;
  for (const std::string_view part : split(text, separator)) {
    std::vector<double>& row = rows.emplace_back();
    for (const std::string_view word : split(part, ','))
      if (parse_number(word, row.emplace_back()) != Parsed::ok)
        refuse(spec, fmt::format("'{}' is not a number", readable(std::string(word))));
    if (row.size() != rows.front().size() || row.size() < 2 || row.size() > 3)
      refuse(spec, fmt::format("'{}' has {} coordinates; all points and vectors need 2, or all 3",
                               readable(std::string(part)), row.size()));
  }
  return rows;
}

/// The six tetrahedra around the diagonal of a parallelepiped, one for each order of the vectors.
std::vector<std::uint32_t> six_tetrahedra() {
  std::vector<std::uint32_t> elements;
  for (unsigned first = 1; first < 8; first *= 2)
    for (unsigned second = 1; second < 8; second *= 2)
      if (second != first) elements.insert(elements.end(), {0u, first, first | second, 7u});
  return elements;
}

/// The arrays of a parallelogram or parallelepiped.
DomainArrays arrays_of(const std::vector<double>& origin, const std::vector<std::vector<double>>& vectors) {
  DomainArrays arrays;
  const std::size_t d = origin.size();
  Ring ring;
  for (unsigned corner = 0; corner < 1U << d; ++corner) {
    const unsigned bits = d == 2 ? corner ^ corner >> 1 : corner;  // around a parallelogram
    std::vector<double> x = origin;
    for (std::size_t k = 0; k < d; ++k)
      for (std::size_t c = 0; (bits >> k & 1) != 0 && c < d; ++c) x[c] += vectors[k][c];
    if (d == 2)
      ring.push_back({x[0], x[1]});
    else
      arrays.vertices.insert(arrays.vertices.end(), x.begin(), x.end());
  }
  arrays.kind = d == 2 ? DomainKind::polygon : DomainKind::volume;
  if (d == 2)
    arrays.parts = {{std::move(ring), {}}};
  else
    arrays.elements = six_tetrahedra();
  return arrays;
}

DomainArrays parse_corners(const std::string& spec) {
  const std::vector<std::vector<double>> corners =
      parse_rows(spec, std::string_view(spec).substr(box_prefix.size()), ':');
  if (corners.size() != 2)
    refuse(spec, "a box is box:LX,LY[,LZ]:HX,HY[,HZ], its lower and its higher corner");
  std::vector<std::vector<double>> edges(corners[0].size(), std::vector<double>(corners[0].size()));
  for (std::size_t k = 0; k < edges.size(); ++k) edges[k][k] = corners[1][k] - corners[0][k];
  DomainArrays arrays = arrays_of(corners[0], edges);
  arrays.exact = Domain::box(corners[0], corners[1]);
  return arrays;
}

DomainArrays parse_vectors(const std::string& spec) {
  const std::vector<std::vector<double>> vectors =
      parse_rows(spec, std::string_view(spec).substr(lattice_prefix.size()), '/');
  if (vectors.size() != vectors.front().size())
    refuse(spec,
           "a lattice is lattice:ax,ay/bx,by or lattice:ax,ay,az/bx,by,bz/cx,cy,cz, as many vectors as "
           "each has coordinates");
  std::vector<double> rows;
  for (const std::vector<double>& v : vectors) rows.insert(rows.end(), v.begin(), v.end());
  DomainArrays arrays = arrays_of(std::vector<double>(vectors.size()), vectors);
  arrays.exact = Domain::lattice(rows);
  return arrays;
}

}  // namespace

bool is_box_spec(const std::string& spec) {
  return spec.starts_with(box_prefix) || spec.starts_with(lattice_prefix);
}

DomainArrays parse_box(const std::string& spec) {
  return spec.starts_with(box_prefix) ? parse_corners(spec) : parse_vectors(spec);
}

void make_periodic(DomainArrays& arrays, const std::string& axes, const std::string& spec) {
  if (axes.empty()) return;
  if (!arrays.exact)
    throw Error(ErrorCode::unsupported,
                fmt::format("--periodic: {} is not a box; give --domain square, cube or box:..., or "
                            "lattice:... for a skew one",
                            readable(spec)));
  if (arrays.exact->is_periodic())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("--periodic: {} is periodic already; leave out --periodic", readable(spec)));
  const auto d = static_cast<std::size_t>(arrays.exact->dimension());
  std::array<bool, 3> periodic{};
  for (const char axis : axes) {
    const std::size_t k = std::string_view("xyz").find(axis);
    if (k == std::string_view::npos || (k >= d && axes != "xyz"))
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("--periodic={}: the axes of {} are {}", readable(axes), readable(spec),
                              d == 2 ? "xy" : "xyz"));
    if (k < d) periodic[k] = true;
  }
  const std::array<double, 3> low = arrays.exact->low(), high = arrays.exact->high();
  arrays.exact =
      Domain::periodic_box(std::span(low).first(d), std::span(high).first(d), std::span(periodic).first(d));
}

std::string describe_box(const Domain& domain, const std::string& spec) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  std::string axes;
  for (std::size_t k = 0; k < d; ++k)
    if (const auto v = domain.periods()[k]; v != std::array<double, 3>{}) axes += "xyz"[k];
  if (spec.starts_with(lattice_prefix)) return fmt::format("{}: lattice, periodic", spec);
  if (axes.empty()) return fmt::format("{}: box", spec);
  return fmt::format("{}: box, periodic along {}", spec, axes);
}

}  // namespace powercell::io
