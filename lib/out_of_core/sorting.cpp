#include "lib/out_of_core/sorting.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lib/base/background.hpp"
#include "lib/base/positions.hpp"
#include "lib/base/threads.hpp"
#include "lib/diagram/given_seeds.hpp"
#include "lib/out_of_core/store.hpp"
#include "lib/seeds/hilbert.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell::out_of_core {
namespace {

constexpr std::size_t block_seeds = std::size_t{1} << 16;  // read at a time
constexpr std::size_t most_parts = 240;  // written at a time, or up to twice as many; Windows allows 509
constexpr std::size_t samples_of_part = 4096;  // a part has 1.6 % more or less than its share

/// What calls a function for blocks of some seeds, one after the other, as often as it is asked to.
using Blocks = std::function<void(const std::function<void(const SeedBlock&)>& use)>;

/// What is known of some seeds after they were seen once.
struct Survey {
  std::vector<double> low, high;                         ///< of their box
  std::vector<double> sample;                            ///< rows of some of their positions
  std::optional<std::pair<std::uint64_t, double>> best;  ///< the heaviest, of those the lowest id; its weight
};

/// Divides seeds again and again until they fit into memory.
class Sorter {
 public:
  Sorter(const SeedSource& source, const DiagramSetup& setup, std::uint64_t piece, const LockedFolder& folder,
         Traffic& traffic)
      : source_(source),
        setup_(setup),
        d_(static_cast<std::size_t>(source.dimension)),
        piece_(piece),
        folder_(folder),
        traffic_(traffic),
        period_(setup.domain.mesh().period.get()),
        store_(folder, period_ != nullptr) {}

  void run() {
    sort([this](const auto& use) { read_source(use); }, source_.count, true);
    traffic_.written += store_.close();
  }

 private:
  std::size_t row_bytes() const { return (d_ + 2) * sizeof(double); }

  /// Calls `use` for blocks of some of `count` seeds in turn, each filled by `read(first, block)`. The next
  /// block is read meanwhile.
  template <class Read>
  void in_blocks(std::uint64_t count, const Read& read, const std::function<void(const SeedBlock&)>& use) {
    const auto make = [&](std::size_t k) {
      const std::uint64_t first = k * block_seeds;
      const std::size_t size = std::min<std::uint64_t>(block_seeds, count - first);
      SeedBlock block{
          std::vector<std::uint64_t>(size), std::vector<double>(size * d_), std::vector<double>(size), {}};
      read(first, block);
      return block;
    };
    make_ahead((count + block_seeds - 1) / block_seeds, make, use);
    traffic_.read += count * row_bytes();
  }

  void read_source(const std::function<void(const SeedBlock&)>& use) {
    const auto read = [this](std::uint64_t first, SeedBlock& block) {
      std::iota(block.id.begin(), block.id.end(), first);
      source_.read(first, block.positions, block.weights);
    };
    in_blocks(source_.count, read, use);
  }

  /// Rows of id, position and weight.
  void read_part(const std::string& path, const std::function<void(const SeedBlock&)>& use) {
    const MappedFile file(path);
    const auto read = [&](std::uint64_t first, SeedBlock& block) {
      for (std::size_t k = 0; k < block.size(); ++k) {
        const std::size_t at = (first + k) * row_bytes();
        block.id[k] = file.numbers<std::uint64_t>(at, 1)[0];
        const std::span<const double> row = file.numbers<double>(at + sizeof(double), d_ + 1);
        copy_point(row.data(), d_, &block.positions[k * d_]);
        block.weights[k] = row[d_];
      }
      file.drop();
    };
    in_blocks(file.bytes() / row_bytes(), read, use);
  }

