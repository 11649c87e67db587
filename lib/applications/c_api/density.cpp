#include "lib/applications/c_api/density.hpp"

#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"
#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

static_assert(Density::largest_value == PC_LARGEST_DENSITY);

constexpr double default_tolerance = 1e-9;  // of Density::formula

struct Integrals {
  DensityIntegrals all;
  pc_adjacency walls;
};

pc_integration_options defaults() {
  return {};
}

IntegrationOptions integration_options(const pc_integration_options* options) {
  const pc_integration_options from = current(options, defaults(), "pc_integration_options");
  IntegrationOptions to;
  to.walls = from.walls != 0;
  to.tolerance = from.tolerance;
  to.threads = from.threads;
  if (from.walls_if)
    to.walls_if = [call = from.walls_if, user = from.walls_if_user](std::span<const double> mass) {
      return call_back("walls_if", [&] { return call(mass.data(), mass.size(), user); }) != 0;
    };
  return to;
}

void fill(pc_density_integrals& to, Integrals& of) {
  const DensityIntegrals& from = of.all;
  to.count = from.mass.size();
  to.dimension = from.dimension;
  to.mass = pointer(from.mass);
  to.centroid = pointer(from.centroid);
  to.second_moment = pointer(from.second_moment);
  to.status = pointer(from.status);
  to.domain_mass = from.domain_mass;
  to.total = from.total();
  to.relative_error = from.relative_error();
  to.mass_error = pointer(from.mass_error);
  to.quadrature_error = from.quadrature_error;
  of.walls = view_of(from.walls);
  to.walls = from.walls.offset.empty() ? nullptr : &of.walls;
}

}  // namespace

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_density_constant(double value, pc_density** density) {
  return guarded([&] {
    result_at(density);
    hand_over(density, Density::constant(value));
  });
}

pc_status pc_density_formula(const char* expression, double tolerance, pc_density** density) {
  return guarded([&] {
    result_at(density);
    checked(expression, "expression");
    hand_over(density, Density::formula(expression, tolerance == 0 ? default_tolerance : tolerance));
  });
}

pc_status pc_density_function(pc_density_value function, void* user, double tolerance, pc_density** density) {
  return guarded([&] {
    result_at(density);
    require(function != nullptr, "function is NULL");
    const auto value = [function, user](const std::array<double, 3>& point) {
      double result = 0;
      const int went = call_back("the density", [&] { return function(point.data(), &result, user); });
      if (went == 0) throw Error(ErrorCode::interrupted, "the density's function asked to stop");
      return result;
    };
    hand_over(density, Density::function(value, tolerance == 0 ? default_tolerance : tolerance));
  });
}

pc_status pc_density_image(const double* values, size_t width, size_t height, const double* low,
                           const double* high, pc_density** density) {
  return guarded([&] {
    result_at(density);
    require(width != 0 && height != 0, "width and height must be above 0");
    ImageView image{width, height, rows_view(values, height, width, "values")};
    for (std::size_t k = 0; k < 2; ++k) {
      image.low[k] = view(low, 2, "low")[k];
      image.high[k] = view(high, 2, "high")[k];
    }
    hand_over(density, Density::image(image));
  });
}

pc_status pc_density_nodal(const double* values, size_t count, pc_density** density) {
  return guarded([&] {
    result_at(density);
    hand_over(density, Density::nodal(view(values, count, "values")));
  });
}

void pc_density_destroy(pc_density* density) {
  delete density;
}

pc_status pc_density_is_constant(const pc_density* density, int* is_constant) {
  return guarded([&] { result_at(is_constant) = density_in(density).is_constant(); });
}

pc_status pc_density_is_exact(const pc_density* density, int* is_exact) {
  return guarded([&] { result_at(is_exact) = density_in(density).is_exact(); });
}

pc_status pc_density_total(const pc_density* density, const pc_domain* domain, int threads, double* total) {
  return guarded([&] { result_at(total) = density_in(density).total(domain_in(domain), threads); });
}

pc_status pc_integration_options_init(pc_integration_options* options, size_t struct_size) {
  return init(options, struct_size, defaults(), "pc_integration_options");
}

pc_status pc_integrate(pc_diagram* diagram, const pc_density* density, const pc_integration_options* options,
                       const pc_density_integrals** integrals) {
  return guarded([&] {
    result_at(integrals);
    Diagram& of = diagram_in(diagram);
    hand_over_result(integrals,
                     Integrals{integrate(of, density_in(density), integration_options(options)), {}}, fill);
  });
}

void pc_density_integrals_destroy(const pc_density_integrals* integrals) {
  destroy_result<Integrals>(integrals);
}

}  // extern "C"
