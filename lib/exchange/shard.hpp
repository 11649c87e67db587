/// \file
/// One shard of the seeds of a power diagram: computes the cells of its own seeds, with those of others that
/// it asks for (docs/scale.md).
#pragma once

#include <powercell/diagram.hpp>
#include <unordered_map>
#include <utility>

#include "lib/base/threads.hpp"
#include "lib/diagram/state.hpp"
#include "lib/exchange/boundary_leaves.hpp"
#include "lib/exchange/cell_vertices.hpp"
#include "lib/exchange/other_shards.hpp"
#include "lib/exchange/own_seeds.hpp"

namespace powercell::exchange {

/// The cells of a shard, in the order in which its seeds were given.
struct ShardCells {
  Measures measures;
  std::vector<std::uint64_t> offset;    ///< as in Adjacency
  std::vector<std::uint64_t> neighbor;  ///< ids, ascending within a row
  std::vector<double> wall;             ///< as seen from the cell of the row
  std::vector<Shift> shift;             ///< in a periodic domain: as in Adjacency; else empty
};

/// All shards take the same steps, one after the other or each on a machine of its own:
///
///     set_hidden_aside(), which may be left out; meet() the boxes of the seeds of all
///     send near_parts(), answer them by OwnSeeds::coarse_tree(), take() the coarse trees
///     send boundaries(), answer them by OwnSeeds::near(), take() the halos; this saves rounds and may be
///     left out while some shard has open cells:
///       while some shard has: clip(); send the requests, answer() them, take() the replies; settle()
///       send take_hidden(), forget() what comes; reopen()
///     send duplicates(), answer them by better_duplicates(), mark_duplicates(); take_cells()
class Shard {
 public:
  /// \param number  among all shards
  /// \param period  of the domain, null if it is not periodic
  /// \param walls   whether to list neighbours and walls in the end, not only to count them
  /// \throw Error as OwnSeeds
  Shard(int number, std::span<const std::uint64_t> ids, const SeedsView& seeds, int dimension, int threads,
        const Period* period = nullptr, bool walls = true);

  int number() const { return others_.self(); }
  OwnSeeds& own() { return own_; }
  const OwnSeeds& own() const { return own_; }
  std::size_t open_cells() const { return open_.size(); }
  std::uint64_t clipped_cells() const { return clipped_; }  ///< counted each time
  /// Closes the cells of seeds that are hidden by others of the shard, as far as this is known without
  /// clipping.
  /// \throw Error as OwnSeeds::set_hidden_aside
  void set_hidden_aside(const DiagramSetup& setup);
  void meet(std::shared_ptr<const FirstCoarseTrees> first);
  /// Questions to the shards of some numbers for their coarse trees.
  const std::map<int, NearPart>& near_parts() const { return near_parts_; }
  void take(int from, PackedTree&& coarse_tree) { others_.take_coarse_tree(from, std::move(coarse_tree)); }
  /// Questions to the shards of some numbers which of their seeds are near.
  std::map<int, BoundaryLeaves> boundaries() const;
  void take(int from, Halo&& halo);

  /// Clips the open cells among all seeds at hand.
  /// \return requests to the shards of some numbers
  /// \param diagram  in the domain; its seeds and selection are replaced
  /// \throw Error as Diagram
  std::map<int, Request> clip(Diagram::State& diagram);
  void take(int from, Reply&& reply);
  /// Closes the cells of which no vertex can be cut off any more.
  void settle();

  /// Seeds of others turned out to be hidden.
  void forget(const std::vector<std::uint64_t>& ids);
  /// Opens the cells again that have a wall with a hidden seed: one whose cell is flat.
  void reopen();

  /// Hidden seeds that may have duplicates in the shards of some numbers.
  std::map<int, Duplicates> duplicates() const;
  void mark_duplicates(const Duplicates& asked, const std::vector<std::uint8_t>& better);

  /// To be called once, at the end.
  ShardCells take_cells(double domain_measure);
  std::size_t foreign_seeds() const { return foreign_id_.size(); }  ///< fetched in all
  /// Ids of those of these that have a wall in the end.
  std::vector<std::uint64_t> foreign_neighbors() const;

