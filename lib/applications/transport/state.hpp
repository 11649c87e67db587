/// \file
/// What a TransportSolver keeps between calls. Internal.
#pragma once

#include <memory>
#include <optional>
#include <powercell/transport.hpp>

#include "lib/applications/periodic/periodic_diagram.hpp"
#include "lib/applications/transport/iterate.hpp"

namespace powercell {

struct TransportSolver::State {
  TransportOptions options;
  double tolerance = 0;  // as in TransportOptions
  Diagram diagram;
  std::optional<PeriodicDiagram> periodic;  // has the cells where the options ask for it
  bool diagram_has_all = false;             // of the seeds; else those that are not merged
  bool diagram_has_weights = false;         // of the result; else of a step that was tried

  std::vector<double> positions, weights, masses;  // of all seeds; no masses: equal ones
  TransportResult result;
  bool solved = false;  // since the seeds were set or moved

  State(Device device, Domain domain, TransportOptions options);

  std::size_t dimension() const { return static_cast<std::size_t>(diagram.domain().dimension()); }
  std::size_t size() const { return positions.size() / dimension(); }
  double used_tolerance() const;
  SeedsView seeds() const { return {diagram.domain().dimension(), positions, weights}; }

  const TransportResult& solve();

 private:
  /// \param target  of the kept seeds, kept by reference
  std::unique_ptr<Evaluator> evaluator(std::span<const double> kept_positions, const Vector& target);
  /// Masses asked for, rescaled to the sum `total`. \throw Error invalid_argument
  std::vector<double> targets(double total) const;
  void fill_result(const Iterate& at, const std::vector<std::uint32_t>& kept);
};

}  // namespace powercell
