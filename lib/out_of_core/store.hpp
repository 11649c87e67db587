/// \file
/// All seeds of a diagram in files, piece after piece along a Hilbert curve.
#pragma once

#include <cstdint>
#include <optional>
#include <powercell/seeds.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lib/base/background.hpp"
#include "lib/exchange/tree_seeds.hpp"
#include "lib/out_of_core/files.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell::out_of_core {

/// Seeds with their indices, in memory.
struct SeedBlock {
  std::vector<std::uint64_t> id;
  std::vector<double> positions, weights;
  std::vector<double> wrapped;  ///< the positions in a periodic domain; else empty

  std::size_t size() const { return id.size(); }
};

/// Writes a store while the caller goes on.
class StoreWriter {
 public:
  StoreWriter(const LockedFolder& folder, bool periodic);

  /// Adds a piece: seeds along the curve, none of them a duplicate; nothing if there are none. Waits for the
  /// piece before.
  /// \throw Error write_failed (of that one)
  void add(SeedBlock&& piece);
  void add_duplicates(std::uint64_t count) { duplicates_ += count; }
  /// The store is there as a whole from here on.
  /// \return bytes written
  std::uint64_t close();

 private:
  const LockedFolder& folder_;
  FileWriter ids_, positions_, weights_;
  std::optional<FileWriter> given_;  // positions, where the others are wrapped
  std::vector<std::uint64_t> ends_;
  std::uint64_t duplicates_ = 0;
  BackgroundTask last_;
};

/// A store in memory, as far as it is looked at, with a tree of all seeds.
class Store {
 public:
  /// Whether a folder has one.
  static bool is_in(const LockedFolder& folder);
  /// \pre is_in(folder)
  /// \throw Error invalid_file
  Store(const LockedFolder& folder, int dimension);

  std::size_t size() const { return ids_.size(); }
  std::uint64_t duplicates() const { return duplicates_; }  ///< seeds that were left out
  std::size_t pieces() const { return ends_.size(); }
  /// The ranks of a piece.
  std::pair<std::size_t, std::size_t> ranks(std::size_t piece) const {
    return {piece == 0 ? 0 : ends_[piece - 1], ends_[piece]};
  }
  std::uint64_t id(std::size_t rank) const { return ids_[rank]; }
  /// Ids of the seeds of a piece, by rank.
  std::span<const std::uint64_t> ids_of(std::size_t piece) const {
    const auto [first, last] = ranks(piece);
    return ids_.subspan(first, last - first);
  }
  /// The position as given; those of seeds() are wrapped in a periodic domain.
  const double* given(std::size_t rank) const {
    return &given_[rank * static_cast<std::size_t>(tree_.dimension)];
  }
  exchange::TreeSeeds seeds() const { return {tree_, positions_, weights_}; }
  /// The seeds of a piece as given, by rank.
  SeedsView seeds_of(std::size_t piece) const {
    const auto [first, last] = ranks(piece);
    const std::size_t d = seeds().dimension();
    return {tree_.dimension, given_.subspan(first * d, (last - first) * d),
            weights_.subspan(first, last - first)};
  }
  /// The seeds of a piece by ascending id, counted from the first of them by rank.
  std::vector<std::uint32_t> by_id(std::size_t piece, int threads) const;
  /// Gives the memory of what was looked at back.
  void drop() const;

 private:
  void build_tree(int dimension);

  MappedFile id_file_, position_file_, weight_file_, given_file_;
  std::span<const std::uint64_t> ids_;
  std::span<const double> positions_, weights_, given_;
  std::vector<std::uint64_t> ends_;
  std::uint64_t duplicates_ = 0;
  PackedTree tree_;
};

}  // namespace powercell::out_of_core
