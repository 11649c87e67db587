#include <powercell/point_sets.hpp>
#include <powercell/regions.hpp>
#include <powercell/remeshing.hpp>

#include "python/src/call.hpp"
#include "python/src/density.hpp"
#include "python/src/options.hpp"

namespace powercell::python {
namespace {

nb::object points_of_density(const Domain& domain, const nb::tuple& density, const nb::dict& given) {
  CallSlot slot;
  const Density of = density_of(density, slot, domain.dimension());
  const auto n = whole<std::size_t>(given, "n");
  const auto random_seed = whole<std::uint64_t>(given, "random_seed");
  std::vector<double> points =
      slot.run(nb::none(), [&] { return random_points(domain, of, n, random_seed); });
  return owned(std::move(points), {n, static_cast<std::size_t>(domain.dimension())});
}

/// \return the regions and the points
nb::tuple points_of_regions(const Domain& domain, const nb::dict& given) {
  const auto count = whole<std::size_t>(given, "count");
  const auto random_seed = whole<std::uint64_t>(given, "random_seed");
  const auto d = static_cast<std::size_t>(domain.dimension());
  std::vector<std::uint32_t> regions;
  std::vector<double> points;
  without_lock([&] {
    for (const RegionPoint& p : random_points(domain, count, random_seed)) {
      regions.push_back(p.region);
      points.insert(points.end(), p.point.begin(), p.point.begin() + static_cast<std::ptrdiff_t>(d));
    }
  });
  return nb::make_tuple(owned(std::move(regions), {count}), owned(std::move(points), {count, d}));
}

Spacing spacing_of(const Device& device, const Domain& domain, const Matrix<double>& positions, bool uniform,
                   const nb::dict& options) {
  Options with = options_of(options);
  const std::span all = span_of(positions);
  Call call{nb::none()};
  with.progress = [&](double) { return call.check(); };
  return call.run([&] { return spacing(device, domain, all, false, uniform, with); });
}

Spectrum spectrum_of(const Domain& box, const Matrix<double>& positions, const nb::dict& given) {
  const auto highest = whole<int>(given, "highest");
  const auto threads = whole<int>(given, "threads");
  const std::span all = span_of(positions);
  return without_lock([&] { return spectrum(box, all, highest, threads); });
}

nb::object power(nb::handle self) {
  const Spectrum& s = nb::cast<Spectrum&>(self);
  return rows(s.power, 2 * static_cast<std::size_t>(s.highest) + 1, self);
}

template <class T>
std::vector<T> copied(const Matrix<T>& values) {
  return {values.data(), values.data() + values.size()};
}

}  // namespace

void bind_point_sets(nb::module_& m) {
  nb::class_<Spacing>(m, "Spacing", R"(Distances and angles between Voronoi neighbours.

Attributes
----------
least, mean : float
    Distance of a point to its nearest neighbour, over that of the densest lattice with cells of the same measure.
hexatic : float
    1 in the hexagonal lattice, about 0.37 for random points; NaN unless the domain is in the plane.)")
      .def_ro("least", &Spacing::least)
      .def_ro("mean", &Spacing::mean)
      .def_ro("hexatic", &Spacing::hexatic);

  nb::class_<Spectrum::Radial>(m, "Radial", R"(A spectrum by the length of the frequency.

Attributes
----------
mean : (F,) float64
    For ``|f|`` = 1, 2, ... F: mean of the power over a ring of width 1.
anisotropy : (F,) float64
    Variance over the ring divided by the square of the mean; 1 / runs if isotropic.)")
      .def_prop_ro("mean", [](nb::handle self) { return view(nb::cast<Spectrum::Radial&>(self).mean, self); })
      .def_prop_ro("anisotropy",
                   [](nb::handle self) { return view(nb::cast<Spectrum::Radial&>(self).anisotropy, self); });

  nb::class_<Spectrum>(m, "Spectrum", R"(Power spectrum of points in a periodic box.

Attributes
----------
highest : int
    F: components of the frequency, whole numbers of waves per width and height, range from -F to F.
power : (2F + 1, 2F + 1) float64
    ``|sum over j of exp(-2 pi i f.x_j)|^2 / n``: rows by f_y, columns by f_x, both ascending.
points : int
    n.
runs : int
    Number of point sets averaged.)")
      .def_ro("highest", &Spectrum::highest)
      .def_prop_ro("power", &power)
      .def_ro("points", &Spectrum::points)
      .def_ro("runs", &Spectrum::runs)
      .def("radial", &Spectrum::radial, "Mean and anisotropy over rings of frequencies.")
      .def("low_frequency", &Spectrum::low_frequency, "fraction"_a = 0.5,
           "Mean power over the frequencies ``0 < |f| <= fraction * sqrt(n)``; 0 if there are none.")
      .def_static(
          "mean", [](const std::vector<Spectrum>& spectra) { return mean(spectra); }, "spectra"_a,
          "The average of spectra of the same F and n, weighted by their runs.");

  m.def("random_points", &points_of_density, "domain"_a, "density"_a, "given"_a);
  m.def("region_points", &points_of_regions, "domain"_a, "given"_a);
  m.def("spacing", &spacing_of, "device"_a, "domain"_a, "positions"_a, "uniform"_a, "options"_a);
  m.def("spectrum", &spectrum_of, "box"_a, "positions"_a, "given"_a);
  m.def("farthest_from", [](const Matrix<double>& vertices, const Matrix<std::uint32_t>& triangles,
                            const Matrix<double>& other_vertices,
                            const Matrix<std::uint32_t>& other_triangles, const nb::dict& given) {
    const TriangleMesh a{copied(vertices), copied(triangles)};
    const TriangleMesh b{copied(other_vertices), copied(other_triangles)};
    const auto samples = whole<std::size_t>(given, "samples");
    return without_lock([&] { return farthest_from(a, b, samples); });
  });
}

}  // namespace powercell::python
