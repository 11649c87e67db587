#include "lib/out_of_core/store.hpp"

#include <algorithm>
#include <powercell/error.hpp>
#include <utility>

#include "lib/base/radix_sort.hpp"
#include "lib/exchange/tree_of_boxes.hpp"

namespace powercell::out_of_core {
namespace {

constexpr const char *ids_name = "ids", *positions_name = "positions", *weights_name = "weights",
                     *given_name = "given", *ends_name = "pieces";
/// Leaves whose seeds are in memory at a time while the tree is built.
constexpr std::size_t leaves_at_once = std::size_t{1} << 18;

}  // namespace

StoreWriter::StoreWriter(const LockedFolder& folder, bool periodic)
    : folder_(folder),
      ids_(folder.file(ids_name), FileWriter::Kind::kept),
      positions_(folder.file(positions_name), FileWriter::Kind::kept),
      weights_(folder.file(weights_name), FileWriter::Kind::kept) {
  if (periodic) given_.emplace(folder.file(given_name), FileWriter::Kind::kept);
}

void StoreWriter::add(SeedBlock&& piece) {
  if (piece.size() == 0) return;
  ends_.push_back((ends_.empty() ? 0 : ends_.back()) + piece.size());
  last_.run([this, piece = std::move(piece)] {
    ids_.write_all(piece.id);
    positions_.write_all(given_ ? piece.wrapped : piece.positions);
    weights_.write_all(piece.weights);
    for (FileWriter* const file : {&ids_, &positions_, &weights_}) file->sync();
    if (!given_) return;
    given_->write_all(piece.positions);
    given_->sync();
  });
}

std::uint64_t StoreWriter::close() {
  last_.finish();
  ids_.close();
  positions_.close();
  weights_.close();
  if (given_) given_->close();
  // The last file, because it tells that the others are whole.
  FileWriter ends(folder_.file(ends_name), FileWriter::Kind::kept);
  ends.write_one(duplicates_);
  ends.write_all(ends_);
  ends.close();
  return ids_.bytes() + positions_.bytes() + weights_.bytes() + ends.bytes() + (given_ ? given_->bytes() : 0);
}

bool Store::is_in(const LockedFolder& folder) {
  return folder.has(ends_name);
}

Store::Store(const LockedFolder& folder, int dimension)
    : id_file_(folder.file(ids_name)),
      position_file_(folder.file(positions_name)),
      weight_file_(folder.file(weights_name)) {
  const MappedFile ends(folder.file(ends_name));
  const std::span<const std::uint64_t> all = ends.all<std::uint64_t>();
  duplicates_ = ends.numbers<std::uint64_t>(0, 1)[0];
  ends_.assign(all.begin() + 1, all.end());
  const std::size_t count = ends_.empty() ? 0 : ends_.back();
  ids_ = id_file_.numbers<std::uint64_t>(0, count);
  weights_ = weight_file_.numbers<double>(0, count);
  positions_ = position_file_.numbers<double>(0, count * static_cast<std::size_t>(dimension));
  given_ = positions_;
  if (folder.has(given_name)) {
    given_file_ = MappedFile(folder.file(given_name));
    given_ = given_file_.numbers<double>(0, positions_.size());
  }
  build_tree(dimension);
}

void Store::build_tree(int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  exchange::TreeOfBoxes boxes(dimension);
  boxes.reserve((size() + PackedTree::fan - 1) / PackedTree::fan);
  for (std::size_t first = 0, leaf = 1; first < size(); first += PackedTree::fan, ++leaf) {
    const std::size_t count = std::min<std::size_t>(PackedTree::fan, size() - first);
    boxes.add(exchange::box_around(&positions_[first * d], count, d).view(),
              *std::max_element(&weights_[first], &weights_[first] + count));
    if (leaf % leaves_at_once == 0) drop();
  }
  drop();
  tree_ = std::move(boxes).finish();
  tree_.seeds = size();
}

std::vector<std::uint32_t> Store::by_id(std::size_t piece, int threads) const {
  const std::span<const std::uint64_t> ids = ids_of(piece);
  std::vector<KeyedIndex> records(ids.size()), scratch(ids.size());
  for (std::size_t k = 0; k < ids.size(); ++k) records[k] = {ids[k], static_cast<std::uint32_t>(k)};
  sort_by_key(records, scratch, threads);
  std::vector<std::uint32_t> order(ids.size());
  std::transform(records.begin(), records.end(), order.begin(),
                 [](const KeyedIndex& record) { return record.index; });
  return order;
}

void Store::drop() const {
  id_file_.drop();
  position_file_.drop();
  weight_file_.drop();
  given_file_.drop();
}

}  // namespace powercell::out_of_core
