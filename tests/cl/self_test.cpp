#include "lib/cl/self_test.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "lib/cl/enumerate.hpp"
#include "tests/cl/support.hpp"

using namespace powercell;

namespace {

/// What a right device gives, changed by `fault` for each item.
template <class T, class Fault>
std::string arithmetic_with(Fault fault) {
  const auto operands = cl::arithmetic_operands<T>();
  std::vector<T> results(cl::arithmetic_results * cl::self_test_items);
  for (std::size_t i = 0; i < cl::self_test_items; ++i) {
    const T a = operands[3 * i], b = operands[3 * i + 1], c = operands[3 * i + 2];
    T* r = &results[cl::arithmetic_results * i];
    const T product = a * b;
    r[0] = product + c;
    r[1] = std::fma(a, b, c);
    r[4] = -1;
    r[5] = 0;
    fault(r, a, b, c);
  }
  return cl::arithmetic_fault<T>(operands, results);
}

}  // namespace

TEST_CASE("every device of this machine passes the self-test") {
  const auto found = cl::find_devices().usable;
  REQUIRE_FALSE(found.empty());
  for (const auto& entry : found) {
    CAPTURE(entry.info.name);
    CHECK_NOTHROW(cl::self_test(
        std::make_shared<cl::Context>(cl::SharedContext::make(entry.platform, entry.device), entry.info)));
  }
}

TEST_CASE_TEMPLATE("arithmetic that a broken compiler would give is found out", T, float, double) {
  CHECK(arithmetic_with<T>([](T*, T, T, T) {}) == "");
  CHECK(contains(arithmetic_with<T>([](T* r, T a, T b, T c) { r[0] = std::fma(a, b, c); }), "a*b + c"));
  CHECK(contains(arithmetic_with<T>([](T* r, T a, T b, T c) {
                   const T product = a * b;
                   r[1] = product + c;
                 }),
                 "fma"));
  CHECK(
      contains(arithmetic_with<T>([](T* r, T a, T b, T) { r[5] = std::fma(a, b, -(b * a)); }), "a*b - b*a"));
  CHECK(contains(arithmetic_with<T>([](T* r, T, T, T) { r[4] = 1; }), "NaN"));
}

TEST_CASE("wrong control flow is found out") {
  const auto keys = cl::control_keys();
  const std::vector<std::uint32_t> untouched(10 * cl::self_test_items, 0);
  CHECK(contains(cl::control_fault(keys, untouched, 0), "control flow"));
}
