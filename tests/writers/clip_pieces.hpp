/// \file
/// Convex pieces cut by half-spaces, for the diagrams in the tests of the writers.
#pragma once

#include <array>
#include <cstdint>
#include <powercell/results.hpp>
#include <vector>

namespace powercell::test {

using Point = std::array<double, 3>;

Point operator+(const Point& a, const Point& b);
Point operator-(const Point& a, const Point& b);
Point operator*(const Point& a, double s);
double dot(const Point& a, const Point& b);
Point cross(const Point& a, const Point& b);

/// A convex polygon or polyhedron. Of a polygon, `loops` is empty and border[k] lies behind the edge
/// from vertex k to k+1; of a polyhedron, loops[f] is seen counter-clockwise from outside.
struct Piece {
  std::vector<Point> vertices;
  std::vector<std::vector<std::uint32_t>> loops;
  std::vector<Border> border;
  bool empty() const { return vertices.empty(); }
};

/// The part of the piece with dot(normal, x) <= offset; the cut has the border `border`.
Piece clip(const Piece& piece, const Point& normal, double offset, Border border);

/// The piece as simplices (rows of 3 or 4 points).
std::vector<std::vector<Point>> simplices(const Piece& piece);
/// Area of a polygon in space given by its points in order.
double area(const std::vector<Point>& loop);

}  // namespace powercell::test
