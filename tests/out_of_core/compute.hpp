/// \file
/// Cells computed out of core, in memory.
#pragma once

#include <unistd.h>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <powercell/out_of_core.hpp>
#include <string>

#include "tests/exchange/compare.hpp"

namespace powercell::test {

/// A name for a folder that is not there; what is there in the end is removed.
class ScratchFolder {
 public:
  ScratchFolder() {
    static std::atomic<int> number{0};
    path_ = (std::filesystem::temp_directory_path() /
             ("powercell_out_of_core_" + std::to_string(getpid()) + "_" + std::to_string(number++)))
                .string();
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::string& path() const { return path_; }
  bool is_there() const { return std::filesystem::exists(path_); }

 private:
  std::string path_;
};

inline SeedSource source_of(const SeedArray& seeds) {
  return {seeds.size(), seeds.dimension, "seeds of a test",
          [&seeds](std::uint64_t first, std::span<double> positions, std::span<double> weights) {
            const auto d = static_cast<std::size_t>(seeds.dimension);
            std::copy_n(&seeds.positions[first * d], positions.size(), positions.begin());
            std::copy_n(&seeds.weights[first], weights.size(), weights.begin());
          }};
}

inline OutOfCoreOptions options_in(const ScratchFolder& folder, std::uint64_t piece_seeds) {
  OutOfCoreOptions options;
  options.folder = folder.path();
  options.piece_seeds = piece_seeds;
  options.walls = true;
  return options;
}

/// All that is given, in one.
struct Taken {
  Measures measures;
  std::vector<std::uint64_t> offset{0}, neighbor;
  std::vector<double> wall;
  std::vector<std::array<std::int32_t, 3>> shift;
  std::uint64_t all_walls = 0;

  void add(const CellRows& rows) {
    REQUIRE(rows.first == measures.mass.size());
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(measures.mass, rows.measures.mass);
    append(measures.centroid, rows.measures.centroid);
    append(measures.second_moment, rows.measures.second_moment);
    append(measures.status, rows.measures.status);
    const std::uint64_t before = offset.back();
    for (std::size_t i = 1; i < rows.offset.size(); ++i) offset.push_back(before + rows.offset[i]);
    append(neighbor, rows.neighbor);
    append(wall, rows.wall);
    append(shift, rows.shift);
    all_walls = rows.all_walls;
  }
};

inline bool same_bits(const Taken& a, const Taken& b) {
  const auto same = [](const auto& u, const auto& v) {
    return u.size() == v.size() &&
           (u.empty() || std::memcmp(u.data(), v.data(), u.size() * sizeof u[0]) == 0);
  };
  return same(a.measures.mass, b.measures.mass) && same(a.measures.centroid, b.measures.centroid) &&
         same(a.measures.second_moment, b.measures.second_moment) &&
         same(a.measures.status, b.measures.status) && same(a.offset, b.offset) &&
         same(a.neighbor, b.neighbor) && same(a.wall, b.wall) && same(a.shift, b.shift);
}

/// Adds the cells of pieces of up to some seeds. \param walls  as in the options
inline OutOfCoreReport compute_pieces(const Diagram& diagram, const SeedArray& seeds,
                                      std::uint64_t piece_seeds, bool walls, Taken& taken) {
  const ScratchFolder folder;
  OutOfCoreOptions options = options_in(folder, piece_seeds);
  options.walls = walls;
  const OutOfCoreReport report = compute_out_of_core(
      diagram.device(), diagram.domain(), source_of(seeds), [&](const CellRows& rows) { taken.add(rows); },
      options);
  CHECK_FALSE(folder.is_there());
  return report;
}

/// The cells of pieces of up to some seeds are those of one diagram, also where walls are only counted.
inline OutOfCoreReport check_pieces(Diagram& diagram, const SeedArray& seeds, std::uint64_t piece_seeds) {
  Taken taken, counted;
  const OutOfCoreReport report = compute_pieces(diagram, seeds, piece_seeds, true, taken);
  std::vector<std::uint64_t> ids(seeds.size());
  std::iota(ids.begin(), ids.end(), std::uint64_t{0});
  check_cells(diagram, ids, taken);
  CHECK(taken.all_walls == taken.neighbor.size());
  CHECK(report.cells == diagram.measures().count(SeedStatus::ok));
  CHECK(report.duplicate == diagram.measures().count(SeedStatus::duplicate));
  CHECK(report.fetched >= report.neighbors);
  const OutOfCoreReport of_counts = compute_pieces(diagram, seeds, piece_seeds, false, counted);
  CHECK(counted.all_walls == taken.neighbor.size());
  CHECK(of_counts.neighbors == report.neighbors);
  CHECK(of_counts.again == report.again);
  taken.neighbor.clear();
  taken.wall.clear();
  taken.shift.clear();
  CHECK(same_bits(counted, taken));
  return report;
}

}  // namespace powercell::test
