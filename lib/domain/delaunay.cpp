#include <cmath>

#include "lib/domain/orientation.hpp"
#include "lib/domain/triangulation.hpp"

namespace powercell {
namespace {

constexpr std::size_t flips_per_edge = 16;  // at most, so that the work stays linear

/// True if d is certainly inside the circle through a, b, c (counter-clockwise). Where rounding leaves it
/// open, either diagonal is as good.
bool surely_in_circle(const double* a, const double* b, const double* c, const double* d) {
  long double x[3], y[3], square[3];
  const double* corner[3] = {a, b, c};
  for (int k = 0; k < 3; ++k) {
    x[k] = static_cast<long double>(corner[k][0]) - d[0];
    y[k] = static_cast<long double>(corner[k][1]) - d[1];
    square[k] = x[k] * x[k] + y[k] * y[k];
  }
  long double sum = 0, size = 0;
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    sum += square[k] * (x[l] * y[m] - x[m] * y[l]);
    size += square[k] * (std::fabs(x[l] * y[m]) + std::fabs(x[m] * y[l]));
  }
  return sum > 1e-15L * size;
}

/// Lawson's flips. Each one lowers the triangulation lifted to the paraboloid by more than the rounding
/// errors, so they terminate; a limit on their number keeps the worst case linear. Stopping early affects
/// only the shape of some triangles.
class Flips {
 public:
  Flips(const IndexedRings& rings, Triangulation& mesh) : at_(rings), mesh_(mesh) {}

  void run() {
    for (std::uint32_t h = 0; h < mesh_.corner.size(); ++h) {
      if (mesh_.twin[h] != no_twin && h < mesh_.twin[h]) pending_.push_back(h);
    }
    std::size_t left = flips_per_edge * mesh_.corner.size();
    while (!pending_.empty() && left > 0) {
      const std::uint32_t h = pending_.back();
      pending_.pop_back();
      if (mesh_.twin[h] == no_twin || !should_flip(h)) continue;
      flip(h);
      --left;
    }
  }

 private:
  static std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::uint32_t before(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  const double* from(std::uint32_t h) const { return at_.at(mesh_.corner[h]); }

  bool should_flip(std::uint32_t h) const {
    const std::uint32_t t = mesh_.twin[h];
    const double *a = from(h), *b = from(t), *c = from(before(h)), *d = from(before(t));
    return surely_in_circle(a, b, c, d) && orient2d(c, a, d) > 0 && orient2d(d, b, c) > 0;
  }

  void set_twin(std::uint32_t h, std::uint32_t t) {
    mesh_.twin[h] = t;
    if (t != no_twin) mesh_.twin[t] = h;
  }

  /// Replaces the triangles a b c and b a d by c a d and d b c.
  void flip(std::uint32_t h) {
    const std::uint32_t t = mesh_.twin[h];
    const std::uint32_t h_next = next(h), h_before = before(h), t_next = next(t), t_before = before(t);
    const std::uint32_t a = mesh_.corner[h], b = mesh_.corner[t], c = mesh_.corner[h_before],
                        d = mesh_.corner[t_before];
    const std::uint32_t bc = mesh_.twin[h_next], ca = mesh_.twin[h_before], ad = mesh_.twin[t_next],
                        db = mesh_.twin[t_before];
    // h: c a d as half-edges h_before (c a), h (a d), h_next (d c); t: d b c likewise.
    mesh_.corner[h_before] = c, mesh_.corner[h] = a, mesh_.corner[h_next] = d;
    mesh_.corner[t_before] = d, mesh_.corner[t] = b, mesh_.corner[t_next] = c;
    set_twin(h_before, ca), set_twin(h, ad), set_twin(t_before, db), set_twin(t, bc);
    set_twin(h_next, t_next);
    pending_.insert(pending_.end(), {h_before, h, t_before, t});
  }

  const IndexedRings& at_;
  Triangulation& mesh_;
  std::vector<std::uint32_t> pending_;
};

}  // namespace

void make_delaunay(const IndexedRings& rings, Triangulation& mesh) {
  Flips(rings, mesh).run();
}

}  // namespace powercell
