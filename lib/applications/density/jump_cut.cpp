#include "lib/applications/density/jump_cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "lib/applications/density/barycentric.hpp"

namespace powercell {
namespace {

/// Position of a jump between two points, as a fraction, and the density on both sides of it.
struct Jump {
  double at = 0, before = 0, after = 0;
};

class Cutter {
 public:
  Cutter(int dimension, std::span<const double> corner, const ValuesAt& values, double allowed, double most,
         JumpCut& cut)
      : n_(static_cast<std::size_t>(dimension)),
        corner_(corner),
        values_(values),
        allowed_(allowed),
        most_error_(most),
        cut_(cut) {
    cut_.terms.clear();
    cut_.error = 0;
  }

  bool run() {
    if (!find_sides() || !edges_agree()) return false;
    if (!add_bends()) return false;
    add_side(0, [&](std::size_t i, std::size_t j) { return crossing_[i][j]; });
    add_side(1, [&](std::size_t j, std::size_t i) { return crossing_[i][j]; });
    cut_.error += static_cast<double>(n_) * crossing_error_;
    apply_rules();
    return true;
  }

 private:
  static Barycentric corner_at(std::size_t c) {
    Barycentric point{};
    point[c] = 1;
    return point;
  }

  double value_at(const Barycentric& point) const {
    double value = 0;
    values_({&point, 1}, {&value, 1});
    return value;
  }

  /// Bisects repeatedly towards the half with the larger change: at a jump the change remains, elsewhere it
  /// vanishes.
  std::optional<Jump> jump_between(const Barycentric& a, const Barycentric& b, double at_a, double at_b) {
    constexpr double remains = 0.25;         // share of the first change that a jump keeps
    constexpr double position_error = 0.05;  // share of the allowed error spent on the position of the jump
    constexpr double nearest = 0x1p-44;      // fractions of the way nearer than this are lost in rounding
    const double change = std::abs(at_b - at_a);
    if (!(change > allowed_)) return std::nullopt;
    const double width = std::max(nearest, position_error * allowed_ / change);
    crossing_error_ = std::max(crossing_error_, width * change);
    double low = 0, high = 1;
    while (high - low > width) {
      const double middle = (low + high) / 2, value = value_at(between(a, b, middle));
      if (std::abs(value - at_a) > std::abs(at_b - value)) {
        high = middle;
        at_b = value;
      } else {
        low = middle;
        at_a = value;
      }
      if (!(std::abs(at_b - at_a) > remains * change)) return std::nullopt;
    }
    return Jump{(low + high) / 2, at_a, at_b};
  }

  /// Divides the corners by the jumps on the edges: those without a jump on the edge to the first are on its
  /// side. False if the edges contradict each other or have no jump.
  bool find_sides() {
    std::array<std::size_t, most_corners> side{};
    for (std::size_t a = 0; a < n_; ++a)
      for (std::size_t b = a + 1; b <= n_; ++b) {
        jump_[a][b] = jump_between(corner_at(a), corner_at(b), corner_[a], corner_[b]);
        if (a == 0) side[b] = jump_[a][b] ? 1 : 0;
        if (jump_[a][b].has_value() != (side[a] != side[b])) return false;
        if (a == 0 && b == n_ && std::ranges::count(side, 1) == 0) return false;
      }
    for (std::size_t c = 0; c <= n_; ++c) side_[side[c]].push_back(c);
    for (std::size_t i = 0; i < side_[0].size(); ++i)
      for (std::size_t j = 0; j < side_[1].size(); ++j) {
        const std::size_t a = side_[0][i], b = side_[1][j];
        const Jump& found = *jump_[std::min(a, b)][std::max(a, b)];
        crossing_[i][j] = between(corner_at(std::min(a, b)), corner_at(std::max(a, b)), found.at);
        record(a < b ? found : Jump{1 - found.at, found.after, found.before});
      }
    return true;
  }

