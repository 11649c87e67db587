// The laws on a saved diagram (docs/mathematics.md, 17-20), from nothing but the numbers in the file.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "apps/saved.hpp"

namespace powercell::app {
namespace {

using Point = std::array<double, 3>;

Point point(const double* x, int dimension) {
  return {x[0], x[1], dimension > 2 ? x[2] : 0};
}
Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
double length(const Point& a) {
  return std::sqrt(dot(a, a));
}
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Everything about one cell is taken relative to its seed, so that nothing cancels far from the origin.
Point seed_of(const SavedCell& cell, int d) {
  return point(cell.position.data(), d);
}
Point vertex_of(const SavedCell& cell, std::size_t v, int d) {
  return minus(point(&cell.vertices[v * static_cast<std::size_t>(d)], d), seed_of(cell, d));
}

// Twice the area vector of a loop, about the seed.
Point area_vector(const SavedCell& cell, const SavedFace& face, int d) {
  Point sum{};
  const Point first = face.loop.empty() ? Point{} : vertex_of(cell, face.loop[0], d);
  for (std::size_t k = 1; k + 1 < face.loop.size(); ++k) {
    const Point c = cross(minus(vertex_of(cell, face.loop[k], d), first),
                          minus(vertex_of(cell, face.loop[k + 1], d), first));
    for (int axis = 0; axis < 3; ++axis) sum[axis] += c[axis];
  }
  return sum;
}

double edge_length(const SavedCell& cell, const SavedFace& face, std::size_t k, int d) {
  return length(
      minus(vertex_of(cell, face.loop[k], d), vertex_of(cell, face.loop[(k + 1) % face.loop.size()], d)));
}

// What the vertices of a cell say of it.
struct Moments {
  double measure = 0;
  Point first{};  // integral of the place, seen from the seed
};

// The part of one face: triangles about its first vertex, in space tetrahedra about the seed.
void add_face(Moments& moments, const SavedCell& cell, const SavedFace& face, const SavedDiagram& diagram) {
  const int d = diagram.dimension;
  const Point whole = area_vector(cell, face, d), first = vertex_of(cell, face.loop[0], d);
  const double size = length(whole);
  const bool solid = diagram.kind == DomainKind::volume;
  for (std::size_t k = 1; k + 1 < face.loop.size(); ++k) {
    const Point a = vertex_of(cell, face.loop[k], d), b = vertex_of(cell, face.loop[k + 1], d);
    const Point area = cross(minus(a, first), minus(b, first));
    double part = 0;
    if (solid)
      part = dot(area, first) / 6;
    else if (diagram.kind == DomainKind::polygon)
      part = area[2] / 2;  // holes run clockwise and count against it
    else if (size > 0)
      part = dot(area, whole) / (2 * size);  // the face may not be convex
    moments.measure += part;
    for (int axis = 0; axis < 3; ++axis)
      moments.first[axis] += part * (first[axis] + a[axis] + b[axis]) / (solid ? 4 : 3);
  }
}

Moments moments_from_vertices(const SavedCell& cell, const SavedDiagram& diagram) {
  Moments moments;
  for (const SavedFace& face : cell.faces)
    if (!face.loop.empty()) add_face(moments, cell, face, diagram);
  return moments;
}

// What defects are compared with.
struct Scale {
  double size;      // the diagonal of the box of all vertices
  double rounding;  // how far a vertex may be off, as the file has absolute coordinates: some last places of
                    // the largest
};

double extent(const SavedDiagram& diagram) {
  const auto d = static_cast<std::size_t>(diagram.dimension);
  double size = 0;
  for (std::size_t axis = 0; axis < d; ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const SavedCell& cell : diagram.cells)
      for (std::size_t k = axis; k < cell.vertices.size(); k += d) {
        low = std::min(low, cell.vertices[k]);
        high = std::max(high, cell.vertices[k]);
      }
    if (high > low) size = std::hypot(size, high - low);
  }
  return size;
}

Scale scale_of(const SavedDiagram& diagram) {
  double largest = 0;
  for (const SavedCell& cell : diagram.cells)
    for (const double x : cell.vertices) largest = std::max(largest, std::abs(x));
  return {std::max(extent(diagram), std::numeric_limits<double>::min()),
          4 * std::numeric_limits<double>::epsilon() * largest};
}

// A defect without what rounding explains; what is not a number stays so.
double above(double defect, double rounding) {
  return defect <= rounding ? 0 : defect - rounding;
}

// How far `y` (seen from seed i) lies on the side of seed j, as a distance; rounding taken off.
double beyond(const SavedDiagram& diagram, std::size_t i, std::size_t j, const Point& y) {
  const Point q =
      minus(seed_of(diagram.cells[j], diagram.dimension), seed_of(diagram.cells[i], diagram.dimension));
  const double wi = diagram.cells[i].weight, wj = diagram.cells[j].weight, distance = length(q);
  const double defect = 2 * dot(q, y) - dot(q, q) - (wi - wj);
  const double rounding = 16 * std::numeric_limits<double>::epsilon() *
                          (distance * (length(y) + distance) + std::abs(wi) + std::abs(wj));
  if (std::abs(defect) <= rounding) return 0;
  const double sure = defect - std::copysign(rounding, defect);
  return distance > 0 ? sure / (2 * distance) : (sure > 0 ? std::numeric_limits<double>::infinity() : 0);
}

// The largest defect so far and where it was.
struct Worst {
  double value = 0;
  std::string where;
  void see(double defect, auto&& describe) {
    if (!(defect <= value)) {  // also true for what is not a number
      value = defect;
      where = describe();
    }
  }
  LawCheck law(std::string name, double tolerance) const {
    return {std::move(name), value <= tolerance, value, tolerance, where};
  }
};

double sum_of_measures(const SavedDiagram& diagram) {
  long double sum = 0;
  for (const SavedCell& cell : diagram.cells) sum += cell.measure;
  return static_cast<double>(sum);
}

// Lengths of the edges, or areas of the faces, at the domain's boundary, each times how far its seed sees.
double boundary_times_reach(const SavedDiagram& diagram) {
  const int d = diagram.dimension;
  double sum = 0;
  for (const SavedCell& cell : diagram.cells)
    for (const SavedFace& face : cell.faces)
      for (std::size_t k = 0; k < face.border.size(); ++k) {
        if (!face.border[k] || *face.border[k] >= 0) continue;
        double reach = 0;
        for (const std::uint32_t v : face.loop) reach = std::max(reach, length(vertex_of(cell, v, d)));
        const bool solid = diagram.kind == DomainKind::volume;
        sum += reach * (solid ? length(area_vector(cell, face, d)) / 2 : edge_length(cell, face, k, d));
      }
  return sum;
}

// Cells are computed about their seeds, so a boundary is off by last places of its distance from them
// (docs/mathematics.md, (17a)). In domains far longer than thick that is more than the tolerance.
LawCheck partition(const SavedDiagram& diagram, double tolerance) {
  const double sum = sum_of_measures(diagram);
  Worst worst;
  // No cells are right where there were no seeds, which only the summary can say.
  const bool no_seeds = diagram.cells.empty() && diagram.summary && diagram.summary->cells == 0;
  const double rounding = std::numeric_limits<double>::epsilon() * boundary_times_reach(diagram);
  if (!no_seeds)
    worst.see(above(std::abs(sum - diagram.domain_measure), rounding) / diagram.domain_measure,
              [&] { return fmt::format("sum {:.17g}, domain {:.17g}", sum, diagram.domain_measure); });
  return worst.law("partition: the measures sum to the domain's", tolerance);
}

LawCheck summary(const SavedDiagram& diagram, const SavedSummary& said, double tolerance) {
  Worst worst;
  const auto count = [&](SeedStatus status, std::size_t expected, const char* what) {
    const auto found =
        static_cast<std::size_t>(std::ranges::count(diagram.cells, status, &SavedCell::status));
    if (found != expected)
      worst.see(1, [&] { return fmt::format("{} {} in 'check', but {}", expected, what, found); });
  };
  count(SeedStatus::ok, said.cells, "cells");
  count(SeedStatus::hidden, said.hidden, "hidden seeds");
  count(SeedStatus::duplicate, said.duplicate, "duplicates");
  const auto measure = [&](double expected, double found, const char* what) {
    worst.see(std::abs(expected - found) / diagram.domain_measure,
              [&] { return fmt::format("{} {:.17g} in 'check', but {:.17g}", what, expected, found); });
  };
  measure(said.measure, sum_of_measures(diagram), "measure");
  measure(said.domain_measure, diagram.domain_measure, "measure of the domain");
  return worst.law("summary: what 'check' says is true of the cells", tolerance);
}

double mean_measure(const SavedDiagram& diagram) {
  return diagram.domain_measure / static_cast<double>(std::max<std::size_t>(1, diagram.cells.size()));
}

// Lengths of the edges of a polygon or surface cell, or areas of the faces of a polyhedron: times a shift of
// the vertices, what it changes of the measure at most.
double boundary_of(const SavedCell& cell, const SavedDiagram& diagram) {
  const int d = diagram.dimension;
  double sum = 0;
  for (const SavedFace& face : cell.faces) {
    if (diagram.kind == DomainKind::volume) {
      sum += length(area_vector(cell, face, d)) / 2;
    } else {
      for (std::size_t k = 0; k < face.loop.size(); ++k) sum += edge_length(cell, face, k, d);
    }
  }
  return sum;
}

LawCheck own_measure(const SavedDiagram& diagram, const Scale& scale, double tolerance) {
  const double mean = mean_measure(diagram);
  Worst worst;
  for (std::size_t i = 0; i < diagram.cells.size(); ++i) {
    const SavedCell& cell = diagram.cells[i];
    const double again = moments_from_vertices(cell, diagram).measure;
    const double off = above(std::abs(again - cell.measure), scale.rounding * boundary_of(cell, diagram));
    worst.see(off / std::max(mean, cell.measure), [&] {
      return fmt::format("seed {}: {:.17g} in the file, {:.17g} from its vertices", i, cell.measure, again);
    });
    const bool should_be_empty = cell.status != SeedStatus::ok;
    if (should_be_empty && (cell.measure != 0 || !cell.faces.empty()))
      worst.see(1, [&] { return fmt::format("seed {} is said to be empty and has a cell", i); });
  }
  return worst.law("geometry: each cell's vertices give its measure", tolerance);
}

// How far the vertices are from the first one.
double reach(const SavedCell& cell, const SavedDiagram& diagram) {
  const int d = diagram.dimension;
  double most = 0;
  for (std::size_t v = 0; v < cell.vertices.size() / static_cast<std::size_t>(d); ++v)
    most = std::max(most, length(minus(vertex_of(cell, v, d), vertex_of(cell, 0, d))));
  return most;
}

// Centroids of slivers are known to as many digits as their measures: a cell counts by its part of a mean
// cell.
LawCheck own_centroid(const SavedDiagram& diagram, const Scale& scale, double tolerance) {
  const double mean = mean_measure(diagram);
  Worst worst;
  for (std::size_t i = 0; i < diagram.cells.size(); ++i) {
    const SavedCell& cell = diagram.cells[i];
    if (cell.centroid.empty()) continue;
    const Moments again = moments_from_vertices(cell, diagram);
    if (!(again.measure > 0)) continue;  // told by the law of measures
    const Point said =
        minus(point(cell.centroid.data(), diagram.dimension), seed_of(cell, diagram.dimension));
    Point off{};
    for (int axis = 0; axis < 3; ++axis) off[axis] = again.first[axis] / again.measure - said[axis];
    const double rounding =
        scale.rounding * (1 + boundary_of(cell, diagram) * reach(cell, diagram) / again.measure);
    worst.see(above(length(off), rounding) / scale.size * std::min(1.0, again.measure / mean),
              [&] { return fmt::format("the centroid of seed {} is off by {:.3g}", i, length(off)); });
  }
  return worst.law("centroids: each cell's vertices give its centroid", tolerance);
}

struct Wall {
  double measure = 0, rim = 0;  // rim: times a shift of its vertices, what it changes of the measure at most
};

// As seen from each side.
std::map<std::pair<std::size_t, std::size_t>, Wall> walls(const SavedDiagram& diagram) {
  std::map<std::pair<std::size_t, std::size_t>, Wall> result;
  for (std::size_t i = 0; i < diagram.cells.size(); ++i)
    for (const SavedFace& face : diagram.cells[i].faces)
      for (std::size_t k = 0; k < face.border.size(); ++k) {
        if (!face.border[k] || *face.border[k] < 0) continue;
        const SavedCell& cell = diagram.cells[i];
        Wall& wall = result[{i, static_cast<std::size_t>(*face.border[k])}];
        if (diagram.kind == DomainKind::volume) {
          wall.measure += length(area_vector(cell, face, 3)) / 2;
          for (std::size_t e = 0; e < face.loop.size(); ++e) wall.rim += edge_length(cell, face, e, 3);
        } else {
          wall.measure += edge_length(cell, face, k, diagram.dimension);
          wall.rim += 2;
        }
      }
  return result;
}

LawCheck symmetry(const SavedDiagram& diagram, const Scale& scale, double tolerance) {
  const auto all = walls(diagram);
  const double unit = diagram.kind == DomainKind::volume ? scale.size * scale.size : scale.size;
  Worst worst;
  for (const auto& [seeds, here] : all) {
    const auto [i, j] = seeds;
    const auto back = all.find({j, i});
    const Wall there = back == all.end() ? Wall{} : back->second;
    const double off = above(std::abs(here.measure - there.measure), scale.rounding * (here.rim + there.rim));
    worst.see(off / unit, [&, i = i, j = j, here = here] {
      return fmt::format("wall of seeds {} and {}: {:.17g} and {:.17g}", i, j, here.measure, there.measure);
    });
  }
  return worst.law("symmetry: a wall measures the same from both sides", tolerance);
}

LawCheck on_bisectors(const SavedDiagram& diagram, const Scale& scale, double tolerance) {
  Worst worst;
  for (std::size_t i = 0; i < diagram.cells.size(); ++i)
    for (const SavedFace& face : diagram.cells[i].faces)
      for (std::size_t k = 0; k < face.loop.size(); ++k) {
        // A volume's face has one border for all of its vertices, an edge's border holds for both ends.
        const std::size_t here = diagram.kind == DomainKind::volume ? 0 : k;
        if (!face.border[here] || *face.border[here] < 0) continue;
        const auto j = static_cast<std::size_t>(*face.border[here]);
        for (const std::size_t v : {k, (k + 1) % face.loop.size()})
          worst.see(above(std::abs(beyond(diagram, i, j,
                                          vertex_of(diagram.cells[i], face.loop[v], diagram.dimension))),
                          scale.rounding) /
                        scale.size,
                    [&] { return fmt::format("a vertex of the wall of seeds {} and {}", i, j); });
      }
  return worst.law("bisectors: walls lie where two power distances agree", tolerance);
}

LawCheck ownership(const SavedDiagram& diagram, const Scale& scale, const VerifyOptions& options,
                   double tolerance) {
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < diagram.cells.size(); ++i)
    if (!diagram.cells[i].vertices.empty()) cells.push_back(i);
  Worst worst;
  std::mt19937_64 random(options.random_seed);
  for (std::size_t sample = 0; !cells.empty() && sample < options.samples; ++sample) {
    const std::size_t i = cells[random() % cells.size()];
    const SavedCell& cell = diagram.cells[i];
    const std::size_t count = cell.vertices.size() / static_cast<std::size_t>(diagram.dimension);
    const Point y = vertex_of(cell, random() % count, diagram.dimension);
    for (std::size_t j = 0; j < diagram.cells.size(); ++j)
      worst.see(above(beyond(diagram, i, j, y), scale.rounding) / scale.size,
                [&] { return fmt::format("a vertex of the cell of seed {} belongs to seed {}", i, j); });
  }
  return worst.law("ownership: no seed is nearer to a vertex than its cell's", tolerance);
}

}  // namespace

std::vector<LawCheck> check_saved(const SavedDiagram& diagram, Precision precision,
                                  const VerifyOptions& options) {
  // Sums of measures are good to a few thousand roundings, positions of nearly parallel cuts to fewer digits.
  const bool single = precision == Precision::float32;
  const double sums = single ? 1e-4 : 1e-11, places = single ? 1e-4 : 1e-9;
  const Scale scale = scale_of(diagram);
  std::vector<LawCheck> laws{partition(diagram, sums)};
  if (diagram.summary) laws.push_back(summary(diagram, *diagram.summary, sums));
  laws.insert(laws.end(), {own_measure(diagram, scale, places), own_centroid(diagram, scale, places),
                           symmetry(diagram, scale, places), on_bisectors(diagram, scale, places),
                           ownership(diagram, scale, options, places)});
  return laws;
}

}  // namespace powercell::app
