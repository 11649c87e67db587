/// \file
/// The state of a TransportSolver between calls.
#pragma once

#include <memory>
#include <powercell/transport.hpp>

namespace powercell {

struct TransportSolver::State {
  TransportOptions options;
  double tolerance = 0;  ///< as in TransportOptions
  Diagram diagram;
  bool diagram_has_all = false;      ///< the diagram has all seeds; else those that are not merged
  bool diagram_has_weights = false;  ///< the diagram has the weights of the result; else of a trial step

  std::vector<double> positions, weights, masses;  ///< of all seeds; masses may be empty: equal
  TransportResult result;
  bool solved = false;  ///< the result is for the current seeds

  State(Device device, Domain domain, TransportOptions options);

  std::size_t dimension() const { return static_cast<std::size_t>(diagram.domain().dimension()); }
  std::size_t size() const { return positions.size() / dimension(); }
  double used_tolerance() const;
  SeedsView seeds() const { return {diagram.domain().dimension(), positions, weights}; }

  const TransportResult& solve();
};

}  // namespace powercell