  /// Whether each edge crosses the jump at most once, judged by three points on it.
  bool edges_agree() const {
    for (std::size_t a = 0; a < n_; ++a)
      for (std::size_t b = a + 1; b <= n_; ++b)
        for (const double at : {0.25, 0.5, 0.75}) {
          const std::optional<Jump>& jump = jump_[a][b];
          double expected = corner_[a] + at * (corner_[b] - corner_[a]);
          if (jump && at < jump->at)
            expected = corner_[a] + at / jump->at * (jump->before - corner_[a]);
          else if (jump)
            expected = corner_[b] + (1 - at) / (1 - jump->at) * (jump->after - corner_[b]);
          const double found = value_at(between(corner_at(a), corner_at(b), at));
          if (!(std::abs(found - expected) <= height() / 2)) return false;
        }
    return true;
  }

  /// \param jump  from the first side to the other
  void record(const Jump& jump) {
    const double height = jump.before - jump.after;
    least_ = std::min(least_, height);
    most_ = std::max(most_, height);
    sum_at_[0] += jump.before;
    sum_at_[1] += jump.after;
    ++jump_count_;
  }

  double height() const { return std::max(std::abs(least_), std::abs(most_)); }

  /// Whether it is one jump: of one sign and of similar height everywhere.
  bool is_single() const {
    constexpr double largest_ratio = 4;  // of two heights
    return least_ > 0 ? most_ <= largest_ratio * least_ : most_ < 0 && least_ >= largest_ratio * most_;
  }

  /// Direction from the corners of the first side to those of the other, within the face of the simplex that
  /// contains the point, so that simplices sharing that face agree there.
  Barycentric way_across(const Barycentric& point) const {
    Barycentric way{};
    for (std::size_t s = 0; s < 2; ++s) {
      double count = 0;
      for (const std::size_t c : side_[s]) count += point[c] > 0 ? 1 : 0;
      for (const std::size_t c : side_[s])
        if (point[c] > 0) way[c] = (s == 0 ? -1 : 1) / count;
    }
    return way;
  }

  /// The jump on the line across through a point.
  struct Bend {
    Barycentric moved{};  // displacement from that point
    double height = 0;
  };
  std::optional<Bend> bend_at(const Barycentric& point) {
    const Barycentric way = way_across(point);
    double low = -std::numeric_limits<double>::infinity(), high = -low;  // within the simplex
    for (std::size_t c = 0; c <= n_; ++c) {
      if (way[c] > 0) low = std::max(low, -point[c] / way[c]);
      if (way[c] < 0) high = std::min(high, -point[c] / way[c]);
    }
    if (!(low < 0 && high > 0 && high - low < 2)) return std::nullopt;
    std::array<Barycentric, 2> end{point, point};
    for (std::size_t c = 0; c <= n_; ++c) {
      end[0][c] = std::max(0.0, end[0][c] + low * way[c]);
      end[1][c] = std::max(0.0, end[1][c] + high * way[c]);
    }
    const std::optional<Jump> jump = jump_between(end[0], end[1], value_at(end[0]), value_at(end[1]));
    if (!jump) return std::nullopt;
    record(*jump);
    Bend bend{.moved = {}, .height = jump->before - jump->after};
    const double moved = low + jump->at * (high - low);
    for (std::size_t c = 0; c <= n_; ++c) bend.moved[c] = moved * way[c];
    return bend;
  }

  /// Adds the integral over the lenses between the jump and the flat faces through its crossings.
  bool add_bends() {
    bool complete = true;
    for_paths(side_[0].size(), side_[1].size(), [&](const auto& path) {
      Patch patch;
      for (std::size_t k = 0; k < n_; ++k) patch.corner[k] = crossing_[path[k].first][path[k].second];
      complete = complete && add_bend_of(patch);
    });
    return complete && is_single();
  }

  /// A flat face, and the quadratic patch that also passes through the jump at the middles of its edges.
  struct Patch {
    Corners corner{};
    ByCorners<Barycentric> moved{};  // displacement of the middle between two corners
  };

