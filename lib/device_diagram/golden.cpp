#include "lib/device_diagram/golden.hpp"

#include "lib/clip/golden.hpp"
#include "lib/device_diagram/device_diagram.hpp"

namespace powercell {
namespace {

Options golden_options(const Variant& variant) {
  Options options;
  options.precision = variant.float32 ? Precision::float32 : Precision::float64;
  return options;
}

template <class Real>
cl::Buffer<Real> uploaded(const Device& device, const std::vector<double>& values) {
  cl::Buffer<Real> buffer(device.context());
  buffer.upload(std::vector<Real>(values.begin(), values.end()));
  return buffer;
}

/// \param expected  the measure or mass of a seed's cell
template <class Real>
void run_golden(DeviceDiagram::State& state, const Variant& variant, const char* file,
                double (*expected)(const Variant&, std::uint32_t)) {
  const SeedSet seeds = golden_seeds(variant.dimension);
  const auto n = static_cast<std::uint32_t>(seeds.size());
  const std::size_t columns = 2 + static_cast<std::size_t>(variant.dimension);
  const auto positions = uploaded<Real>(state.device, seeds.positions);
  const auto weights = uploaded<Real>(state.device, seeds.weights);
  cl::Buffer<Real> measures(state.device.context());
  cl::Buffer<std::uint32_t> status(state.device.context());
  measures.resize(n * columns);
  status.resize(n);
  state.enqueue(positions.handle(), weights.handle(), n, {measures.handle(), status.handle()}, {}, nullptr);
  const std::vector<Real> rows = measures.download();
  for (std::uint32_t i = 0; i < n; ++i)
    require_golden(*state.device.context(), file, variant, seeds.input[i], rows[i * columns],
                   expected(variant, seeds.input[i]));
}

template <class Real>
void run_golden_density(DeviceDiagram::State& state, const Variant& variant) {
  const auto values = uploaded<Real>(state.device, golden_densities(state.domain));
  state.set_density(values.handle());
  run_golden<Real>(state, variant, device_density_file, golden_mass);
}

}  // namespace

void require_golden_measures(const Device& device, const Variant& variant, std::size_t capacity) {
  DeviceDiagram::State state(device, Domain(std::make_shared<RegionMesh>(golden_mesh(variant))),
                             golden_options(variant));
  state.first_capacity = capacity;
  variant.float32 ? run_golden<float>(state, variant, device_clip_file, golden_measure)
                  : run_golden<double>(state, variant, device_clip_file, golden_measure);
}

void require_golden_masses(const Device& device, const Variant& variant, std::size_t capacity) {
  DeviceDiagram::State state(device, golden_simplices(variant), golden_options(variant));
  state.first_capacity = capacity;
  variant.float32 ? run_golden_density<float>(state, variant) : run_golden_density<double>(state, variant);
}

}  // namespace powercell
