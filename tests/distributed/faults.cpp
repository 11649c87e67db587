// What goes wrong on some ranks is thrown on all.
#include <doctest/doctest.h>

#include <limits>

#include "lib/exchange/messages.hpp"
#include "tests/distributed/ranks.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// What each rank calls with.
struct Call {
  Domain domain;
  DistributedOptions options;
};

/// The errors of all ranks, each of which has its own call.
std::vector<std::string> errors(const Shares& shares, const std::vector<Call>& calls, ErrorCode code) {
  const std::vector<exchange::ShardSeeds> view = shares.view();
  std::vector<std::string> texts;
  for (const std::exception_ptr& thrown : on_ranks(view.size(), [&](Communicator& communicator) {
         const auto rank = static_cast<std::size_t>(communicator.rank());
         compute_distributed(communicator, test_device(), calls[rank].domain, view[rank].ids,
                             view[rank].seeds, calls[rank].options);
       })) {
    try {
      texts.emplace_back();
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      CHECK(error.code() == code);
      texts.back() = error.what();
    }
  }
  return texts;
}

void check_all_say(const std::vector<std::string>& texts, const std::string& words) {
  REQUIRE(!texts.empty());
  for (const std::string& text : texts) CHECK(text == texts[0]);
  CAPTURE(texts[0]);
  CHECK(texts[0].find(words) != std::string::npos);
}

struct Three {
  SeedArray seeds;
  Shares shares;
  std::vector<Call> calls{3, {unit_box(3), {}}};

  explicit Three(SeedArray all = random_seeds(Distribution::white, WeightRange::W1, 90, 3, *random()))
      : seeds(std::move(all)), shares(at_random(seeds, 3, *random())) {}
  static Random* random() {
    static Random random(test_seed());
    return &random;
  }
};

}  // namespace

TEST_CASE("ranks: a bad seed on one of them is refused on all as in one diagram, by its id") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const bool redistribute : {false, true}) {
    Three given;
    given.seeds.coordinate(41, 1) = nan;
    given.seeds.weights[77] = 1e300;
    Three three(given.seeds);
    for (Call& call : three.calls) call.options.redistribute = redistribute;
    std::string expected;
    try {
      diagram_of(unit_box(3), given.seeds);
    } catch (const Error& error) {
      expected = error.what();
    }
    REQUIRE(expected.find("seed 41") != std::string::npos);
    const std::vector<std::string> texts = errors(three.shares, three.calls, ErrorCode::invalid_seed);
    check_all_say(texts, expected);
    CHECK(texts[0] == expected);
  }
}

TEST_CASE("ranks: an id that is there twice") {
  Three three;
  three.shares.ids[2].back() = three.shares.ids[1].front();
  const std::string id = std::to_string(three.shares.ids[1].front());
  check_all_say(errors(three.shares, three.calls, ErrorCode::invalid_argument),
                "two seeds have the id " + id + ", of ranks 1 and 2");
  Three other;
  other.shares.ids[2].back() = other.shares.ids[2].front();
  check_all_say(errors(other.shares, other.calls, ErrorCode::invalid_argument), ", both of rank 2");
}

TEST_CASE("ranks: other domains or options on some, and what differs") {
  const auto texts_with = [](std::size_t rank, const Call& call) {
    Three three;
    three.calls[rank] = call;
    return errors(three.shares, three.calls, ErrorCode::invalid_argument);
  };
  const std::array low{0.0, 0.0, 0.0}, high{1.0, 1.0, std::nextafter(1.0, 2.0)};
  check_all_say(texts_with(2, {Domain::box(low, high), {}}),
                "ranks 0 and 2 differ in the vertices of the domain;");
  check_all_say(texts_with(1, {unit_box(2), {}}), "ranks 0 and 1 differ in the kind of domain, the vertices");
  check_all_say(texts_with(0, {unit_box(3), {{}, true}}), "differ in DistributedOptions::redistribute;");
  Call call{unit_box(3), {}};
  call.options.diagram.decisions = Decisions::fast;
  call.options.diagram.certify = true;
  check_all_say(texts_with(1, call), "ranks 0 and 1 differ in Options::decisions, Options::certify;");
  call.options.diagram = {};
  call.options.diagram.precision = Precision::float32;
  check_all_say(texts_with(1, call), "differ in Options::precision;");

  // Threads and chunks are a matter of each rank.
  Three three;
  three.calls[1].options.diagram.threads = 1;
  three.calls[2].options.diagram.chunk_pairs = 100;
  CHECK(errors(three.shares, three.calls, ErrorCode::internal) == std::vector<std::string>(3));
}

