/// \file
/// Transport on a periodic box. Internal.
#pragma once

#include "lib/applications/periodic/periodic_diagram.hpp"
#include "lib/applications/transport/iterate.hpp"

namespace powercell {

/// Evaluates weights in a periodic diagram. The density is constant.
class PeriodicEvaluator : public Evaluator {
 public:
  /// All are kept by reference; `diagram` lends its domain. \param positions  n x 2
  PeriodicEvaluator(Diagram& diagram, PeriodicDiagram& periodic, const Density& density,
                    std::span<const double> positions, const Goal& goal, int threads);

 private:
  void measure(Iterate& at) override;

  PeriodicDiagram& periodic_;
  double density_value_;
};

}  // namespace powercell