  /// A point of the flat face, the tangents there, and its displacement to the patch.
  struct PatchPoint {
    Corners tangent{};  // n - 1 of them; the last row is free for another vector
    Barycentric flat{}, moved{};
  };
  PatchPoint at_patch(const Patch& patch, const Barycentric& at) const {
    PatchPoint found;
    const std::size_t last = n_ - 1;
    for (std::size_t c = 0; c <= n_; ++c) {
      for (std::size_t k = 0; k < n_; ++k) {
        found.flat[c] += at[k] * patch.corner[k][c];
        if (k < last) found.tangent[k][c] += patch.corner[k][c] - patch.corner[last][c];
      }
      for (std::size_t a = 0; a < n_; ++a)
        for (std::size_t b = a + 1; b < n_; ++b) found.moved[c] += 4 * at[a] * at[b] * patch.moved[a][b][c];
    }
    return found;
  }
  /// Adds `part` times the derivatives of the displacement to the tangents of the flat face.
  void add_slopes(const Patch& patch, const Barycentric& at, double part, Corners& tangent) const {
    const std::size_t last = n_ - 1;
    for (std::size_t a = 0; a < n_; ++a)
      for (std::size_t b = a + 1; b < n_; ++b)
        for (std::size_t k = 0; k < last; ++k) {
          const double slope = (a == k ? at[b] : 0) + (b == k ? at[a] : 0) - (b == last ? at[a] : 0);
          for (std::size_t c = 0; c <= n_; ++c) tangent[k][c] += 4 * part * slope * patch.moved[a][b][c];
        }
  }

  bool add_bend_of(Patch& patch) {
    double height = 0;
    for (std::size_t a = 0; a < n_; ++a)
      for (std::size_t b = a + 1; b < n_; ++b) {
        const std::optional<Bend> bend = bend_at(between(patch.corner[a], patch.corner[b], 0.5));
        if (!bend) return false;
        patch.moved[a][b] = bend->moved;
        height += bend->height / (n_ == 2 ? 1 : 3);
      }
    if (n_ == 1) return true;
    const std::span<const Barycentric> checks = check_points();
    for (const Barycentric& at : checks) {
      PatchPoint point = at_patch(patch, at);
      const std::optional<Bend> bend = bend_at(point.flat);
      if (!bend) return false;
      add_slopes(patch, at, 1, point.tangent);
      for (std::size_t c = 0; c <= n_; ++c) point.tangent[n_ - 1][c] = bend->moved[c] - point.moved[c];
      cut_.error += std::abs(height * static_cast<double>(n_) * determinant(n_, point.tangent)) /
                    static_cast<double>(checks.size());
    }
    add_lens(patch, height);
    return cut_.error <= most_error_;
  }

  /// Points of the face where the patch is compared with the jump: quarters of a segment, the middle of a
  /// triangle.
  std::span<const Barycentric> check_points() const {
    static constexpr std::array<Barycentric, 2> quarters{{{0.75, 0.25}, {0.25, 0.75}}};
    static constexpr std::array<Barycentric, 1> middle{{{1.0 / 3, 1.0 / 3, 1.0 / 3}}};
    return n_ == 2 ? std::span<const Barycentric>(quarters) : std::span<const Barycentric>(middle);
  }

  /// Between the flat face and the patch the density is off by the height of the jump. The integrand of (32b)
  /// is a polynomial for which rule 2 on the face and two-point Gauss quadrature across it are exact.
  void add_lens(const Patch& patch, double height) {
    constexpr std::size_t rule = 2;
    const SimplexRules& rules = simplex_rules(static_cast<int>(n_) - 1);
    const double sign = sign_towards_other(patch);
    for (std::size_t s = 0, q = 0; s <= rule; ++s)
      for (; q < rules.size[s]; ++q)
        for (const double part : {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)}) {
          PatchPoint point = at_patch(patch, rules.point[q]);
          add_slopes(patch, rules.point[q], part, point.tangent);
          point.tangent[n_ - 1] = point.moved;
          const double share = static_cast<double>(n_) * determinant(n_, point.tangent) / 2;
          const double mass = sign * height * rules.weight[rule][s] * share;
          for (std::size_t c = 0; c <= n_; ++c) point.flat[c] += part * point.moved[c];
          cut_.terms.push_back({point.flat, mass, mass});
        }
  }

  /// The sign of determinants whose last vector points to the other side.
  double sign_towards_other(const Patch& patch) const {
    Corners row = at_patch(patch, {}).tangent;
    row[n_ - 1] = way_across({0.25, 0.25, 0.25, 0.25});
    return determinant(n_, row) < 0 ? -1 : 1;
  }

