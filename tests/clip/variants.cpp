#include <doctest/doctest.h>

#include "lib/cl/quirks.hpp"
#include "lib/clip/golden.hpp"
#include "lib/neighbors/list_candidates.hpp"
#include "lib/neighbors/tree_candidates.hpp"
#include "lib/scene/variant.hpp"
#include "tests/clip/random_scene.hpp"
#include "tests/support/environment.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

std::size_t capacity_of(const Variant& variant) {
  const auto& all = capacities(variant.cell_dimension);
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].vertices == variant.capacity.vertices) return k;
  return all.size();
}

/// Hides all seeds but the first from the kernel, as a broken driver might.
class BlindCandidates : public TreeCandidates {
 public:
  explicit BlindCandidates(const Scene& scene)
      : TreeCandidates(scene),
        tree_{scene.buffers.points.handle(),
              scene.buffers.node_low.handle(),
              scene.buffers.node_high.handle(),
              scene.buffers.level_offset.handle(),
              1,
              1,
              1},
        blocks_(scene.context(), without_cells(scene), scene.buffers.blocks) {
    blocks_.enqueue(tree_);
  }
  void append_arguments(cl::Kernel& kernel) const override { blocks_.append_arguments(kernel, tree_); }
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override {
    return std::make_unique<BlindCandidates>(scene);
  }

 private:
  TreeBlocks::Tree tree_;
  TreeBlocks blocks_;
};

}  // namespace

TEST_CASE("every variant compiles and computes the golden diagram") {
  const auto context = test_context();
  const RandomScene scene(context, 3, 50, 0.5, false);
  const TreeCandidates tree(scene.scene);
  std::vector<const Candidates*> sources{&tree};
#ifdef POWERCELL_TEST_FLANN
  const ListCandidates lists(scene.scene, Options{});
  sources.push_back(&lists);
#endif
  for (const bool float32 : {false, true}) {
    if (!float32 && !context->info().fp64) continue;
    for (const Variant& variant : all_variants(float32, cl::lane_width(context->settings(), 3))) {
      for (const Candidates* source : sources) {
        // The larger kernels clip among lists as among the candidates of a tree, and take seconds to compile.
        if (source != &tree && capacity_of(variant) > 0 && !all_inputs()) continue;
        CAPTURE(source->file());
        CAPTURE(variant.dimension);
        CAPTURE(variant.cell_dimension);
        CAPTURE(variant.capacity.vertices);
        CAPTURE(float32);
        REQUIRE_NOTHROW(golden_test(context, *source, variant, capacity_of(variant)));
      }
    }
  }
}

// The smallest capacity is left to the test of lanes in `determinism`, since each variant takes seconds to
// compile.
TEST_CASE("larger variants compute the golden diagram with lanes as on other kinds of devices" *
          doctest::skip(!all_inputs())) {
  const auto context = test_context();
  const int own = cl::lane_width(context->settings(), 3);
  for (const int width : {1, 4, 8}) {
    if (width == own) continue;
    const Environment lanes("POWERCELL_LANES", std::to_string(width));
    const RandomScene scene(context, 3, 50, 0.5, false);
    const TreeCandidates tree(scene.scene);
    for (const bool float32 : {false, true}) {
      if (!float32 && !context->info().fp64) continue;
      for (const Variant& variant : all_variants(float32, width)) {
        if (capacity_of(variant) == 0) continue;
        CAPTURE(width);
        CAPTURE(variant.dimension);
        CAPTURE(variant.cell_dimension);
        CAPTURE(variant.capacity.vertices);
        CAPTURE(float32);
        REQUIRE_NOTHROW(golden_test(context, tree, variant, capacity_of(variant)));
      }
    }
  }
}

TEST_CASE("a device that computes the golden diagram wrongly is refused, and named") {
  const auto context = test_context();
  const RandomScene scene(context, 2, 20, 0.5, true);
  Variant variant = all_variants(true, cl::lane_width(context->settings(), 3)).front();
  try {
    golden_test(context, BlindCandidates(scene.scene), variant, 0);
    FAIL("the wrong answer was believed");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::self_test_failed);
    CHECK(std::string(error.what()).find(context->info().name) != std::string::npos);
    CHECK(std::string(error.what()).find("REAL_BITS=32") != std::string::npos);
  }
}
