#include <powercell/c/point_sets.h>

#include <powercell/point_sets.hpp>

#include "lib/applications/c_api/density.hpp"
#include "lib/c_api/handles.hpp"
#include "lib/c_api/options.hpp"
#include "lib/c_api/results.hpp"

namespace powercell::c_api {
namespace {

struct OwnedSpectrum {
  Spectrum spectrum;
  Spectrum::Radial radial;
};

void hand_over_spectrum(const pc_spectrum** out, Spectrum spectrum) {
  Spectrum::Radial radial = spectrum.radial();
  hand_over_result(out, OwnedSpectrum{std::move(spectrum), std::move(radial)},
                   [](pc_spectrum& to, const OwnedSpectrum& from) {
                     to.highest = from.spectrum.highest;
                     to.power = pointer(from.spectrum.power);
                     to.points = from.spectrum.points;
                     to.runs = from.spectrum.runs;
                     to.radial_mean = pointer(from.radial.mean);
                     to.radial_anisotropy = pointer(from.radial.anisotropy);
                   });
}

const Spectrum& spectrum_in(const pc_spectrum* spectrum) {
  checked(spectrum, "a spectrum");
  return static_cast<const Result<pc_spectrum, OwnedSpectrum>*>(spectrum)->owned.spectrum;
}

}  // namespace

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

extern "C" {

pc_status pc_random_points(const pc_domain* domain, const pc_density* density, size_t count,
                           uint64_t random_seed, double* positions) {
  return guarded([&] {
    if (count != 0) result_at(positions);
    copy_out(random_points(domain_in(domain), density_in(density), count, random_seed), positions);
  });
}

pc_status pc_spacing(const pc_device* device, const pc_domain* domain, const double* positions, size_t count,
                     int periodic, int uniform, const pc_options* options, double* least, double* mean,
                     double* hexatic) {
  return guarded([&] {
    const Domain& in = domain_in(domain);
    const std::span<const double> points = positions_of(in.dimension(), positions, count);
    const Spacing measured =
        spacing(device_in(device), in, points, periodic != 0, uniform != 0, options_of(options));
    if (least) *least = measured.least;
    if (mean) *mean = measured.mean;
    if (hexatic) *hexatic = measured.hexatic;
  });
}

pc_status pc_spectrum_create(const pc_domain* box, const double* positions, size_t count, int highest,
                             int threads, const pc_spectrum** spectrum) {
  return guarded([&] {
    result_at(spectrum);
    const Domain& in = domain_in(box);
    const std::span<const double> points = positions_of(in.dimension(), positions, count);
    hand_over_spectrum(spectrum, powercell::spectrum(in, points, highest, threads));
  });
}

pc_status pc_spectrum_mean(const pc_spectrum* const* spectra, size_t count, const pc_spectrum** mean) {
  return guarded([&] {
    result_at(mean);
    std::vector<Spectrum> all;
    for (const pc_spectrum* one : view(spectra, count, "spectra")) all.push_back(spectrum_in(one));
    hand_over_spectrum(mean, powercell::mean(all));
  });
}

pc_status pc_spectrum_low_frequency(const pc_spectrum* spectrum, double fraction, double* power) {
  return guarded([&] { result_at(power) = spectrum_in(spectrum).low_frequency(fraction); });
}

void pc_spectrum_destroy(const pc_spectrum* spectrum) {
  destroy_result<OwnedSpectrum>(spectrum);
}

}  // extern "C"
