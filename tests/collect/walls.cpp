#include "lib/collect/walls.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "kernels/layout.h"

using namespace powercell;

namespace {

constexpr double negligible = 0.25, unit = 3;

/// Random pieces: several per cell, with two-sided and one-sided walls.
struct Pieces {
  std::vector<std::uint32_t> pair_seed;
  std::vector<std::vector<std::pair<std::int32_t, double>>> faces;  // by pair
  SeedSet seeds;
  std::vector<SeedStatus> status;  // by input index
};

Pieces random_pieces(std::uint32_t ranks, unsigned seed) {
  std::mt19937 generator(seed);
  Pieces p;
  p.seeds.input_count = ranks;
  p.seeds.input.resize(ranks);
  std::iota(p.seeds.input.begin(), p.seeds.input.end(), 0U);
  std::shuffle(p.seeds.input.begin(), p.seeds.input.end(), generator);
  std::vector<std::vector<std::pair<std::int32_t, double>>> walls(ranks);
  const auto measure = [&] { return 1 + static_cast<double>(generator() % 64) / 64; };
  for (std::uint32_t k = 0; k < 4 * ranks; ++k) {
    const std::uint32_t i = generator() % ranks,
                        j = k % 8 == 0 ? generator() % ranks : (i + 1 + k % 90) % ranks;
    if (i == j) continue;
    const double here = measure();
    walls[i].emplace_back(j, k % 64 == 1 ? 0.01 : here);
    if (k % 32 != 1) walls[j].emplace_back(i, here + 1e-3 * measure());
  }
  for (std::uint32_t i = 0; i < ranks; ++i) {
    p.status.push_back(generator() % 16 == 0 ? SeedStatus::hidden : SeedStatus::ok);
    const std::size_t pieces = i % 7 == 0 ? 0 : 1 + generator() % 3;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      p.pair_seed.push_back(i);
      auto& faces = p.faces.emplace_back();
      faces.emplace_back(~std::int32_t{2}, 7.0);  // a face at the boundary
      for (std::size_t k = piece; k < walls[i].size(); k += pieces) faces.push_back(walls[i][k]);
      if (piece > 0 && !walls[i].empty()) faces.push_back(walls[i].front());  // one wall in many pieces
    }
  }
  return p;
}

bool repeats_a_seed(const std::vector<std::pair<std::int32_t, double>>& faces) {
  std::map<std::int32_t, int> times;
  for (const auto& face : faces) ++times[face.first];
  return std::any_of(times.begin(), times.end(), [](const auto& time) { return time.second > 1; });
}

/// Rows that repeat a seed are in a batch of their own, marked `repeats`.
PieceSet piece_set(const Pieces& p, std::size_t begin, std::size_t end) {
  PieceSet set;
  set.add_batch().face_offset = {0};
  set.add_batch().face_offset = {0};
  set.batches[1].repeats = true;
  for (std::size_t k = begin; k < end; ++k) {
    const std::uint32_t which = repeats_a_seed(p.faces[k]) ? 1 : 0;
    PieceBatch& batch = set.batches[which];
    set.status.push_back(k % 11 == 0 ? PIECE_FLAT : PIECE_DONE);
    set.batch.push_back(which);
    set.row.push_back(static_cast<std::uint32_t>(batch.face_offset.size() - 1));
    for (const auto& [border, wall] : p.faces[k]) {
      batch.border.push_back(border);
      batch.wall.push_back(wall);
    }
    batch.face_offset.push_back(static_cast<std::uint32_t>(batch.border.size()));
  }
  return set;
}

Adjacency collected(const Pieces& p, std::size_t chunk, int threads) {
  WallCollector walls(p.seeds.size(), threads);
  for (std::size_t begin = 0; begin < p.pair_seed.size(); begin += chunk) {
    const std::size_t end = std::min(begin + chunk, p.pair_seed.size());
    walls.add(std::span(p.pair_seed).subspan(begin, end - begin), piece_set(p, begin, end));
  }
  return walls.finish(p.seeds, p.status, unit, negligible);
}

