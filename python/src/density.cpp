#include "python/src/density.hpp"

#include <nanobind/stl/pair.h>

#include <powercell/error.hpp>

#include "python/src/options.hpp"

namespace powercell::python {
namespace {

/// A function of Python.
class Function {
 public:
  Function(nb::object function, CallSlot& slot, int dimension)
      : function_(shared(std::move(function))), slot_(slot), dimension_(dimension) {}

  double operator()(const std::array<double, 3>& x) const {
    Call* const call = slot_.current();
    if (!call) throw Error(ErrorCode::internal, "a density was evaluated outside of a call");
    double value = 0;
    const bool ran = call->python([&] {
      nb::object point = dimension_ == 2 ? nb::object(nb::make_tuple(x[0], x[1]))
                                         : nb::object(nb::make_tuple(x[0], x[1], x[2]));
      value = nb::cast<double>(nb::float_((*function_)(*point)));
    });
    if (!ran) throw Error(ErrorCode::interrupted, "the density's function raised an exception");
    return value;
  }

 private:
  std::shared_ptr<nb::object> function_;
  CallSlot& slot_;
  int dimension_;
};

nb::object walls(nb::handle self) {
  DensityIntegrals& all = nb::cast<DensityIntegrals&>(self);
  if (all.walls.offset.empty()) return nb::none();
  const nb::object type = nb::module_::import_("powercell._results").attr("Adjacency");
  return type(nb::cast(&all.walls, nb::rv_policy::reference_internal, self), all.mass.size(),
              all.mass.empty() ? 0 : all.centroid.size() / all.mass.size());
}

#define POWERCELL_VECTOR(member) \
  def_prop_ro(#member, [](nb::handle self) { return view(nb::cast<DensityIntegrals&>(self).member, self); })

Density image_of(const nb::tuple& value) {
  const auto pixels = nb::cast<Matrix<double>>(value[0]);
  ImageView image{pixels.shape(1), pixels.shape(0), span_of(pixels)};
  for (std::size_t k = 0; k < 2; ++k) {
    image.low[k] = nb::cast<std::vector<double>>(value[1])[k];
    image.high[k] = nb::cast<std::vector<double>>(value[2])[k];
  }
  return Density::image(image);
}

}  // namespace

Density density_of(const nb::tuple& given, CallSlot& slot, int dimension) {
  const auto kind = nb::cast<std::string>(given[0]);
  if (kind == "constant") return Density::constant(nb::cast<double>(given[1]));
  if (kind == "formula") return Density::formula(nb::cast<std::string>(given[1]));
  if (kind == "function") return Density::function(Function(given[1], slot, dimension));
  if (kind == "image") return image_of(nb::cast<nb::tuple>(given[1]));
  return Density::nodal(span_of(nb::cast<Vector<double>>(given[1])));
}

IntegrationOptions integration_options(const nb::dict& given, CallSlot& slot) {
  IntegrationOptions options;
  options.walls = nb::cast<bool>(given["walls"]);
  options.tolerance = nb::cast<double>(given["tolerance"]);
  options.threads = whole<int>(given, "threads");
  const nb::object walls_if = given["walls_if"];
  if (walls_if.is_none()) return options;
  options.walls_if = [&slot, asked = shared(walls_if)](std::span<const double> mass) {
    bool wanted = false;
    const bool ran = slot.current()->python([&] {
      const nb::object masses = owned(std::vector<double>(mass.begin(), mass.end()), {mass.size()});
      wanted = nb::cast<bool>(nb::bool_((*asked)(masses)));
    });
    if (!ran) throw Error(ErrorCode::interrupted, "walls_if raised an exception");
    return wanted;
  };
  return options;
}

void bind_densities(nb::module_& m) {
  nb::class_<DensityIntegrals>(m, "DensityIntegrals",
                               R"(Integrals of a density over each cell, in the order of the seeds.

Attributes
----------
dimension : int
    d, the coordinates of a seed.
mass : (n,) float64
    Of the cell; 0 where empty.
centroid : (n, d) float64
    Weighted with the density; NaN where the mass is 0.
second_moment : (n,) float64
    Integral of the density times ``|x - p_i|^2``.
status : (n,) uint8
    A ``Status`` of each seed; of its cell, regardless of the mass.
domain_mass : float
    The integral over the domain.
mass_error : (n,) float64
    Estimated error of each mass where quadrature reached its limit; empty for constant densities.
quadrature_error : float
    The largest of them.
walls : Adjacency or None
    If wanted: integrals over the walls, with the neighbours of ``Diagram.adjacency``.
total : float
    The sum of the masses.
relative_error : float
    ``|total - domain_mass| / domain_mass``.)")
      .def_ro("dimension", &DensityIntegrals::dimension)
      .POWERCELL_VECTOR(mass)
      .def_prop_ro("centroid",
                   [](nb::handle self) {
                     const DensityIntegrals& all = nb::cast<DensityIntegrals&>(self);
                     return rows(all.centroid, static_cast<std::size_t>(all.dimension), self);
                   })
      .POWERCELL_VECTOR(second_moment)
      .def_prop_ro("status",
                   [](nb::handle self) {
                     const auto& status = nb::cast<DensityIntegrals&>(self).status;
                     return view(reinterpret_cast<const std::uint8_t*>(status.data()), {status.size()}, self);
                   })
      .def_ro("domain_mass", &DensityIntegrals::domain_mass)
      .POWERCELL_VECTOR(mass_error)
      .def_ro("quadrature_error", &DensityIntegrals::quadrature_error)
      .def_prop_ro("walls", &walls)
      .def_prop_ro("total", &DensityIntegrals::total)
      .def_prop_ro("relative_error", &DensityIntegrals::relative_error);
}

}  // namespace powercell::python