  /// Seeds along the curve.
  /// \param all  whether these are all seeds, which nobody has checked yet
  void sort(const Blocks& blocks, std::uint64_t count, bool all) {
    if (!all && count <= piece_) return keep(blocks, count);
    // One part in many thousands is too large by chance, and is divided again.
    const std::uint64_t parts = std::clamp<std::uint64_t>(count * 16 / (piece_ * 15) + 1, 2, most_parts);
    const Survey survey = survey_of(blocks, count, parts, all);
    if (count <= piece_) return keep(blocks, count);
    if (survey.low == survey.high) return keep_best(blocks, count, survey);
    const std::vector<std::uint64_t> last = last_keys(survey, parts);
    const std::vector<std::uint64_t> sizes = divide(blocks, survey, last, all);
    const unsigned level = level_++;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      const std::string name = part_name(level, k);
      if (sizes[k] > 0)
        sort([this, &name](const auto& use) { read_part(folder_.file(name), use); }, sizes[k], false);
      folder_.remove_file(name);
      if (all) traffic_.progress(0.5 + 0.5 * static_cast<double>(k + 1) / static_cast<double>(sizes.size()));
    }
    --level_;
  }

  static std::string part_name(unsigned level, std::size_t part) {
    return "part_" + std::to_string(level) + "_" + std::to_string(part);
  }

  /// The positions that the curve goes through: wrapped in a periodic domain, to `wrapped`.
  /// \pre valid seeds
  std::span<const double> places(std::span<const double> positions, std::vector<double>& wrapped) const {
    if (period_ == nullptr) return positions;
    wrapped.resize(positions.size());
    wrap_all(*period_, positions, setup_.threads, wrapped);
    return wrapped;
  }

  Survey survey_of(const Blocks& blocks, std::uint64_t count, std::uint64_t parts, bool check) {
    Survey survey;
    const std::uint64_t stride = std::max<std::uint64_t>(count / (parts * samples_of_part), 1);
    std::uint64_t seen = 0;
    std::optional<InputFault> fault;
    std::vector<double> wrapped;
    blocks([&](const SeedBlock& block) {
      if (check) {
        note_fault(block, fault);
        traffic_.progress(0.25 * static_cast<double>(block.id.back() + 1) / static_cast<double>(count));
      }
      if (fault) return;  // that of the lowest order is still to be found
      const std::span<const double> at = places(block.positions, wrapped);
      for (std::size_t i = 0; i < block.size(); ++i, ++seen) {
        const double* const p = &at[i * d_];
        if (seen == 0) survey.low.assign(p, p + d_), survey.high = survey.low;
        for (std::size_t k = 0; k < d_; ++k) {
          survey.low[k] = std::min(survey.low[k], p[k]);
          survey.high[k] = std::max(survey.high[k], p[k]);
        }
        if (seen % stride == 0) survey.sample.insert(survey.sample.end(), p, p + d_);
        const std::pair entry{block.id[i], block.weights[i]};
        if (!survey.best || entry.second > survey.best->second ||
            (entry.second == survey.best->second && entry.first < survey.best->first))
          survey.best = entry;
      }
    });
    if (fault) refuse_seed(fault->fault.seed, fault->fault.why);
    return survey;
  }

  /// Remembers the fault that a diagram of all seeds would name.
  void note_fault(const SeedBlock& block, std::optional<InputFault>& first) const {
    std::optional<InputFault> fault =
        first_fault(setup_, {source_.dimension, block.positions, block.weights});
    if (!fault || (first && first->order <= fault->order)) return;
    fault->fault.seed += static_cast<std::size_t>(block.id.front());
    first = std::move(fault);
  }

  /// The last place of each part along the curve but the last part's. A place that many seeds share is a part
  /// of its own, whose box is smaller, so that it can be divided further.
  std::vector<std::uint64_t> last_keys(const Survey& survey, std::uint64_t parts) const {
    std::vector<std::uint64_t> keys =
        hilbert_keys(survey.sample, source_.dimension, survey.low, survey.high, setup_.threads);
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint64_t> last;
    for (std::uint64_t k = 1; k < parts; ++k) {
      const std::uint64_t key = keys[keys.size() * k / parts];
      const auto [first, end] = std::equal_range(keys.begin(), keys.end(), key);
      const bool many = static_cast<std::uint64_t>(end - first) * parts * 2 > keys.size();
      if (many && key > 0) last.push_back(key - 1);
      last.push_back(key);
    }
    std::sort(last.begin(), last.end());
    last.erase(std::unique(last.begin(), last.end()), last.end());
    return last;
  }

