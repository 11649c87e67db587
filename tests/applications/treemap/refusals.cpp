// Invalid trees, values, outlines and options are refused with a message that names the place; unusual
// outlines are accepted.
#include <doctest/doctest.h>

#include <limits>
#include <string>

#include "tests/applications/treemap/made_trees.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

void check_refused(const TreeView& tree, const Ring& outline, ErrorCode code, const std::string& says,
                   const TreemapOptions& options = {}) {
  try {
    (void)treemap(tree, outline, options);
    FAIL("not refused: " << says);
  } catch (const Error& error) {
    CHECK(error.code() == code);
    INFO(std::string(error.what()));
    CHECK(std::string(error.what()).find(says) != std::string::npos);
  }
}

void check_tree(std::vector<std::int64_t> parent, std::vector<double> value, const std::string& says) {
  check_refused({parent, value}, square, ErrorCode::invalid_argument, says);
}

void check_outline(const Ring& outline, const std::string& says) {
  MadeTree tree;
  tree.add(0, 1);
  tree.add(0, 2);
  check_refused(tree.view(), outline, ErrorCode::invalid_domain, says);
}

}  // namespace

TEST_CASE("invalid trees are refused") {
  check_tree({}, {}, "no nodes");
  check_tree({-1, 0}, {1}, "2 parents and 1 values");
  check_tree({-1, 7}, {1, 1}, "node 1 has the parent 7");
  check_tree({-1, -2}, {1, 1}, "node 1 has the parent -2");
  check_tree({-1, 0, -1}, {1, 1, 1}, "node 0 and node 2 both have no parent");
  check_tree({1, 0}, {1, 1}, "no root");
  check_tree({-1, 0, 3, 4, 2, 4}, {1, 1, 1, 1, 1, 1}, "a cycle");
  check_tree({-1, 1}, {1, 1}, "node 1 is among its own ancestors");
}

TEST_CASE("invalid values are refused") {
  check_tree({-1, 0}, {0, std::nan("")}, "value of node 1 is not finite");
  check_tree({-1, 0}, {0, std::numeric_limits<double>::infinity()}, "value of node 1 is not finite");
  check_tree({-1, 0, 0}, {0, 0, -1}, "nothing to lay out");
  check_tree({-1, 0, 0}, {0, 1e308, 1e308}, "sum to more than a double holds");
  check_tree({-1, 0, 0}, {0, 1, 1e-20}, "node 2");
}

TEST_CASE("outlines that are not convex polygons are refused") {
  check_outline({{0, 0}, {1, 0}}, "fewer than three corners");
  check_outline({{0, 0}, {1, 1}, {2, 2}}, "no");
  check_outline({{0, 0}, {2, 0}, {2, 2}, {1, 0.5}, {0, 2}}, "not convex at (1, 0.5)");
  check_outline({{0, 0}, {1, 0}, {1, 1}, {0, std::nan("")}}, "not finite");
  check_outline({{0, 1}, {0.588, -0.809}, {-0.951, 0.309}, {0.951, 0.309}, {-0.588, -0.809}},
                "crosses itself");
}

TEST_CASE("outlines whose area is lost in rounding, or whose moments overflow, are refused") {
  check_outline({{0, 0}, {1e12, 0}, {1e12, 1e-3}, {0, 1e-3}}, "rounding its corners");
  check_outline({{1e12, 0}, {1e12 + 1, 0}, {1e12 + 1, 1}, {1e12, 1}}, "rounding its corners");
  check_outline({{0, 0}, {1e70, 0}, {1e70, 1e70}}, "1e60");
  check_outline({{0, 0}, {1e-70, 0}, {1e-70, 1e-70}}, "1e-120");
  MadeTree tree;
  for (int child = 0; child < 5; ++child) tree.add(0, 1 + child);
  for (const double scale : {1e-50, 1e50}) {
    const Treemap map = treemap(tree.view(), {{0, 0}, {1e6 * scale, 0}, {1e6 * scale, scale}, {0, scale}});
    CHECK(map.worst_error < 1e-6);
  }
}

TEST_CASE("relative_positions refuses invalid offsets") {
  const std::vector<std::int64_t> parent = {-1, 0};
  const std::vector<double> seeds(4, 0.0), vertices(6, 0.0);
  for (const std::vector<std::uint64_t>& offset :
       {std::vector<std::uint64_t>{0, 9, 3}, {0, std::uint64_t{1} << 63, 3}, {0, 3, 4}, {0, 3}})
    CHECK_THROWS_AS((void)relative_positions(parent, seeds, offset, vertices), Error);
}

TEST_CASE("outlines with repeated and collinear points, in either orientation, are accepted") {
  MadeTree tree;
  tree.add(0, 1);
  tree.add(0, 3);
  for (const Ring& outline : {Ring{{0, 0}, {0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 1}, {0, 0}},
                              Ring{{0, 2}, {2, 2}, {2, 1}, {2, 0}, {0, 0}}}) {
    const Treemap map = treemap(tree.view(), outline);
    CHECK(map.vertex_offset[1] == 4);
    CHECK(map.worst_error < 1e-9);
  }
}

TEST_CASE("options out of range are refused") {
  MadeTree tree;
  tree.add(0, 1);
  TreemapOptions options;
  options.tolerance = 0;
  check_refused(tree.view(), square, ErrorCode::invalid_argument, "tolerance", options);
  options = {};
  options.rounds = -1;
  check_refused(tree.view(), square, ErrorCode::invalid_argument, "rounds", options);
  options = {};
  const std::vector<double> start = {0.0};
  options.start = start;
  check_refused(tree.view(), square, ErrorCode::invalid_argument, "two numbers for each node", options);
}
