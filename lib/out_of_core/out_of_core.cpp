#include <algorithm>
#include <chrono>
#include <memory>
#include <numeric>
#include <powercell/error.hpp>
#include <powercell/out_of_core.hpp>
#include <utility>

#include "lib/base/float_environment.hpp"
#include "lib/base/random.hpp"
#include "lib/diagram/state.hpp"
#include "lib/exchange/checks.hpp"
#include "lib/out_of_core/call_file.hpp"
#include "lib/out_of_core/gather.hpp"
#include "lib/out_of_core/other_seeds.hpp"
#include "lib/out_of_core/piece_file.hpp"
#include "lib/out_of_core/plan.hpp"
#include "lib/out_of_core/sorting.hpp"
#include "lib/out_of_core/store.hpp"

namespace powercell {
namespace out_of_core {
namespace {

constexpr std::size_t most_rows = std::size_t{1} << 18;  // that are given at a time
/// Usual shares of the time.
constexpr double sorted_at = 0.1, computed_at = 0.9;

std::uint64_t digest_of(const std::string& text) {
  std::uint64_t digest = text.size();
  for (const char c : text) digest = mixed_bits(digest ^ static_cast<unsigned char>(c));
  return digest;
}

/// One fraction for all that is done.
class Fraction {
 public:
  explicit Fraction(std::function<bool(double)> callback) : callback_(std::move(callback)) {}

  void part(double from, double to) { from_ = from, to_ = to; }
  bool report(double fraction) {
    if (!callback_) return true;
    reached_ = std::max(reached_, from_ + std::clamp(fraction, 0.0, 1.0) * (to_ - from_));
    return callback_(reached_);
  }

 private:
  std::function<bool(double)> callback_;
  double from_ = 0, to_ = 1, reached_ = 0;
};

Options options_of_pieces(const OutOfCoreOptions& options, Fraction& fraction) {
  Options diagram = options.diagram;
  if (diagram.progress) diagram.progress = [&fraction](double done) { return fraction.report(done); };
  return diagram;
}

void require_valid(const SeedSource& source, const Domain& domain, const OutOfCoreOptions& options) {
  if (source.dimension != domain.dimension())
    throw Error(ErrorCode::invalid_argument,
                "seeds have " + std::to_string(source.dimension) + " coordinates each, the domain has " +
                    std::to_string(domain.dimension()) + "; give seeds of the domain's dimension");
  if (source.count > most_seeds_of_diagram)
    throw Error(ErrorCode::invalid_argument, std::to_string(source.count) +
                                                 " seeds are more than the limit of " +
                                                 std::to_string(most_seeds_of_diagram) + " for one diagram");
  if (source.name.empty() || !source.read)
    throw Error(ErrorCode::invalid_argument, "a source of seeds needs a name and a function that reads");
  if (options.folder.empty())
    throw Error(ErrorCode::invalid_argument, "seeds out of core need a folder for what is finished");
}

class Computation {
 public:
  Computation(const Device& device, const Domain& domain, const SeedSource& source,
              const OutOfCoreOptions& options)
      : source_(source),
        options_(options),
        fraction_(options.diagram.progress),
        diagram_(device, domain, options_of_pieces(options, fraction_)) {
    if (diagram_.setup.float32())
      throw Error(ErrorCode::unsupported, "seeds out of core need double precision");
    piece_seeds_ = seeds_of_piece(source.count, domain, options.memory, options.walls, options.piece_seeds);
    diagram_.workspace.keeps_walls = true;  // of the next piece
    traffic_.progress = [this](double done) {
      if (!fraction_.report(done))
        throw Error(ErrorCode::interrupted, "the computation was stopped by its progress callback");
    };
  }

  OutOfCoreReport run(const std::function<void(CellRows)>& take) {
    LockedFolder folder(options_.folder);
    require_same(folder);
    lap();
    fraction_.part(0, sorted_at);
    if (!Store::is_in(folder)) sort(folder);
    report_.sort = lap();
    compute_pieces(folder);
    report_.compute = lap();
    fraction_.part(computed_at, 1);
    gather(files_, source_.count, source_.dimension, diagram_.setup.domain.measure(),
           std::min<std::uint64_t>(most_rows, piece_seeds_), take, traffic_, report_);
    report_.gather = lap();
    report_.bytes_read = traffic_.read;
    report_.bytes_written = traffic_.written;
    files_.clear();
    folder.remove();
    return report_;
  }

 private:
  void require_same(const LockedFolder& folder) const {
    std::vector<NamedValue> parts = exchange::call_values(diagram_.setup.domain, options_.diagram);
    parts.push_back({"the seeds", digest_of(source_.name) ^ source_.count});
    parts.push_back({"the memory", options_.memory});
    parts.push_back({"the seeds of a piece", options_.piece_seeds});
    parts.push_back({"whether walls are wanted", static_cast<std::uint64_t>(options_.walls)});
    require_same_call(folder, parts);
  }

  /// Leaves nothing where it fails, because there is nothing to go on with.
  void sort(LockedFolder& folder) {
    try {
      sort_seeds(source_, diagram_.setup, piece_seeds_, folder, traffic_);
    } catch (...) {
      folder.remove();
      throw;
    }
  }

  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

