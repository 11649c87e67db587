// What goes wrong on some ranks of C: the messages of C++ on all of them; arguments and callbacks that only C
// can get wrong.
#include "tests/c_api/ranks.hpp"

namespace powercell::c_ranks_test {
namespace {

/// How a call ended on a rank.
struct End {
  pc_status status = PC_OK;
  std::string message;
};

/// Seeds on three ranks in a cube.
struct Trio {
  static Random& random() {
    static Random random(test_seed());
    return random;
  }
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 90, 3, random());
  Shares shares = at_random(seeds, 3, random());
  pc_domain domain{unit_box(3)};

  /// Calls on all ranks, after `change(rank, arguments)`, and once more without: it must work then, unless
  /// transport has failed.
  template <class Change>
  std::vector<End> ends(const Change& change, bool compute_again = true) const {
    std::vector<End> all(3);
    on_c_ranks(3, [&](Rank& rank) {
      const Arguments good(rank, domain, shares);
      Arguments changed = good;
      change(rank, changed);
      End& end = all[static_cast<std::size_t>(good.communicator.rank)];
      Cells cells, more;
      end.status = changed.compute(&cells.handle);
      if (end.status != PC_OK) end.message = pc_last_error();
      CHECK((cells.handle == nullptr) == (end.status != PC_OK));
      if (compute_again) CHECK(good.compute(&more.handle) == PC_OK);
    });
    return all;
  }
};

/// What C++ throws on each rank, as a status and a message.
std::vector<End> ends_of_cpp(const Shares& shares, const std::vector<Domain>& domains,
                             const std::vector<DistributedOptions>& options) {
  const std::vector<exchange::ShardSeeds> view = shares.view();
  std::vector<End> all;
  for (const std::exception_ptr& thrown : on_ranks(view.size(), [&](Communicator& communicator) {
         const auto rank = static_cast<std::size_t>(communicator.rank());
         compute_distributed(communicator, test_device(), domains[rank], view[rank].ids, view[rank].seeds,
                             options[rank]);
       })) {
    all.emplace_back();
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      all.back() = {static_cast<pc_status>(static_cast<int>(error.code()) + 1), error.what()};
    }
  }
  return all;
}

void check_ends(const std::vector<End>& ends, const std::vector<End>& expected, const std::string& words) {
  REQUIRE(ends.size() == expected.size());
  for (std::size_t rank = 0; rank < ends.size(); ++rank) {
    CHECK(ends[rank].status == expected[rank].status);
    CHECK(ends[rank].message == expected[rank].message);
  }
  CAPTURE(ends[0].message);
  CHECK(ends[0].status != PC_OK);
  CHECK(ends[0].message.find(words) != std::string::npos);
}

/// The call on rank 1 with other arguments ends on all ranks with one message.
template <class Change>
void check_refused_on_all(pc_status status, const std::string& message, const Change& change) {
  CAPTURE(message);
  const Trio trio;
  const std::vector<End> ends = trio.ends([&](const Rank& rank, Arguments& arguments) {
    if (rank.threads.rank() == 1) change(arguments);
  });
  check_ends(ends, std::vector<End>(3, {status, message}), "rank 1: ");
}

}  // namespace

