/// \file
/// Loops on one thread and on all, for peers that exist in both variants.
#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>

namespace powercell::bench {

struct SerialLoop {
  template <class Body>
  void operator()(std::size_t count, const Body& body) const {
    for (std::size_t k = 0; k < count; ++k) body(k);
  }
};

struct ParallelLoop {
  template <class Body>
  void operator()(std::size_t count, const Body& body) const {
    tbb::parallel_for(std::size_t{0}, count, body);
  }
};

}  // namespace powercell::bench
