/// \file
/// The library's results as structs of C that point into them.
#pragma once

#include <powercell/c/results.h>

#include <powercell/results.hpp>
#include <vector>

#include "lib/c_api/calls.hpp"

namespace powercell::c_api {

/// A result that the caller destroys: a struct of C, and beside it what it points into.
template <class View, class Owned>
struct Result : View {
  explicit Result(Owned result) : View{}, owned(std::move(result)) {}
  Owned owned;
};

/// Hands a result over to the caller. `fill` makes the struct point into it, at the place where it stays.
template <class View, class Owned, class Fill>
void hand_over_result(const View** out, Owned owned, const Fill& fill) {
  auto result = std::make_unique<Result<View, Owned>>(std::move(owned));
  fill(static_cast<View&>(*result), result->owned);
  result_at(out) = result.release();
}

template <class Owned, class View>
void destroy_result(const View* view) {
  delete static_cast<const Result<View, Owned>*>(view);
}

/// NULL if there are no values.
template <class T>
const T* pointer(const std::vector<T>& values) {
  return values.empty() ? nullptr : values.data();
}
inline const std::int32_t* pointer(const std::vector<std::array<std::int32_t, 3>>& shifts) {
  return shifts.empty() ? nullptr : shifts.front().data();
}
POWERCELL_API const pc_border* pointer(const std::vector<Border>& borders);
POWERCELL_API const std::uint8_t* pointer(const std::vector<SeedStatus>& status);

/// Copies of the caller's arrays.
template <class T>
std::vector<T> vector_of(const T* values, std::size_t count) {
  const std::span<const T> all = view(values, count, "an array");
  return {all.begin(), all.end()};
}
POWERCELL_API std::vector<Border> borders_of(const pc_border* borders, std::size_t count);
POWERCELL_API std::vector<std::array<std::int32_t, 3>> shifts_of(const std::int32_t* shifts,
                                                                 std::size_t count);

/// Structs that point into the results, which must stay where they are.
POWERCELL_API pc_measures view_of(const Measures& measures);
POWERCELL_API pc_adjacency view_of(const Adjacency& adjacency);
POWERCELL_API pc_boundary_walls view_of(const BoundaryWalls& walls);
POWERCELL_API pc_cells view_of(const Cells& cells);
POWERCELL_API pc_joined_cells view_of(const JoinedCells& joined);
POWERCELL_API pc_dual view_of(const Dual& dual);
POWERCELL_API pc_timings view_of(const Timings& timings);

/// Pointers to all structs of an array, for arrays of structs that may grow.
template <class T>
std::vector<const T*> pointers(const std::vector<T>& all) {
  std::vector<const T*> result;
  result.reserve(all.size());
  for (const T& one : all) result.push_back(&one);
  return result;
}

}  // namespace powercell::c_api
