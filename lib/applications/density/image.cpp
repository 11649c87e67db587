#include <algorithm>
#include <cmath>

#include "lib/applications/density/geometric.hpp"
#include "lib/applications/density/pixels.hpp"
#include "lib/base/text.hpp"

namespace powercell {
namespace {

using Place = std::array<double, 2>;  // in pixel coordinates

/// Where a segment is cut. Left and right of the image the columns make no difference, and it may span very
/// many of them, so it is cut at rows only.
enum class CutAt { pixels, rows };

/// Cuts the segment from a to b and calls `visit(from, to)` for each part, in order.
template <class Visit>
void cut_segment(const Place& a, const Place& b, CutAt where, const Visit& visit) {
  struct Crossings {
    double next, step, end;  // the next border, the step to the one after, and the end of the segment
    double from, slope;      // fraction of the segment at a border: (border - from) * slope
    double fraction() const {
      return (step > 0 ? next < end : step < 0 && next > end) ? (next - from) * slope : 2.0;
    }
  };
  std::array<Crossings, 2> axis;
  for (std::size_t k = 0; k < 2; ++k) {
    const double way = k == 0 && where == CutAt::rows ? 0 : b[k] - a[k];
    const double step = way > 0 ? 1 : way < 0 ? -1 : 0;
    axis[k] = {step > 0 ? std::floor(a[k]) + 1 : std::ceil(a[k]) - 1, step, b[k], a[k],
               step == 0 ? 0 : 1 / way};
  }
  Place from = a;
  for (;;) {
    const double s = axis[0].fraction(), t = axis[1].fraction();
    if (s > 1 && t > 1) break;
    const std::size_t k = s <= t ? 0 : 1;
    const double at = std::min(s, t);
    Place to{a[0] + at * (b[0] - a[0]), a[1] + at * (b[1] - a[1])};
    to[k] = axis[k].next;
    axis[k].next += axis[k].step;
    visit(from, to);
    from = to;
  }
  visit(from, b);
}

/// The point at fraction t of a segment.
Place on_segment(const Place& a, const Place& b, double t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

/// Fractions of the way from a to b at which it enters and leaves [0, end]; the first is the larger if it
/// does not meet the interval.
std::array<double, 2> passage(double a, double b, double end) {
  if (a == b) return a >= 0 && a <= end ? std::array{0.0, 1.0} : std::array{1.0, 0.0};
  const double s = -a / (b - a), t = (end - a) / (b - a);
  return {std::max(std::min(s, t), 0.0), std::min(std::max(s, t), 1.0)};
}

/// Visits the parts of a segment within the rows of the image, cut at the borders of pixels.
template <class Visit>
void walk(const Place& a, const Place& b, const Pixels& pixels, const Visit& visit) {
  const auto [in, out] = passage(a[1], b[1], pixels.height());
  if (in > out) return;
  // Ends that are not cut keep their exact coordinates, so that consecutive segments still meet.
  const Place from = in > 0 ? on_segment(a, b, in) : a, to = out < 1 ? on_segment(a, b, out) : b;
  const auto [left, right] = passage(from[0], to[0], pixels.width());
  if (left > right) return cut_segment(from, to, CutAt::rows, visit);
  const Place first = left > 0 ? on_segment(from, to, left) : from,
              last = right < 1 ? on_segment(from, to, right) : to;
  if (left > 0) cut_segment(from, first, CutAt::rows, visit);
  cut_segment(first, last, CutAt::pixels, visit);
  if (right < 1) cut_segment(last, to, CutAt::rows, visit);
}

/// Row or column of the pixel that contains the part from a to b; outside the image any index outside.
std::ptrdiff_t pixel_of(double a, double b) {
  return static_cast<std::ptrdiff_t>(std::clamp(std::floor((a + b) / 2), -1.0, 0x1p53));
}

/// Green's theorem, (33): with R(u, v) the integral of the density along the row up to u, the mass is the
/// integral of R dv around the piece, and the moments likewise. R starts at the column of the origin, which
/// changes nothing around a closed curve and keeps the terms small.
class ImageIntegrator : public PieceIntegrator {
 public:
  explicit ImageIntegrator(const Pixels& pixels) : pixels_(pixels) {}

  void add(const Piece& piece, Moments& moments) override {
    origin_ = pixels_.pixels(moments.origin[0], moments.origin[1]);
    sum_ = {};
    Place from = place(piece, piece.vertex_count() - 1);
    for (std::uint64_t k = 0; k < piece.vertex_count(); ++k) {
      const Place to = place(piece, k);
      walk(from, to, pixels_, [&](const Place& a, const Place& b) { add_part(a, b); });
      from = to;
    }
    // A piece without density gets the rounding errors of terms that cancel.
    constexpr double rounding = 0x1p-44;  // of the largest term
    if (std::abs(sum_.mass) <= rounding * sum_.largest) return;
    const auto [w, h] = pixels_.size();
    const double area = w * h;
    moments.mass += area * sum_.mass;
    moments.first[0] += area * w * sum_.u;
    moments.first[1] += area * h * sum_.v;
    moments.second += area * (w * w * sum_.uu + h * h * sum_.vv);
  }

  double over_face(const Piece& piece, std::uint64_t face) override {
    const auto [w, h] = pixels_.size();
    double sum = 0;
    walk(place(piece, piece.corner(face, 0)), place(piece, piece.corner(face, 1)), pixels_,
         [&, w = w, h = h](const Place& a, const Place& b) {
           const double length = std::hypot(w * (b[0] - a[0]), h * (b[1] - a[1]));
           sum += length * pixels_.value(pixel_of(a[1], b[1]), pixel_of(a[0], b[0]));
         });
    return sum;
  }

 private:
  struct Sum {
    double mass = 0, u = 0, v = 0, uu = 0, vv = 0;
    double largest = 0;  // largest term of the mass
  };

  Place place(const Piece& piece, std::uint64_t k) const {
    const Point x = piece.vertex(k);
    return pixels_.pixels(x[0], x[1]);
  }

  /// Adds a part of an edge within one pixel. The integrands are cubic along it, so two-point Gauss
  /// quadrature is exact.
  void add_part(const Place& a, const Place& b) {
    const double dv = b[1] - a[1];
    if (dv == 0) return;
    const std::ptrdiff_t row = pixel_of(a[1], b[1]), column = pixel_of(a[0], b[0]);
    const double origin_u = std::clamp(origin_[0], 0.0, pixels_.width());
    const Pixels::Sums base = pixels_.sums(row, static_cast<std::ptrdiff_t>(origin_u), origin_u);
    constexpr double gauss = 0.21132486540518711775;  // (1 - 1/sqrt 3) / 2
    for (const double t : {gauss, 1 - gauss}) {
      const double u = a[0] + t * (b[0] - a[0]), v = a[1] + t * dv - origin_[1];
      const Pixels::Sums at = pixels_.sums(row, column, u);
      const double zeroth = at.zeroth - base.zeroth, first = at.first - base.first;
      const double second = at.second - base.second, s = origin_[0], weight = dv / 2;
      sum_.mass += weight * zeroth;
      sum_.largest = std::max(sum_.largest, std::abs(weight * zeroth));
      sum_.u += weight * (first - s * zeroth);
      sum_.v += weight * v * zeroth;
      sum_.uu += weight * (second - 2 * s * first + s * s * zeroth);
      sum_.vv += weight * v * v * zeroth;
    }
  }

  const Pixels& pixels_;
  Place origin_{};
  Sum sum_;
};

/// The values of the pixels that contain the points.
class PixelSource : public PointSource {
 public:
  explicit PixelSource(const Pixels& pixels) : pixels_(pixels) {}
  void evaluate(std::span<const Point> x, std::uint32_t, std::span<double> values) override {
    for (std::size_t k = 0; k < x.size(); ++k) {
      const auto [u, v] = pixels_.pixels(x[k][0], x[k][1]);
      values[k] = pixels_.value(pixel_of(v, v), pixel_of(u, u));
    }
  }

 private:
  const Pixels& pixels_;
};

class Image : public GeometricDensity {
 public:
  explicit Image(const ImageView& image) : pixels_(image) {}

  std::unique_ptr<PointSource> source(const Domain& domain) const override {
    require_plane(domain);
    return std::make_unique<PixelSource>(pixels_);
  }
  bool exact() const override { return true; }

 protected:
  std::unique_ptr<PieceIntegrator> integrator(const Domain& domain, const Accuracy&) const override {
    require_plane(domain);
    require_pixels_in_reach(domain);
    return std::make_unique<ImageIntegrator>(pixels_);
  }

 private:
  static void require_plane(const Domain& domain) {
    if (domain.kind() != DomainKind::polygon)
      throw Error(ErrorCode::unsupported, "an image is a density of the plane: the domain must be a polygon");
  }

  /// The rounding of pixel coordinates must be a small part of a pixel.
  void require_pixels_in_reach(const Domain& domain) const {
    constexpr double most = 1e12;  // pixels; their rounding is 1e-4
    for (const auto& corner : {domain.low(), domain.high()}) {
      const Place at = pixels_.pixels(corner[0], corner[1]);
      if (!(std::abs(at[0]) <= most && std::abs(at[1]) <= most))
        throw Error(ErrorCode::invalid_argument,
                    "the image is too small or too far from the domain: a corner of the domain is " +
                        digits(std::max(std::abs(at[0]), std::abs(at[1])), 3) + " pixels from the image");
    }
  }

  Pixels pixels_;
};

}  // namespace

DensityModelPtr make_image(const ImageView& image) {
  return std::make_shared<Image>(image);
}

}  // namespace powercell