/// The adjacency by its definition, with maps.
Adjacency by_definition(const Pieces& p) {
  std::vector<std::map<std::uint32_t, double>> walls(p.seeds.size()), result(p.seeds.size());
  for (std::size_t k = 0; k < p.pair_seed.size(); ++k)
    for (const auto& [border, wall] : p.faces[k])
      if (border >= 0) walls[p.pair_seed[k]][static_cast<std::uint32_t>(border)] += wall;
  const auto ok = [&](std::uint32_t rank) { return p.status[p.seeds.input[rank]] == SeedStatus::ok; };
  const auto largest = [&](std::uint32_t rank) {
    double most = 0;
    for (const auto& wall : walls[rank]) most = std::max(most, wall.second);
    return most;
  };
  Adjacency a;
  for (std::uint32_t i = 0; i < walls.size(); ++i)
    for (const auto& [j, wall] : walls[i]) {
      if (!ok(i) || !ok(j)) continue;
      const auto back = walls[j].find(i);
      const bool both = back != walls[j].end();
      if (!both && !(wall > negligible * std::max(largest(i), largest(j)))) continue;
      const double mean = both ? (wall + back->second) / 2 : wall;
      const double difference = (both ? std::abs(wall - back->second) : wall) * unit;
      if (difference > a.asymmetry) a.asymmetric = {p.seeds.input[i], p.seeds.input[j]};
      a.asymmetry = std::max(a.asymmetry, difference);
      result[p.seeds.input[i]][p.seeds.input[j]] = result[p.seeds.input[j]][p.seeds.input[i]] = mean * unit;
    }
  a.offset = {0};
  for (const auto& row : result) {
    for (const auto& [j, wall] : row) {
      a.neighbor.push_back(j);
      a.wall.push_back(wall);
    }
    a.offset.push_back(a.neighbor.size());
  }
  return a;
}

}  // namespace

TEST_CASE("walls are collected as defined, for any chunks and threads") {
  for (const std::uint32_t ranks : {1U, 5U, 300U, 9000U}) {
    CAPTURE(ranks);
    const Pieces p = random_pieces(ranks, ranks);
    const Adjacency expected = by_definition(p);
    if (ranks > 5) CHECK(expected.asymmetry > unit);  // some one-sided walls are kept
    for (const std::size_t chunk : {std::size_t{1}, std::size_t{7}, std::size_t{3000}, std::size_t{1} << 20})
      for (const int threads : {1, 2, 5}) {
        if (chunk < 3000 && ranks > 300) continue;
        CAPTURE(chunk);
        CAPTURE(threads);
        const Adjacency got = collected(p, chunk, threads);
        REQUIRE(got.offset == expected.offset);
        CHECK(got.neighbor == expected.neighbor);
        CHECK(got.wall == expected.wall);
        CHECK(got.asymmetry == expected.asymmetry);
        CHECK(got.asymmetric == expected.asymmetric);
      }
  }
}

TEST_CASE("rows of any length are sorted, and equal keys keep their order") {
  std::mt19937 generator(3);
  for (std::size_t count = 0; count < 150; ++count)
    for (const std::uint32_t most : {0x7fffffffU, 20U}) {
      CAPTURE(count);
      CAPTURE(most);
      std::vector<std::uint32_t> key(count), sorted_key(count);
      std::vector<double> value(count), sorted_value(count);
      std::vector<std::pair<std::uint32_t, double>> expected;
      for (std::size_t k = 0; k < count; ++k) {
        key[k] = k == 3 ? most : generator() % most;
        value[k] = static_cast<double>(k);
        expected.emplace_back(key[k], value[k]);
      }
      std::sort(expected.begin(), expected.end());
      bool equal = false;
      for (std::size_t k = 1; k < count; ++k) equal |= expected[k].first == expected[k - 1].first;
      CHECK(sort_row(key.data(), value.data(), count, sorted_key.data(), sorted_value.data()) == equal);
      for (std::size_t k = 0; k < count; ++k) {
        CHECK(sorted_key[k] == expected[k].first);
        CHECK(sorted_value[k] == expected[k].second);
      }
    }
}