  /// Adds the simplices between the corners of a side and the flat faces.
  template <class Crossing>
  void add_side(std::size_t side, const Crossing& crossing) {
    const std::vector<std::size_t>& own = side_[side];
    for_paths(own.size(), n_ + 2 - own.size(), [&](const auto& path) {
      Corners part{};
      for (std::size_t k = 0; k <= n_; ++k) {
        const auto& [row, column] = path[k];
        part[k] = column == 0 ? corner_at(own[row]) : crossing(row, column - 1);
      }
      const double share = std::abs(determinant(n_ + 1, part));
      if (share > 0) parts_.push_back({part, share, side});
    });
  }

  void apply_rules() {
    const std::size_t last = n_ == 3 ? 2 : 3;  // of SimplexRules; lower in space, where there are many parts
    const SimplexRules& rules = simplex_rules(static_cast<int>(n_));
    std::vector<Barycentric> points;
    for (const PartOfSide& part : parts_)
      for (std::size_t q = 0; q < rules.size[last]; ++q) {
        Barycentric point{};
        for (std::size_t k = 0; k <= n_; ++k)
          for (std::size_t c = 0; c <= n_; ++c) point[c] += rules.point[q][k] * part.corner[k][c];
        points.push_back(point);
      }
    std::vector<double> values(points.size());
    values_(points, values);
    std::size_t at = 0;
    for (const PartOfSide& one : parts_) {
      keep_to_side(one, std::span(values).subspan(at, rules.size[last]));
      for (std::size_t s = 0, q = 0; s <= last; ++s)
        for (; q < rules.size[s]; ++q, ++at) {
          const double part = one.share * values[at];
          cut_.terms.push_back(
              {points[at], part * rules.weight[last][s], s < last ? part * rules.weight[last - 1][s] : 0.0});
        }
    }
  }

  struct PartOfSide {
    Corners corner{};
    double share = 0;  // of the measure of the simplex
    std::size_t side = 0;
  };

  /// In a part that is thin compared with the bend of the jump, points may lie beyond the jump. If the sides
  /// are clearly apart, such values are replaced by the mean of the others.
  void keep_to_side(const PartOfSide& part, std::span<double> values) {
    const double own = sum_at_[part.side] / static_cast<double>(jump_count_);
    const auto is_stray = [&](double value) { return std::abs(value - own) > height() / 2; };
    double sum = 0, least = std::numeric_limits<double>::infinity(), most = -least;
    std::size_t kept = 0;
    for (const double value : values) {
      if (is_stray(value)) continue;
      sum += value;
      least = std::min(least, value);
      most = std::max(most, value);
      ++kept;
    }
    if (kept == values.size()) return;
    const bool apart = kept > 0 && most - least < height() / 8;
    cut_.error += part.share * (apart ? most - least : std::ranges::max(values) - std::ranges::min(values));
    if (!apart) return;
    for (double& value : values)
      if (is_stray(value)) value = sum / static_cast<double>(kept);
  }

  std::size_t n_;
  std::span<const double> corner_;
  const ValuesAt& values_;
  double allowed_, most_error_;
  JumpCut& cut_;
  ByCorners<std::optional<Jump>> jump_;                                      // from a corner to a later one
  std::array<std::vector<std::size_t>, 2> side_;                             // the corners of each side
  ByCorners<Barycentric> crossing_{};                                        // by positions in side_
  double least_ = std::numeric_limits<double>::infinity(), most_ = -least_;  // heights of the jump
  double crossing_error_ = 0;       // error of the mass from the width at which a bisection ended
  std::array<double, 2> sum_at_{};  // sums of the density next to the jump, over the jumps found
  std::size_t jump_count_ = 0;
  std::vector<PartOfSide> parts_;
};

}  // namespace

bool cut_at_jump(int dimension, std::span<const double> corner, const ValuesAt& values, double allowed,
                 double most, JumpCut& cut) {
  return Cutter(dimension, corner, values, allowed, most, cut).run();
}

}  // namespace powercell
