// Computations out of core that are stopped, go on, and are refused.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <powercell/error.hpp>

#include "tests/out_of_core/compute.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

OutOfCoreReport compute_into(Taken& taken, const SeedArray& seeds, const OutOfCoreOptions& options,
                             const std::string& name = "seeds of a test") {
  SeedSource source = source_of(seeds);
  source.name = name;
  return compute_out_of_core(
      test_device(), unit_box(seeds.dimension), source, [&](const CellRows& rows) { taken.add(rows); },
      options);
}

/// The message of a refusal.
std::string refusal(ErrorCode code, const SeedArray& seeds, const OutOfCoreOptions& options,
                    const std::string& name = "seeds of a test") {
  Taken taken;
  try {
    compute_into(taken, seeds, options, name);
  } catch (const Error& error) {
    CHECK(error.code() == code);
    return error.what();
  }
  FAIL("was not refused");
  return {};
}

bool says(const std::string& message, const std::string& what) {
  return message.find(what) != std::string::npos;
}

SeedArray some_seeds(std::size_t count = 500) {
  Random random(test_seed());
  return random_seeds(Distribution::white, WeightRange::W2, count, 3, random);
}

}  // namespace

TEST_CASE("out of core: stopped at each report of progress, and gone on with, gives the same bits") {
  INFO(replay_hint());
  const SeedArray seeds = some_seeds();
  Taken whole;
  {
    const ScratchFolder folder;
    compute_into(whole, seeds, options_in(folder, 120));
  }
  const ScratchFolder folder;
  OutOfCoreOptions options = options_in(folder, 120);
  Taken taken;
  std::uint64_t kept = 0;
  int stops = 0;
  for (int calls = 1;; ++calls) {
    int left = calls;
    double last = 0;
    options.diagram.progress = [&](double done) {
      CHECK(done >= last);
      last = done;
      return --left > 0;
    };
    taken = {};
    try {
      kept = compute_into(taken, seeds, options).kept;
      break;
    } catch (const Error& error) {
      REQUIRE(error.code() == ErrorCode::interrupted);
      ++stops;
    }
  }
  CHECK(stops > 5);
  CHECK(kept > 0);
  CHECK_FALSE(folder.is_there());
  CHECK(same_bits(taken, whole));
}

TEST_CASE("out of core: what takes the cells may fail, and loses no piece") {
  const SeedArray seeds = some_seeds();
  const ScratchFolder folder;
  const OutOfCoreOptions options = options_in(folder, 120);
  const auto fail = [](const CellRows&) { throw Error(ErrorCode::write_failed, "full"); };
  CHECK_THROWS_AS(compute_out_of_core(test_device(), unit_box(3), source_of(seeds), fail, options), Error);
  REQUIRE(folder.is_there());
  Taken taken;
  const OutOfCoreReport report = compute_into(taken, seeds, options);
  CHECK(report.kept == report.pieces);
  CHECK(report.clipped == 0);
  CHECK(taken.measures.mass.size() == seeds.size());
}

TEST_CASE("out of core: a folder of another computation is refused, with what differs") {
  const SeedArray seeds = some_seeds();
  const ScratchFolder folder;
  OutOfCoreOptions options = options_in(folder, 120);
  options.diagram.progress = [](double done) { return done < 0.5; };
  refusal(ErrorCode::interrupted, seeds, options);
  options.diagram.progress = {};
  CHECK(says(refusal(ErrorCode::invalid_argument, seeds, options, "changed since"), "the seeds"));
  options.piece_seeds = 130;
  CHECK(says(refusal(ErrorCode::invalid_argument, seeds, options), "the seeds of a piece"));
  options.piece_seeds = 120;
  options.walls = false;
  CHECK(says(refusal(ErrorCode::invalid_argument, seeds, options), "whether walls are wanted"));
  options.walls = true;
  CHECK_THROWS_WITH_AS(compute_out_of_core(
                           test_device(), Domain::box(std::vector{0.0, 0.0, 0.0}, std::vector{1.0, 1.0, 2.0}),
                           source_of(seeds), [](const CellRows&) {}, options),
                       doctest::Contains("the vertices of the domain"), Error);
  Taken taken;
  CHECK(compute_into(taken, seeds, options).kept > 0);
}

