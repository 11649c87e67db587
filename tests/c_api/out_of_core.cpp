// Seeds out of core from C, against one diagram; callbacks that stop, throw and fail; refusals.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "tests/c_api/handles.hpp"

using namespace powercell::c_api_test;

namespace {

constexpr size_t seed_count = 400;

/// What the callbacks work with.
struct Run {
  std::vector<double> positions, weights, mass, centroid, second_moment, wall;
  std::vector<uint8_t> status;
  std::vector<uint64_t> offset{0}, neighbor;
  std::vector<int32_t> shift;
  uint64_t all_walls = 0;
  size_t taken = 0, read = 0;
  bool leaves_weights = false;
  enum class Ending { none, stops, throws } reading = Ending::none, taking = Ending::none;

  explicit Run(int dimension) {
    uint64_t state = 1;
    const auto next = [&state] {
      state = state * 6364136223846793005U + 1442695040888963407U;
      return static_cast<double>(state >> 11) / 9007199254740992.0;
    };
    for (size_t i = 0; i < seed_count * static_cast<size_t>(dimension); ++i) positions.push_back(next());
    for (size_t i = 0; i < seed_count; ++i) weights.push_back(0.02 * next());
  }
};

int ended(Run::Ending ending) {
  if (ending == Run::Ending::throws) throw std::runtime_error("no disk");
  return ending == Run::Ending::stops ? 0 : 1;
}

int read_seeds(uint64_t first, size_t count, double* positions, double* weights, void* user) {
  Run& run = *static_cast<Run*>(user);
  const size_t d = run.positions.size() / seed_count;
  run.read += count;
  std::copy_n(&run.positions[first * d], count * d, positions);
  if (!run.leaves_weights) std::copy_n(&run.weights[first], count, weights);
  return ended(run.reading);
}

int take_cells(const pc_cell_rows* rows, void* user) {
  Run& run = *static_cast<Run*>(user);
  const pc_measures& cells = *rows->measures;
  const auto append = [](auto& to, const auto* from, size_t count) {
    if (from) to.insert(to.end(), from, from + count);
  };
  if (rows->first != run.taken) return 0;
  run.taken += cells.count;
  append(run.mass, cells.mass, cells.count);
  append(run.centroid, cells.centroid, cells.count * static_cast<size_t>(cells.dimension));
  append(run.second_moment, cells.second_moment, cells.count);
  append(run.status, cells.status, cells.count);
  const uint64_t before = run.offset.back(), walls = rows->offset[cells.count];
  for (size_t i = 1; i <= cells.count; ++i) run.offset.push_back(before + rows->offset[i]);
  append(run.neighbor, rows->neighbor, walls);
  append(run.wall, rows->wall, walls);
  append(run.shift, rows->shift, 3 * walls);
  run.all_walls = rows->all_walls;
  return ended(run.taking);
}

/// Arguments of a call, and a folder that is not there.
struct Call {
  std::string folder =
      (std::filesystem::temp_directory_path() / ("powercell_c_out_of_core_" + std::to_string(getpid())))
          .string();
  Run run;
  Domain domain;
  pc_seed_source source{};
  pc_out_of_core_options options{};
  pc_options diagram{};
  Owned<const pc_out_of_core_report, pc_out_of_core_report_destroy> report;

