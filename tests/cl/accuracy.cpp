#include "lib/cl/accuracy.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "lib/cl/self_test.hpp"
#include "tests/cl/support.hpp"

using namespace powercell;

namespace {

template <class T>
struct Results {
  T a, b, quotient, root, reciprocal;
};

/// The accuracy of a right device, changed by `fault` for each item.
template <class T, class Fault>
cl::Accuracy accuracy_with(Fault fault) {
  const auto operands = cl::accuracy_operands<T>();
  std::vector<T> results(cl::arithmetic_results * cl::accuracy_items);
  for (std::size_t i = 0; i < cl::accuracy_items; ++i) {
    const T a = operands[3 * i], b = operands[3 * i + 1];
    Results<T> r{a, b, a / b, std::sqrt(b), 1 / b};
    fault(r);
    T* out = &results[cl::arithmetic_results * i];
    out[2] = r.quotient;
    out[3] = r.root;
    out[6] = r.reciprocal;
  }
  return cl::measure_accuracy<T>(operands, results);
}

template <class T, class Fault>
std::string fault_with(Fault fault) {
  return cl::accuracy_fault(accuracy_with<T>(fault), sizeof(T) == 8);
}

/// `steps` numbers farther from 0.
template <class T>
T moved(T number, int steps) {
  for (; steps > 0; --steps)
    number = std::nextafter(number, std::copysign(std::numeric_limits<T>::infinity(), number));
  return number;
}

}  // namespace

TEST_CASE_TEMPLATE("correct rounding is off by half a unit in the last place, and hard values show all of it",
                   T, float, double) {
  const cl::Accuracy right = accuracy_with<T>([](Results<T>&) {});
  for (const double units : {right.quotient.units, right.reciprocal.units, right.root.units})
    CHECK(units <= 0.5);
  CHECK(right.quotient.units > 0.4999);
  CHECK(right.root.units > 0.4999);
  CHECK_FALSE(right.flushes);
  CHECK(cl::accuracy_fault(right, sizeof(T) == 8) == "");
}

TEST_CASE_TEMPLATE("results as inexact as OpenCL permits in single precision pass, and no worse ones", T,
                   float, double) {
  CHECK(fault_with<T>([](Results<T>& r) { r.quotient = moved(r.quotient, 2); }) == "");
  CHECK(contains(fault_with<T>([](Results<T>& r) { r.quotient = moved(r.quotient, 3); }), "a / b"));
  CHECK(fault_with<T>([](Results<T>& r) { r.reciprocal = moved(r.reciprocal, 2); }) == "");
  CHECK(contains(fault_with<T>([](Results<T>& r) { r.reciprocal = moved(r.reciprocal, 3); }), "1 / b"));
  CHECK(fault_with<T>([](Results<T>& r) { r.root = moved(r.root, 2); }) == "");
  CHECK(contains(fault_with<T>([](Results<T>& r) { r.root = moved(r.root, 4); }), "sqrt(b)"));
  CHECK(contains(fault_with<T>([](Results<T>& r) { r.root = moved(r.root, 4); }),
                 "the proofs of cells allow 3"));
}

TEST_CASE_TEMPLATE("one wrong result among many is found out", T, float, double) {
  for (const T wrong : {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity(), T(0)}) {
    int item = 0;
    CHECK(
        contains(fault_with<T>([&](Results<T>& r) { r.root = item++ == 777 ? wrong : r.root; }), "sqrt(b)"));
  }
}

TEST_CASE_TEMPLATE("flushing subnormal results is seen, and allowed", T, float, double) {
  const auto flushed = accuracy_with<T>([](Results<T>& r) {
    if (std::abs(r.quotient) < std::numeric_limits<T>::min()) r.quotient = 0;
  });
  CHECK(flushed.flushes);
  CHECK(contains(cl::describe(flushed, sizeof(T) == 8), "flushed to 0"));
  CHECK(cl::accuracy_fault(flushed, sizeof(T) == 8) == "");
}

TEST_CASE("double precision that is emulated by floats is found out") {
  const auto by_floats = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  const std::string divides = fault_with<double>([&](Results<double>& r) {
    if (std::abs(std::log2(std::abs(r.quotient))) < 100) r.quotient = by_floats(r.quotient);
  });
  CHECK(contains(divides, "a / b in double"));
  CHECK(contains(divides, "little more than single precision"));
  // A root of a float's accuracy after one step of Newton's: right to some 10^-14.
  const std::string steps = fault_with<double>([](Results<double>& r) { r.root *= 1 + 1e-14; });
  CHECK(contains(steps, "sqrt(b) in double"));
  CHECK(contains(steps, "may be emulated"));
  const std::string range = fault_with<double>([](Results<double>& r) {
    for (double* x : {&r.quotient, &r.root, &r.reciprocal})
      if (std::abs(*x) < std::numeric_limits<float>::min()) *x = 0;
  });
  CHECK(contains(range, "no numbers beyond the range of single precision"));
}