TEST_CASE("out of core: a full disk, and files that are cut off") {
  const SeedArray seeds = some_seeds();
  const ScratchFolder folder;
  const OutOfCoreOptions options = options_in(folder, 120);
  SeedSource source = source_of(seeds);
  const auto fill = [&](const std::string& name) {
    source.read = [&, name](std::uint64_t first, std::span<double> positions, std::span<double> weights) {
      source_of(seeds).read(first, positions, weights);
      std::error_code ignored;
      std::filesystem::create_symlink("/dev/full", folder.path() + "/" + name, ignored);
    };
    CHECK_THROWS_WITH_AS(compute_out_of_core(
                             test_device(), unit_box(3), source, [](const CellRows&) {}, options),
                         doctest::Contains("free some space"), Error);
  };
  fill("pieces.unfinished");
  CHECK_FALSE(folder.is_there());  // nothing was finished
  fill("piece_2.unfinished");
  REQUIRE(folder.is_there());
  std::filesystem::remove(folder.path() + "/piece_2.unfinished");
  std::filesystem::resize_file(folder.path() + "/piece_1", 1000);
  CHECK(says(refusal(ErrorCode::invalid_file, seeds, options), "remove its folder"));
  std::filesystem::remove(folder.path() + "/piece_1");
  Taken taken;
  CHECK(compute_into(taken, seeds, options).kept > 0);
}

TEST_CASE("out of core: a folder with other files is refused, and left as it is") {
  const SeedArray seeds = some_seeds(10);
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.path() + "/photos");
  refusal(ErrorCode::invalid_argument, seeds, options_in(folder, 0));
  CHECK(std::filesystem::exists(folder.path() + "/photos"));
}

TEST_CASE("out of core: a process killed while it wrote the first file of its folder is gone on with") {
  const SeedArray seeds = some_seeds(10);
  const ScratchFolder folder;
  std::filesystem::create_directories(folder.path());
  for (const char* const name : {"lock", "call.txt.unfinished"})
    std::ofstream(folder.path() + "/" + name) << "the seeds: 1";
  Taken taken;
  CHECK(compute_into(taken, seeds, options_in(folder, 0)).kept == 0);
  CHECK_FALSE(folder.is_there());
}

TEST_CASE("out of core: wrong seeds are named as a diagram names them") {
  SeedArray seeds = some_seeds();
  const ScratchFolder folder;
  const OutOfCoreOptions options = options_in(folder, 120);
  seeds.weights[456] = std::numeric_limits<double>::infinity();
  const auto of_diagram = [&]() -> std::string {
    try {
      Diagram(test_device(), unit_box(3)).set_seeds(seeds.view());
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  CHECK(refusal(ErrorCode::invalid_seed, seeds, options) == of_diagram());
  seeds.positions[1000] = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal(ErrorCode::invalid_seed, seeds, options) == of_diagram());
}

TEST_CASE("out of core: too little memory is refused, with the least that is enough") {
  const SeedArray seeds = some_seeds(200);
  const ScratchFolder folder;
  OutOfCoreOptions options = options_in(folder, 0);
  options.memory = std::uint64_t{1} << 20;
  const std::string message = refusal(ErrorCode::invalid_argument, seeds, options);
  CHECK_FALSE(folder.is_there());
  const std::size_t at = message.find("the least is ");
  REQUIRE(at != std::string::npos);
  options.memory = std::stoull(message.substr(at + 13)) << 20;
  Taken taken;
  CHECK(compute_into(taken, seeds, options).pieces == 1);
}

TEST_CASE("out of core: domains and options of one diagram alone are refused") {
  const SeedArray seeds = some_seeds(10);
  const ScratchFolder folder;
  OutOfCoreOptions options = options_in(folder, 0);
  options.diagram.decisions = Decisions::fast;
  CHECK(says(refusal(ErrorCode::unsupported, seeds, options), "out of core"));
  options.diagram.decisions = Decisions::exact;
  options.diagram.precision = Precision::float32;
  CHECK(says(refusal(ErrorCode::unsupported, seeds, options), "double precision"));
  CHECK_FALSE(folder.is_there());
}