 private:
  /// A vertex that another shard could cut off.
  struct Vertex {
    int round = 0;          ///< in which it was asked about
    bool all_asked = true;  ///< whether all shards were asked that could cut it off
    bool found = false;
    bool settled = false;  ///< whether no seed can cut it off but those that are known
  };
  /// A cell that waits for answers.
  struct Waiting {
    Handle cell;
    std::size_t end;  ///< of its vertices in waiting_for_
    bool postponed;   ///< whether other vertices are left for later
  };
  /// Of the cells that were clipped at a time.
  struct Walls {
    std::vector<Handle> neighbor;  ///< by ascending id within a cell, if walls are listed
    std::vector<double> wall;
    std::vector<Shift> shift;
  };
  struct Row {
    std::uint64_t begin = 0;
    std::uint32_t count = 0, walls = 0;  ///< the place in walls_
  };

  std::span<const Handle> neighbors_of(Handle cell) const {
    const Row& row = rows_[cell];
    return row.count == 0 ? std::span<const Handle>{}
                          : std::span(walls_[row.walls].neighbor).subspan(row.begin, row.count);
  }
  bool is_own(Handle h) const { return h < own_.size(); }
  std::uint64_t id_of(Handle h) const { return is_own(h) ? own_.id(h) : foreign_id_[h - own_.size()]; }
  const double* row_of(Handle h) const {
    return is_own(h) ? own_.row(h) : &foreign_rows_[(h - own_.size()) * width_];
  }
  bool is_gone(Handle h) const {
    return is_own(h) ? own_.is_hidden(h) : foreign_hidden_[h - own_.size()] != 0;
  }
  /// Seeds to clip the open cells among, by ascending id: all known ones but hidden ones, or those with a
  /// wall of an open cell and those that came since, which leaves out none that matters to a convex cell.
  std::vector<Handle> at_hand(bool all) const;
  /// Clips the open cells and keeps their results.
  void compute(Diagram::State& diagram, std::span<const Handle> handle, Wanted want);
  /// Clips the open cells with their geometry.
  /// \return requests for what could cut them
  std::map<int, Request> ask_all(Diagram::State& diagram, std::span<const Handle> handle, Wanted want);
  /// Adds seeds of others to those at hand.
  void take_seeds(const std::vector<std::uint64_t>& ids, const std::vector<double>& rows);
  /// Calls body(begin, end) on all threads for ranges of `count` items.
  template <class Body>
  void share(std::size_t count, const Body& body) const {
    parallel_for(threads_for(count, threads_), count, body);
  }
  /// In the order in which the seeds were given.
  Measures take_measures();
  /// Leaves those cells open that other shards may cut, by how far they reach.
  /// \param reach  by own seed
  void close_far_cells(const std::vector<double>& reach);
  /// Adds the vertices of a cell to the requests that no shard was asked about yet.
  void ask(const Cells& cells, std::size_t row, std::span<const Handle> handle, NearBoxes& near,
           std::map<int, Request>& requests);
  /// Adds a vertex to the request to a shard.
  /// \param row  of the cell's seed, as the shard sees it
  void add_vertex(const double* row, double radius, const Point& vertex, Request& request) const;
  /// Cells reach far at first: leaves those shards in asked_ that may cut off more than the vertex, nearer to
  /// the seed. The others are asked later, if they still matter.
  /// \return whether none was removed
  bool keep_nearest(NearBoxes& near, const Point& vertex);
  /// The radius of a ball around a cell's seed that contains the vertices, however far from the domain the
  /// seed was given.
  double radius_about(const Cells& cells, std::size_t row, Handle cell) const;

  int threads_;
  bool lists_walls_;
  std::size_t width_;  // of a row of position and weight
  OwnSeeds own_;
  OtherShards others_;
  std::vector<Point> moves_;            // of cells, to where others matter
  std::map<int, NearPart> near_parts_;  // near others

  std::vector<std::uint64_t> foreign_id_;
  std::vector<double> foreign_rows_;
  std::vector<std::uint8_t> foreign_hidden_;
  std::size_t foreign_clipped_ = 0;  // those before were at hand when the open cells were clipped last

  int round_ = 0;
  std::uint64_t clipped_ = 0;
  bool all_needed_ = true;        // cells are open whose walls may be missing
  std::vector<Handle> open_;      // ascending
  std::vector<Handle> unproved_;  // open cells that reach too far for the images of seeds at hand; ascending
  std::vector<Waiting> waiting_;
  std::vector<Vertex*> waiting_for_;
  std::unordered_map<VertexName, Vertex, VertexHash> vertices_;
  std::vector<Vertex*> questions_;                // of this round
  std::map<int, std::vector<Vertex*>> asked_of_;  // by shard: the vertices of its request
  CellVertices cell_vertices_;
  std::vector<NearBoxes::View> asked_;

  Measures measures_;  // of own seeds
  std::vector<Row> rows_;
  std::vector<Walls> walls_;
};

}  // namespace powercell::exchange