  /// Writes a file for each part.
  /// \return their numbers of seeds
  std::vector<std::uint64_t> divide(const Blocks& blocks, const Survey& survey,
                                    const std::vector<std::uint64_t>& last, bool all) {
    std::vector<FileWriter> files;
    for (std::size_t k = 0; k <= last.size(); ++k)
      files.emplace_back(folder_.file(part_name(level_, k)), FileWriter::Kind::scratch);
    std::uint64_t seen = 0;
    std::vector<std::byte> row(row_bytes());
    std::vector<double> wrapped;
    blocks([&](const SeedBlock& block) {
      const std::vector<std::uint64_t> keys = hilbert_keys(
          places(block.positions, wrapped), source_.dimension, survey.low, survey.high, setup_.threads);
      for (std::size_t i = 0; i < block.size(); ++i) {
        FileWriter& file = files[static_cast<std::size_t>(
            std::lower_bound(last.begin(), last.end(), keys[i]) - last.begin())];
        std::memcpy(row.data(), &block.id[i], sizeof(double));
        std::memcpy(&row[sizeof(double)], &block.positions[i * d_], d_ * sizeof(double));
        std::memcpy(&row[(d_ + 1) * sizeof(double)], &block.weights[i], sizeof(double));
        file.write_all(row);
      }
      seen += block.size();
      if (all)
        traffic_.progress(0.25 + 0.25 * static_cast<double>(seen) / static_cast<double>(source_.count));
    });
    std::vector<std::uint64_t> sizes;
    for (FileWriter& file : files) {
      file.close();
      traffic_.written += file.bytes();
      sizes.push_back(file.bytes() / row_bytes());
    }
    return sizes;
  }

  /// Makes a piece of seeds that fit into memory.
  void keep(const Blocks& blocks, std::uint64_t count) {
    SeedBlock all;
    all.id.reserve(count);
    all.positions.reserve(count * d_);
    all.weights.reserve(count);
    blocks([&](const SeedBlock& block) {
      all.id.insert(all.id.end(), block.id.begin(), block.id.end());
      all.positions.insert(all.positions.end(), block.positions.begin(), block.positions.end());
      all.weights.insert(all.weights.end(), block.weights.begin(), block.weights.end());
    });
    std::vector<double> wrapped;
    SeedSet set = make_seed_set({source_.dimension, places(all.positions, wrapped), all.weights},
                                source_.dimension, setup_.threads);
    SeedBlock piece{std::vector<std::uint64_t>(set.size()),
                    std::vector<double>(set.positions.size()),
                    std::move(set.weights),
                    {}};
    parallel_for(threads_for(piece.size(), setup_.threads), piece.size(),
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t rank = begin; rank < end; ++rank) {
                     piece.id[rank] = all.id[set.input[rank]];
                     copy_point(&all.positions[set.input[rank] * d_], d_, &piece.positions[rank * d_]);
                   }
                 });
    if (period_ != nullptr) piece.wrapped = std::move(set.positions);
    store_.add_duplicates(set.duplicate.size());
    store_.add(std::move(piece));
  }

  /// Keeps one of many seeds at one position.
  void keep_best(const Blocks& blocks, std::uint64_t count, const Survey& survey) {
    blocks([&](const SeedBlock& block) {
      const auto best = std::find(block.id.begin(), block.id.end(), survey.best->first);
      if (best == block.id.end()) return;
      const std::size_t at = static_cast<std::size_t>(best - block.id.begin());
      const auto position = block.positions.begin() + static_cast<std::ptrdiff_t>(at * d_);
      SeedBlock one{
          {block.id[at]}, {position, position + static_cast<std::ptrdiff_t>(d_)}, {block.weights[at]}, {}};
      (void)places(one.positions, one.wrapped);
      store_.add(std::move(one));
    });
    store_.add_duplicates(count - 1);
  }

  const SeedSource& source_;
  const DiagramSetup& setup_;
  std::size_t d_;
  std::uint64_t piece_;
  const LockedFolder& folder_;
  Traffic& traffic_;
  const Period* period_;
  StoreWriter store_;
  unsigned level_ = 0;  // of files of parts
};

}  // namespace

void sort_seeds(const SeedSource& source, const DiagramSetup& setup, std::uint64_t piece,
                const LockedFolder& folder, Traffic& traffic) {
  Sorter(source, setup, piece, folder, traffic).run();
}

}  // namespace powercell::out_of_core
