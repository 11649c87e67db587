/// \file
/// Power diagrams restricted to a domain: a class that keeps its state between calls, and one-off functions.
#pragma once

#include <memory>
#include <powercell/device.hpp>
#include <powercell/domain.hpp>
#include <powercell/options.hpp>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>
#include <span>
#include <vector>

namespace powercell {

/// A power diagram of seeds in a domain, on a device. Results are computed on request and kept until the
/// seeds or weights change; references to them stay valid until then. Not thread-safe; different diagrams may
/// run in different threads, also on one device. After an exception the diagram has its seeds still and can
/// be used again.
class POWERCELL_API Diagram {
 public:
  /// \throw Error no_fp64 if the options ask for double on a device without it; invalid_argument, unsupported
  /// (options)
  Diagram(Device device, Domain domain, Options options = {});
  Diagram(Diagram&&) noexcept;
  Diagram& operator=(Diagram&&) noexcept;
  ~Diagram();

  /// Copies the seeds, at most 2^30.
  /// \throw Error invalid_argument (sizes), invalid_seed (names the seed: NaN, infinity, or so large that its
  /// square is not finite in the precision)
  void set_seeds(const SeedsView& seeds);
  /// Sets new weights for the same positions; only the work that depends on weights is repeated.
  /// \throw Error invalid_argument (size), invalid_seed
  void set_weights(std::span<const double> weights);

  /// From now on computes the cells of some seeds only, against all seeds, until select_all() or set_seeds().
  /// Row k of the results is of seed seeds[k]; neighbours and borders name seeds by their index among all, as
  /// before. Walls are those of the selected cells as seen from them: a wall of two selected cells may differ
  /// between their rows by rounding. Time goes with the selected cells, and a few ns with each seed; on a
  /// surface also with its triangles, and in a solid (Domain::solid) as for all cells.
  /// \param seeds  indices below size(), each once, in any order; copied
  /// \throw Error invalid_argument (no seeds yet; an index, with its place), unsupported (Options::certify)
  void select(std::span<const std::uint32_t> seeds);
  void select_all();
  bool has_selection() const;  ///< from select() on

  std::size_t size() const;               ///< number of seeds
  std::vector<double> positions() const;  ///< of the seeds, in the caller's order: n x d, row-major
  const Domain& domain() const;
  const Device& device() const;
  Precision precision() const;  ///< as chosen: float64 or float32
  Neighbors neighbors() const;  ///< as chosen: tree or flann

  /// Computes the measures, and the adjacency and cells (of a solid the joined cells) where requested, in as
  /// few passes as possible. The getters below compute what is missing, each in a pass of its own.
  void compute(bool adjacency, bool cells);

  const Measures& measures();
  const Adjacency& adjacency();
  /// \throw Error unsupported in a solid, which has no regions that cells could be cut along: see joined()
  const Cells& cells();
  /// The cells as wholes, in every kind of domain: of a solid by themselves, else as join() makes them.
  const JoinedCells& joined();
  /// The facets of the domain that the cells have, in a pass of its own over the regions at the boundary.
  const BoundaryWalls& boundary_walls();
  /// \throw Error unsupported if seeds are selected
  const Dual& dual();
  const Timings& timings() const;  ///< of the last computation
  /// Keeps the results of the present seeds, to which the getters refer, alive while it is held, also after
  /// the seeds change and without the diagram.
  std::shared_ptr<const void> hold_results() const;

  struct State;  ///< library-internal
  /// For the library's own use.
  const State& state() const { return *state_; }

 private:
  std::unique_ptr<State> state_;
};

/// Builds and tests the kernels that diagrams of this kind run on the device, so that the first one takes no
/// longer than the next ones: computes three small ones, with all results. What is built lasts as long as a
/// Device of the process on the same device, and in a cache on disk.
/// \param options  `progress` is called as by a diagram.
/// \throw as Diagram
POWERCELL_API void prepare(const Device& device, const Domain& domain, const Options& options = {});

/// One-off measures of the cells.
/// \throw as Diagram
POWERCELL_API Measures measure(const Device& device, const Domain& domain, const SeedsView& seeds,
                               const Options& options = {});

/// Joins the pieces of each cell across the regions of the domain. A facet between two pieces stays, with the
/// border `interior`, where the piece behind it was too thin to be kept (single precision).
/// \throw Error invalid_argument if the cells belong to another kind of domain
POWERCELL_API JoinedCells join(const Domain& domain, const Cells& cells);

}  // namespace powercell