  explicit Call(int dimension, bool periodic = false) : run(dimension) {
    const int axes[3] = {1, 1, 0};
    REQUIRE((periodic ? pc_domain_periodic_box(low, high, axes, dimension, &domain.handle)
                      : pc_domain_box(low, high, dimension, &domain.handle)) == PC_OK);
    REQUIRE(pc_seed_source_init(&source, sizeof source) == PC_OK);
    source.count = seed_count;
    source.dimension = dimension;
    source.name = "seeds of a test";
    source.read = read_seeds;
    source.user = &run;
    REQUIRE(pc_out_of_core_options_init(&options, sizeof options) == PC_OK);
    CHECK(options.memory == uint64_t{1} << 32);
    options.folder = folder.c_str();
    options.piece_seeds = 100;
    options.walls = 1;
    REQUIRE(pc_options_init(&diagram, sizeof diagram) == PC_OK);
    options.diagram = &diagram;
  }
  ~Call() { std::filesystem::remove_all(folder); }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  pc_status compute() {
    const int dimension = source.dimension;
    pc_out_of_core_report_destroy(report.handle);
    report.handle = nullptr;
    Run fresh(dimension);
    for (auto* const values : {&run.mass, &run.centroid, &run.second_moment, &run.wall}) values->clear();
    run.status.clear(), run.neighbor.clear(), run.shift.clear();
    run.offset = fresh.offset;
    run.taken = run.read = 0;
    return pc_compute_out_of_core(shared_device(), domain.handle, &source, take_cells, &run, &options,
                                  &report.handle);
  }
};

void compare(Call& call) {
  Diagram diagram;
  const Run& run = call.run;
  REQUIRE(pc_diagram_create(shared_device(), call.domain.handle, nullptr, &diagram.handle) == PC_OK);
  REQUIRE(pc_diagram_set_seeds(diagram.handle, run.positions.data(),
                               run.leaves_weights ? nullptr : run.weights.data(), seed_count) == PC_OK);
  const pc_measures* cells = nullptr;
  const pc_adjacency* walls = nullptr;
  REQUIRE(pc_diagram_measures_view(diagram.handle, &cells) == PC_OK);
  REQUIRE(pc_diagram_adjacency_view(diagram.handle, &walls) == PC_OK);
  REQUIRE(run.mass.size() == seed_count);
  CHECK(std::equal(run.status.begin(), run.status.end(), cells->status));
  CHECK(std::equal(run.offset.begin(), run.offset.end(), walls->offset));
  for (size_t i = 0; i < seed_count; ++i) {
    CHECK(std::abs(run.mass[i] - cells->mass[i]) < 1e-13);
    CHECK(std::abs(run.second_moment[i] - cells->second_moment[i]) < 1e-13);
  }
  for (size_t k = 0; k < run.centroid.size(); ++k)
    CHECK((std::isnan(cells->centroid[k]) ? std::isnan(run.centroid[k])
                                          : std::abs(run.centroid[k] - cells->centroid[k]) < 1e-10));
  CHECK(run.all_walls == walls->entry_count);
  CHECK(call.report->cells == cells->status_count[PC_SEED_OK]);
  CHECK(call.report->hidden == cells->status_count[PC_SEED_HIDDEN]);
  CHECK(call.report->duplicate == cells->status_count[PC_SEED_DUPLICATE]);
  CHECK(std::abs(call.report->measure - cells->domain_measure) < 1e-12);
  CHECK(call.report->domain_measure == cells->domain_measure);
  if (!call.options.walls) {
    CHECK(run.neighbor.empty());
    CHECK(run.wall.empty());
    return;
  }
  REQUIRE(run.neighbor.size() == walls->entry_count);
  CHECK(std::equal(run.neighbor.begin(), run.neighbor.end(), walls->neighbor));
  for (size_t k = 0; k < run.wall.size(); ++k) CHECK(std::abs(run.wall[k] - walls->wall[k]) < 1e-10);
  CHECK(run.shift.size() == (walls->shift ? 3 * walls->entry_count : 0));
  CHECK(std::equal(run.shift.begin(), run.shift.end(), walls->shift));
}

}  // namespace

TEST_CASE("seeds out of core have the cells of one diagram") {
  for (const int dimension : {2, 3})
    for (const bool periodic : {false, true})
      for (const int walls : {0, 1}) {
        CAPTURE(dimension);
        CAPTURE(periodic);
        CAPTURE(walls);
        Call call(dimension, periodic);
        call.options.walls = walls;
        call.run.leaves_weights = walls == 0 && periodic;
        REQUIRE(call.compute() == PC_OK);
        CHECK(call.run.read == 2 * seed_count);
        CHECK(call.report->pieces >= 4);
        CHECK(call.report->kept == 0);
        CHECK(call.report->fetched >= call.report->neighbors);
        CHECK(call.report->neighbors > 0);
        CHECK(call.report->clipped >= call.report->cells);
        CHECK(call.report->rounds >= call.report->pieces);
        CHECK(call.report->bytes_read > 0);
        CHECK(call.report->bytes_written > 0);
        CHECK(call.report->sort + call.report->compute + call.report->gather > 0);
        CHECK_FALSE(std::filesystem::exists(call.folder));
        compare(call);
      }
}

