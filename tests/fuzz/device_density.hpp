/// \file
/// What holds for diagrams in device memory, told by a Diagram of the same seeds.
#pragma once

#include <powercell/diagram.hpp>

#include "tests/fuzz/device_memory.hpp"
#include "tests/fuzz/input.hpp"

namespace powercell::fuzz {

/// The exact diagram of the seeds that are not invalid.
struct ExactTwin {
  /// \param status  of the device, for each of the seeds that are given
  ExactTwin(const Domain& domain, const Options& options, const SeedInput& given,
            const std::vector<cl_uint>& status);
  /// What masses of the device may be off by for rounding, as a part of the domain's measure.
  double mass_doubt(Precision precision) const;

  std::vector<cl_uint> number;  ///< of each valid seed
  SeedInput valid;
  Diagram diagram;
};

/// Sets a density of any values at the vertices, good or not, computes and repairs: statuses are those
/// without a density, NaN and negative masses are there only where values are none of a density, and other
/// masses are those of integrate(). On a domain that is no mesh a density is refused. \param status  of the
/// device without a density, before repair \throw Finding
template <class Real>
void check_density(Input& input, DeviceDiagram& diagram, const DeviceSeeds& seeds,
                   const std::vector<cl_uint>& status, ExactTwin& twin);

}  // namespace powercell::fuzz
