/// \file
/// A tiny diagram with a known answer, computed with each clip program before its first use, so that a
/// driver that miscompiles it is refused and not believed.
#pragma once

#include "lib/clip/candidates.hpp"
#include "lib/clip/variant.hpp"

namespace powercell {

/// Clips two layers of seeds along each axis, whose cells are boxes known in closed form, with the
/// program of `variant` (rung `rung` of the ladder).
/// \throw Error self_test_failed naming the device, the variant and the wrong figure
void golden_test(const std::shared_ptr<cl::Context>& context, const Candidates& candidates, const Variant& variant,
                 std::size_t rung);

}  // namespace powercell