TEST_CASE("callbacks of computations out of core may stop and throw, and the same call goes on") {
  Call call(3);
  using Ending = Run::Ending;
  call.run.reading = Ending::stops;
  CHECK(call.compute() == PC_INTERRUPTED);
  CHECK(message_has("stopped by the function that reads seeds"));
  call.run.reading = Ending::throws;
  CHECK(call.compute() == PC_INTERRUPTED);
  CHECK(message_has("the function that reads seeds threw an exception: no disk"));
  call.run.reading = Ending::none;
  CHECK_FALSE(std::filesystem::exists(call.folder));
  double most = 0.6;
  call.diagram.progress = [](double fraction, void* user) {
    return fraction < *static_cast<double*>(user) ? 1 : 0;
  };
  call.diagram.progress_user = &most;
  CHECK(call.compute() == PC_INTERRUPTED);
  CHECK(call.report.handle == nullptr);
  most = 2;
  call.run.taking = Ending::stops;
  CHECK(call.compute() == PC_INTERRUPTED);
  CHECK(message_has("stopped by the function that takes cells"));
  call.run.taking = Ending::throws;
  CHECK(call.compute() == PC_INTERRUPTED);
  CHECK(message_has("the function that takes cells threw an exception: no disk"));
  call.run.taking = Ending::none;
  call.source.name = "other seeds";
  CHECK(call.compute() == PC_INVALID_ARGUMENT);
  CHECK(message_has("the seeds"));
  call.source.name = "seeds of a test";
  REQUIRE(call.compute() == PC_OK);
  CHECK(call.report->kept == call.report->pieces);
  CHECK(call.run.read == 0);
  compare(call);
}

TEST_CASE("computations out of core refuse what is no source, no folder and no options") {
  Call call(2);
  pc_domain* const domain = call.domain.handle;
  const auto compute = [&](const pc_seed_source* source, pc_take_cells take,
                           const pc_out_of_core_options* options, const pc_out_of_core_report** report) {
    return pc_compute_out_of_core(shared_device(), domain, source, take, &call.run, options, report);
  };
  const pc_out_of_core_report** const report = &call.report.handle;
  CHECK(pc_compute_out_of_core(nullptr, domain, &call.source, take_cells, nullptr, &call.options, report) ==
        PC_INVALID_ARGUMENT);
  CHECK(pc_compute_out_of_core(shared_device(), nullptr, &call.source, take_cells, nullptr, &call.options,
                               report) == PC_INVALID_ARGUMENT);
  CHECK(compute(nullptr, take_cells, &call.options, report) == PC_INVALID_ARGUMENT);
  CHECK(compute(&call.source, nullptr, &call.options, report) == PC_INVALID_ARGUMENT);
  CHECK(compute(&call.source, take_cells, nullptr, report) == PC_INVALID_ARGUMENT);
  CHECK(message_has("folder"));
  CHECK(compute(&call.source, take_cells, &call.options, nullptr) == PC_INVALID_ARGUMENT);
  CHECK(call.run.read == 0);
  const auto refused = [&](const char* text) {
    CHECK(call.compute() == PC_INVALID_ARGUMENT);
    CHECK(message_has(text));
    call.source.name = "seeds of a test";
    call.source.read = read_seeds;
    call.source.dimension = 2;
    call.source.struct_size = sizeof call.source;
    call.options.struct_size = sizeof call.options;
  };
  for (const char* const name : {static_cast<const char*>(nullptr), ""}) {
    call.source.name = name;
    refused("needs a name");
  }
  call.source.read = nullptr;
  refused("a function that reads");
  call.source.dimension = 3;
  refused("3 coordinates");
  call.source.struct_size = 1;
  refused("pc_seed_source_init");
  call.options.struct_size = 1;
  refused("pc_out_of_core_options_init");
  call.options.memory = 1000;
  refused("the least is");
  call.options.memory = uint64_t{1} << 32;
  CHECK(pc_seed_source_init(nullptr, sizeof call.source) == PC_INVALID_ARGUMENT);
  CHECK(pc_out_of_core_options_init(nullptr, sizeof call.options) == PC_INVALID_ARGUMENT);
  call.diagram.precision = PC_FLOAT32;
  CHECK(call.compute() == PC_UNSUPPORTED);
  call.diagram.precision = PC_FLOAT64;
  call.run.positions[2 * 123] = nan_value;
  CHECK(call.compute() == PC_INVALID_SEED);
  CHECK(message_has("123"));
  CHECK_FALSE(std::filesystem::exists(call.folder));
}