TEST_CASE("ranks: what shards cannot have is refused without the name of a rank") {
  Three three;
  for (Call& call : three.calls) call.options.diagram.certify = true;
  check_all_say(errors(three.shares, three.calls, ErrorCode::unsupported), "the laws that Options::certify");
  for (Call& call : three.calls) call = {surface_of(icosphere(0)), {}};
  check_all_say(errors(three.shares, three.calls, ErrorCode::unsupported),
                "distributed seeds need a polygon");
  for (Call& call : three.calls) {
    call = {unit_box(3), {}};
    call.options.diagram.precision = Precision::float32;
  }
  check_all_say(errors(three.shares, three.calls, ErrorCode::unsupported), "distributed seeds need double");
}

TEST_CASE("ranks: an error on one of them ends the others, in whichever round") {
  Three three;
  three.shares.ids[1].pop_back();
  check_all_say(errors(three.shares, three.calls, ErrorCode::invalid_argument), "rank 1: ");
  // The last rank stops in each of the calls of its callback.
  const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W2, 300, 3, *Three::random());
  int all = 0;
  Three whole(seeds);
  whole.calls[2].options.diagram.progress = [&](double) { return ++all > 0; };
  CHECK(errors(whole.shares, whole.calls, ErrorCode::interrupted) == std::vector<std::string>(3));
  REQUIRE(all > 2);
  for (int calls = 1; calls <= all; ++calls) {
    CAPTURE(calls);
    Three stopped(seeds);
    stopped.shares = whole.shares;
    int left = calls;
    stopped.calls[2].options.diagram.progress = [&](double) { return --left > 0; };
    check_all_say(errors(stopped.shares, stopped.calls, ErrorCode::interrupted), "rank 2: ");
    CHECK(left == 0);
  }
}

TEST_CASE("ranks: after an error they can compute again") {
  Three three;
  const std::vector<exchange::ShardSeeds> view = three.shares.view();
  std::vector<DistributedCells> cells(3);
  std::vector<std::string> texts(3);
  for (const std::exception_ptr& thrown : on_ranks(3, [&](Communicator& communicator) {
         const auto rank = static_cast<std::size_t>(communicator.rank());
         DistributedOptions options;
         if (rank == 1)
           options.diagram.progress = [](double) -> bool { throw std::range_error("by the caller"); };
         try {
           compute_distributed(communicator, test_device(), unit_box(3), view[rank].ids, view[rank].seeds,
                               options);
         } catch (const Error& error) {
           texts[rank] = error.what();
         } catch (const std::range_error& error) {
           texts[rank] = "as thrown";
         }
         cells[rank] =
             compute_distributed(communicator, test_device(), unit_box(3), view[rank].ids, view[rank].seeds);
       }))
    REQUIRE(!thrown);
  CHECK(texts == std::vector<std::string>{"rank 1: by the caller", "as thrown", "rank 1: by the caller"});
  Diagram diagram = diagram_of(unit_box(3), three.seeds);
  for (std::size_t rank = 0; rank < 3; ++rank) check_cells(diagram, three.shares.ids[rank], cells[rank]);
}

TEST_CASE("ranks: a rank that is gone, and communicators that lose messages") {
  Three three;
  const std::vector<exchange::ShardSeeds> view = three.shares.view();
  const std::vector<std::exception_ptr> thrown = on_ranks(3, [&](Communicator& communicator) {
    const auto rank = static_cast<std::size_t>(communicator.rank());
    if (rank != 1)
      compute_distributed(communicator, test_device(), unit_box(3), view[rank].ids, view[rank].seeds);
  });
  CHECK(thrown[0]);
  CHECK(!thrown[1]);
  CHECK_THROWS_WITH(std::rethrow_exception(thrown[2]), "a rank has ended that others wait for");

  struct Losing : Communicator {
    int rank() const override { return own; }
    int size() const override { return 2; }
    std::vector<Message> exchange(std::vector<Message> messages) override {
      messages.pop_back();
      return messages;
    }
    int own = 0;
  } losing;
  CHECK_THROWS_WITH(compute_distributed(losing, test_device(), unit_box(3), view[0].ids, view[0].seeds),
                    "a communicator has lost messages: of 2 ranks it gave 1");
  const std::span<const std::uint64_t> none;
  DistributedOptions options;
  options.diagram.progress = [](double) -> bool { throw std::range_error("by the caller"); };
  CHECK_THROWS(compute_distributed(losing, test_device(), unit_box(3), none, view[0].seeds, options));
  losing.own = 2;
  CHECK_THROWS_WITH(compute_distributed(losing, test_device(), unit_box(3), view[0].ids, view[0].seeds),
                    "a communicator says that it is rank 2 of 2");
}

TEST_CASE("ranks: messages that are cut off or too long") {
  const std::vector<double> numbers{1, 2, 3};
  const std::vector<std::uint8_t> bytes{7};
  const Bytes message = packed(numbers, bytes);
  std::vector<double> first;
  std::vector<std::uint8_t> second;
  unpack(message, first, second);
  CHECK(first == numbers);
  CHECK(second == bytes);
  for (std::size_t size = 0; size < message.size(); ++size)
    CHECK_THROWS_AS(unpack(std::span(message).first(size), first, second), Error);
  CHECK_THROWS_AS(unpack(message, first), Error);
}
