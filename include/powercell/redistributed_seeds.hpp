/// \file
/// Seeds of several ranks, shared out anew so that those of a rank are near each other.
#pragma once

#include <cstdint>
#include <memory>
#include <powercell/communicator.hpp>
#include <powercell/distributed.hpp>
#include <powercell/domain.hpp>
#include <powercell/seeds.hpp>
#include <span>

namespace powercell {

/// Seeds on the ranks that compute with them: each has about as many, a range of a Hilbert curve through all.
/// For programs that have no division of space of their own, such as those that read seeds from a file.
/// DistributedOptions::redistribute does the same for one call.
class POWERCELL_API RedistributedSeeds {
 public:
  /// Sends the seeds. All ranks call it, those without seeds too. An error on one rank is thrown on all.
  /// \param communicator  used by send_back() too, and must last as long
  /// \param ids    of the seeds, each once on all ranks (which is not checked here)
  /// \param seeds  as many, of the same dimension on all ranks, also where there are none
  /// \param domain  that they are for: seeds are near each other as wrapped into it, if it is periodic; null
  ///                for as given
  /// \throw Error invalid_argument (sizes, dimensions), invalid_seed (a position that is not finite)
  RedistributedSeeds(Communicator& communicator, std::span<const std::uint64_t> ids, const SeedsView& seeds,
                     const Domain* domain = nullptr);
  RedistributedSeeds(RedistributedSeeds&&) noexcept;
  RedistributedSeeds& operator=(RedistributedSeeds&&) noexcept;
  ~RedistributedSeeds();

  /// Those that are on this rank now; valid as long as this.
  std::span<const std::uint64_t> ids() const;
  /// As many, with weights also where none were given.
  SeedsView seeds() const;

  /// Sends cells back to the ranks that gave their seeds. All ranks call it.
  /// \param cells  of seeds(), in their order
  /// \return those of the seeds that this rank gave, in its order, with the report of `cells`
  /// \throw Error invalid_argument (as many rows as there are seeds)
  DistributedCells send_back(const DistributedCells& cells);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace powercell