TEST_CASE("ranks from C: a bad seed, ids twice, domains and options that differ, as in C++") {
  const std::vector<Domain> cubes(3, unit_box(3));
  const std::vector<DistributedOptions> defaults(3);
  {
    Trio trio;
    trio.shares.positions[2][4] = c_api_test::nan_value;
    const std::vector<End> ends = trio.ends([](const Rank&, const Arguments&) {}, false);
    check_ends(ends, ends_of_cpp(trio.shares, cubes, defaults),
               "seed " + std::to_string(trio.shares.ids[2][1]) + ": coordinate y");
    CHECK(ends[1].status == PC_INVALID_SEED);
  }
  {
    Trio trio;
    trio.shares.ids[2].back() = trio.shares.ids[1].front();
    check_ends(trio.ends([](const Rank&, const Arguments&) {}, false),
               ends_of_cpp(trio.shares, cubes, defaults), "two seeds have the id ");
  }
  const Trio trio;
  const std::array low{0.0, 0.0, 0.0}, high{1.0, 1.0, 2.0};
  const Domain other = Domain::box(low, high);
  const pc_domain other_handle(other);
  check_ends(trio.ends([&](const Rank& rank, Arguments& arguments) {
    if (rank.threads.rank() == 2) arguments.domain = &other_handle;
  }),
             ends_of_cpp(trio.shares, {cubes[0], cubes[0], other}, defaults),
             "ranks 0 and 2 differ in the vertices of the domain");
  pc_distributed_options options;
  REQUIRE(pc_distributed_options_init(&options, sizeof options) == PC_OK);
  CHECK(options.redistribute == 0);
  CHECK(options.diagram == nullptr);
  options.redistribute = 1;
  pc_options diagram;
  REQUIRE(pc_options_init(&diagram, sizeof diagram) == PC_OK);
  diagram.decisions = PC_DECISIONS_FAST;
  options.diagram = &diagram;
  DistributedOptions differing{{}, true};
  differing.diagram.decisions = Decisions::fast;
  check_ends(trio.ends([&](const Rank& rank, Arguments& arguments) {
    if (rank.threads.rank() == 1) arguments.options = &options;
  }),
             ends_of_cpp(trio.shares, cubes, {{}, differing, {}}),
             "ranks 0 and 1 differ in Options::decisions");
  check_ends(trio.ends([&](const Rank&, Arguments& arguments) { arguments.options = &options; }),
             ends_of_cpp(trio.shares, cubes, {differing, differing, differing}), "distributed seeds need");
}

TEST_CASE("ranks from C: arguments that are none on one rank end the call on all, which then compute") {
  check_refused_on_all(PC_INVALID_ARGUMENT, "rank 1: device is NULL",
                       [](Arguments& arguments) { arguments.device = nullptr; });
  check_refused_on_all(PC_INVALID_ARGUMENT, "rank 1: domain is NULL",
                       [](Arguments& arguments) { arguments.domain = nullptr; });
  check_refused_on_all(PC_INVALID_ARGUMENT, "rank 1: ids is NULL",
                       [](Arguments& arguments) { arguments.ids = nullptr; });
  check_refused_on_all(PC_INVALID_ARGUMENT, "rank 1: positions is NULL",
                       [](Arguments& arguments) { arguments.positions = nullptr; });
  const std::size_t too_many = std::numeric_limits<std::size_t>::max() / 3 + 2;
  check_refused_on_all(PC_INVALID_ARGUMENT,
                       "rank 1: a count of " + std::to_string(too_many) + " exceeds the address space",
                       [&](Arguments& arguments) { arguments.count = too_many; });
  pc_options diagram;
  REQUIRE(pc_options_init(&diagram, sizeof diagram) == PC_OK);
  diagram.precision = static_cast<pc_precision>(9);
  pc_distributed_options options;
  REQUIRE(pc_distributed_options_init(&options, sizeof options) == PC_OK);
  options.diagram = &diagram;
  check_refused_on_all(PC_INVALID_ARGUMENT, "rank 1: options.precision is not a value of pc_precision",
                       [&](Arguments& arguments) { arguments.options = &options; });
  pc_distributed_options old = options;
  old.struct_size = 1;
  const Trio trio;
  const std::vector<End> ends = trio.ends([&](const Rank& rank, Arguments& arguments) {
    if (rank.threads.rank() == 1) arguments.options = &old;
  });
  check_ends(ends, std::vector<End>(3, ends[0]), "rank 1: a struct_size of 1 bytes");
  CHECK(ends[0].message.find("pc_distributed_options_init") != std::string::npos);
}

TEST_CASE("ranks from C: no place for the result on one rank ends the call on all") {
  const Trio trio;
  on_c_ranks(3, [&](Rank& rank) {
    const Arguments arguments(rank, trio.domain, trio.shares);
    Cells cells;
    CHECK(arguments.compute(rank.threads.rank() == 0 ? nullptr : &cells.handle) == PC_INVALID_ARGUMENT);
    CHECK(std::string(pc_last_error()) == "rank 0: the pointer for the result is NULL");
    CHECK(cells.handle == nullptr);
  });
}