  static std::string name_of(std::size_t piece) { return "piece_" + std::to_string(piece); }

  void compute_pieces(const LockedFolder& folder) {
    const Store store(folder, source_.dimension);
    report_.pieces = store.pieces();
    Statuses statuses(source_.count);
    OtherSeeds others(store, statuses, options_.diagram.threads);
    PieceWriter writer;  // of a piece while the next one is computed
    for (std::size_t p = 0; p < store.pieces(); ++p) {
      fraction_.part(at_piece(p), at_piece(p + 1));
      if (folder.has(name_of(p))) {
        ++report_.kept;
        const PieceFile file(folder.file(name_of(p)), source_.dimension);
        statuses.set(file.id, file.status);
      } else {
        PieceCells cells = compute_piece(store, p, others);
        statuses.set(cells.id, cells.cells.measures.status);
        writer.write(folder.file(name_of(p)), std::move(cells));
      }
    }
    writer.finish();
    std::uint64_t seeds = store.duplicates();
    for (std::size_t p = 0; p < store.pieces(); ++p)
      seeds += files_.emplace_back(folder.file(name_of(p)), source_.dimension).size();
    // A flat cell may have walls with cells of pieces that were finished before it was known to be flat.
    for (std::size_t p = 0; p < store.pieces(); ++p) {
      const auto is_hidden = [&](std::uint64_t id) { return statuses.is_hidden(id); };
      if (std::none_of(files_[p].foreign.begin(), files_[p].foreign.end(), is_hidden)) continue;
      ++report_.again;
      const std::string path = folder.file(name_of(p));
      files_[p] = PieceFile();  // Windows replaces no file that is mapped
      writer.write(path, compute_piece(store, p, others));
      writer.finish();
      files_[p] = PieceFile(path, source_.dimension);
    }
    traffic_.written += writer.bytes();
    report_.fetched = others.sent();
    if (seeds != source_.count)
      throw Error(ErrorCode::internal, options_.folder + ": its pieces have " + std::to_string(seeds) +
                                           " seeds of " + std::to_string(source_.count) +
                                           "; remove it to begin anew, and please report it");
  }

  double at_piece(std::size_t piece) const {
    const auto pieces = static_cast<double>(std::max<std::uint64_t>(report_.pieces, 1));
    return sorted_at + (computed_at - sorted_at) * static_cast<double>(piece) / pieces;
  }

  PieceCells compute_piece(const Store& store, std::size_t piece, OtherSeeds& others) {
    using exchange::Shard;
    const int threads = diagram_.setup.threads;
    PieceCells cells;
    cells.order = store.by_id(piece, threads);
    const auto [first, last] = store.ranks(piece);
    traffic_.read += (last - first) * (static_cast<std::size_t>(source_.dimension) + 2) * sizeof(double);
    // Ranks are the ids of seeds among pieces, so that all of a shard is in the order of the curve. The piece
    // is shard 0, all other seeds are shard 1.
    std::vector<std::uint64_t> ranks(last - first);
    std::iota(ranks.begin(), ranks.end(), std::uint64_t{first});
    Shard shard(0, ranks, store.seeds_of(piece), source_.dimension, options_.diagram.threads,
                diagram_.setup.domain.mesh().period.get(), options_.walls);
    shard.meet(std::make_shared<exchange::FirstCoarseTrees>(
        std::vector<PackedTree>{{}, others.begin(piece, shard.own().tree())}, source_.dimension));
    for (const auto& [to, boundary] : shard.boundaries()) shard.take(to, others.near(boundary));
    while (shard.open_cells() > 0) {
      while (shard.open_cells() > 0) round(shard, others);
      shard.reopen();
    }
    cells.foreign = shard.foreign_neighbors();
    report_.neighbors += cells.foreign.size();
    report_.clipped += shard.clipped_cells();
    cells.cells = shard.take_cells(diagram_.setup.domain.measure());
    name_by_ids(cells, store, piece, threads);
    store.drop();
    return cells;
  }

  void round(exchange::Shard& shard, OtherSeeds& others) {
    ++report_.rounds;
    for (const auto& [to, request] : shard.clip(diagram_)) shard.take(to, others.answer(request));
    shard.settle();
  }

  const SeedSource& source_;
  const OutOfCoreOptions& options_;
  Fraction fraction_;
  Diagram::State diagram_;
  std::uint64_t piece_seeds_ = 0;
  Traffic traffic_;
  std::vector<PieceFile> files_;
  OutOfCoreReport report_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace
}  // namespace out_of_core

OutOfCoreReport compute_out_of_core(const Device& device, const Domain& domain, const SeedSource& source,
                                    const std::function<void(CellRows)>& take,
                                    const OutOfCoreOptions& options) {
  const FloatEnvironment environment;
  out_of_core::require_valid(source, domain, options);
  exchange::require_supported(domain, options.diagram, "seeds out of core");
  return out_of_core::Computation(device, domain, source, options).run(take);
}

}  // namespace powercell