TEST_CASE("ranks from C: progress that stops or throws on one rank ends the call on all") {
  pc_options diagram;
  REQUIRE(pc_options_init(&diagram, sizeof diagram) == PC_OK);
  pc_distributed_options options;
  REQUIRE(pc_distributed_options_init(&options, sizeof options) == PC_OK);
  options.diagram = &diagram;
  diagram.progress = [](double, void*) { return 0; };
  const Trio trio;
  const auto ends = [&] {
    return trio.ends([&](const Rank& rank, Arguments& arguments) {
      if (rank.threads.rank() == 2) arguments.options = &options;
    });
  };
  DistributedOptions stops;
  stops.diagram.progress = [](double) { return false; };
  check_ends(ends(), ends_of_cpp(trio.shares, std::vector<Domain>(3, unit_box(3)), {{}, {}, stops}),
             "rank 2: ");
  diagram.progress = [](double, void*) -> int { throw std::runtime_error("the disk is full"); };
  check_ends(ends(),
             std::vector<End>(
                 3, {PC_INTERRUPTED, "rank 2: the progress function threw an exception: the disk is full"}),
             "rank 2: ");
}

TEST_CASE(
    "ranks from C: an exchange that fails, whenever it does, ends the call on its rank with the reason") {
  const std::vector<std::pair<Rank::Ending, End>> endings{
      {Rank::Ending::stops,
       {PC_INTERRUPTED, "the computation was stopped by the function that exchanges messages"}},
      {Rank::Ending::throws,
       {PC_INTERRUPTED, "the function that exchanges messages threw an exception: the cable is cut"}},
      {Rank::Ending::throws_no_exception,
       {PC_INTERRUPTED, "the function that exchanges messages threw an exception: of unknown type"}},
      {Rank::Ending::loses_a_message,
       {PC_INVALID_ARGUMENT, "a communicator has lost messages: of 3 ranks it gave 0"}},
      {Rank::Ending::sends_twice, {PC_INVALID_ARGUMENT, "two messages come from rank 0 in one exchange"}},
      {Rank::Ending::comes_from_nowhere, {PC_INVALID_ARGUMENT, "a message comes from rank 3 of 3"}}};
  const Trio trio;
  for (const std::pair<Rank::Ending, End>& failure : endings)
    for (const int exchanges : {0, 1, 4}) {
      const End& end = failure.second;
      CAPTURE(end.message);
      CAPTURE(exchanges);
      const std::vector<End> ends = trio.ends(
          [&, how = failure.first](Rank& rank, const Arguments&) {
            if (rank.threads.rank() != 1) return;
            rank.left = exchanges;
            rank.ending = how;
          },
          false);
      CHECK(ends[1].status == end.status);
      CHECK(ends[1].message == end.message);
      for (const std::size_t other : {0, 2}) {
        CHECK(ends[other].status == PC_INTERRUPTED);
        CHECK(ends[other].message.find("a rank has ended that others wait for") != std::string::npos);
      }
    }
}

TEST_CASE("ranks from C: communicators that are none, and messages without room") {
  const Trio trio;
  on_c_ranks(1, [&](Rank& rank) {
    const Shares one(trio.seeds, std::vector<std::size_t>(trio.seeds.size()), 1);
    const auto refused = [&](const char* words, const auto& change) {
      CAPTURE(words);
      Arguments arguments(rank, trio.domain, one);
      change(arguments.communicator);
      Cells cells;
      CHECK(arguments.compute(&cells.handle) == PC_INVALID_ARGUMENT);
      CHECK(c_api_test::message_has(words));
      CHECK(cells.handle == nullptr);
    };
    refused("needs a function that exchanges", [](pc_communicator& of) { of.exchange = nullptr; });
    refused("pc_communicator_init", [](pc_communicator& of) { of.struct_size = 8; });
    refused("rank 1 of 1", [](pc_communicator& of) { of.rank = 1; });
    refused("rank -1 of 1", [](pc_communicator& of) { of.rank = -1; });
    refused("rank 0 of 0", [](pc_communicator& of) { of.size = 0; });
    // Nor are they those of an error.
    Arguments arguments(rank, trio.domain, one);
    arguments.communicator.rank = 5;
    arguments.device = nullptr;
    Cells cells;
    CHECK(arguments.compute(&cells.handle) == PC_INVALID_ARGUMENT);
    CHECK(c_api_test::message_has("rank 5 of 1"));
    CHECK(pc_compute_distributed(nullptr, arguments.device, arguments.domain, nullptr, nullptr, nullptr, 0,
                                 nullptr, &cells.handle) == PC_INVALID_ARGUMENT);
    CHECK(c_api_test::message_has("communicator is NULL"));
  });
  pc_communicator communicator;
  CHECK(pc_communicator_init(&communicator, 1) == PC_INVALID_ARGUMENT);
  CHECK(pc_communicator_init(nullptr, sizeof communicator) == PC_INVALID_ARGUMENT);
  pc_distributed_options options;
  CHECK(pc_distributed_options_init(&options, 1) == PC_INVALID_ARGUMENT);
  CHECK(pc_distributed_options_init(nullptr, sizeof options) == PC_INVALID_ARGUMENT);
  void* room = nullptr;
  CHECK(pc_mailbox_room(nullptr, 0, 1, &room) == PC_INVALID_ARGUMENT);
}

TEST_CASE("ranks from C: a message for which there is no memory, and one without a place") {
  const Trio trio;
  for (const bool has_place : {true, false}) {
    static bool place;
    place = has_place;
    on_c_ranks(1, [&](Rank& rank) {
      const Shares one(trio.seeds, std::vector<std::size_t>(trio.seeds.size()), 1);
      Arguments arguments(rank, trio.domain, one);
      arguments.count = 0;
      arguments.communicator.exchange = [](const pc_message*, pc_mailbox* mailbox, void*) {
        void* room = nullptr;
        CHECK(pc_mailbox_room(mailbox, 0, place ? std::numeric_limits<std::size_t>::max() : 1,
                              place ? &room : nullptr) == (place ? PC_OUT_OF_MEMORY : PC_INVALID_ARGUMENT));
        CHECK(room == nullptr);
        return 1;
      };
      Cells cells;
      CHECK(arguments.compute(&cells.handle) == (place ? PC_OUT_OF_MEMORY : PC_INVALID_ARGUMENT));
      CHECK(c_api_test::message_has(place ? "out of host memory" : "the pointer for the result is NULL"));
    });
  }
}

TEST_CASE("ranks from C: what shapes and seeds shared out anew refuse is refused on all ranks") {
  const Trio trio;
  on_c_ranks(3, [&](Rank& rank) {
    const Arguments own(rank, trio.domain, trio.shares);
    const bool first = own.communicator.rank == 0;
    const auto check_said = [](pc_status status, const std::string& words) {
      CAPTURE(pc_last_error());
      CHECK(status == PC_INVALID_ARGUMENT);
      CHECK(c_api_test::message_has(words));
    };
    const auto share_out = [&](int dimension, const double* positions, const pc_redistributed_seeds** seeds) {
      return pc_redistributed_seeds_create(&own.communicator, dimension, own.ids, positions, own.weights,
                                           own.count, nullptr, seeds);
    };
    c_api_test::Owned<const pc_redistributed_seeds, pc_redistributed_seeds_destroy> seeds;
    check_said(share_out(first ? 0 : 3, own.positions, &seeds.handle), "rank 0: dimension must be 2 or 3");
    check_said(share_out(3, first ? nullptr : own.positions, &seeds.handle), "rank 0: positions is NULL");
    check_said(share_out(3, own.positions, first ? nullptr : &seeds.handle), "rank 0: the pointer");
    REQUIRE(share_out(3, own.positions, &seeds.handle) == PC_OK);

    Cells cells, back;
    Arguments here = own;
    here.ids = seeds->ids;
    here.positions = seeds->positions;
    here.weights = seeds->weights;
    here.count = seeds->count;
    REQUIRE(here.compute(&cells.handle) == PC_OK);
    const auto send_back = [&](const pc_distributed_cells* sent, const pc_distributed_cells** result) {
      return pc_redistributed_seeds_send_back(seeds.handle, sent, result);
    };
    check_said(send_back(first ? nullptr : cells.handle, &back.handle), "rank 0: cells is NULL");
    check_said(send_back(cells.handle, first ? nullptr : &back.handle), "rank 0: the pointer");
    REQUIRE(send_back(cells.handle, &back.handle) == PC_OK);
    CHECK(back->count == own.count);
    check_said(pc_redistributed_seeds_send_back(nullptr, cells.handle, &back.handle), "seeds is NULL");

    const pc_local_diagram* local = nullptr;
    const auto shapes = [&](const pc_distributed_cells* of, const pc_local_diagram** result) {
      return pc_local_diagram_create(&here.communicator, here.device, here.domain, here.ids, here.positions,
                                     here.weights, here.count, of, nullptr, result);
    };
    check_said(shapes(first ? nullptr : cells.handle, &local), "rank 0: cells is NULL");
    check_said(shapes(cells.handle, first ? nullptr : &local), "rank 0: the pointer");
    here.count -= first ? 1 : 0;
    check_said(shapes(cells.handle, &local), "are not of one call");
    CHECK(local == nullptr);
  });
}

}  // namespace powercell::c_ranks_test
