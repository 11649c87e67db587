#include "lib/cl/self_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "lib/cl/program.hpp"

namespace powercell::cl {
namespace {

constexpr std::uint32_t items = 67;  // more than a group, and not a multiple of one

[[noreturn]] void fail(const Context& context, const std::string& what) {
  const DeviceInfo& info = context.info();
  throw Error(ErrorCode::self_test_failed,
              "the device " + info.name + " (" + info.platform_name + ", driver " + info.driver_version +
                  ") computes wrongly: " + what +
                  "; update its driver or choose another device (POWERCELL_DEVICE or --device)");
}

/// A fixed sequence of 32-bit numbers (splitmix64).
class Sequence {
 public:
  std::uint32_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<std::uint32_t>((z ^ (z >> 31)) >> 32);
  }
  /// In [1, 2), all mantissa bits of T in use.
  template <class T>
  T fraction() {
    const std::uint64_t bits = std::uint64_t{next()} << 32 | next();
    const T eps = std::numeric_limits<T>::epsilon();
    return 1 + eps * static_cast<T>(bits >> (64 - (std::numeric_limits<T>::digits - 1)));
  }

 private:
  std::uint64_t state_ = 1;
};

template <class T>
std::vector<T> make_operands() {
  Sequence sequence;
  std::vector<T> operands(3 * items);
  for (std::uint32_t i = 0; i < items; ++i) {
    const T a = sequence.fraction<T>() * (i % 2 ? 1 : -1), b = sequence.fraction<T>();
    operands[3 * i] = a;
    operands[3 * i + 1] = b;
    // Minus the rounded product: rounding twice gives 0, once gives the rounding error of the product.
    operands[3 * i + 2] = i % 3 ? -(a * b) : sequence.fraction<T>();
  }
  return operands;
}

template <class T>
void check_arithmetic(const std::shared_ptr<Context>& context) {
  constexpr bool is_double = sizeof(T) == 8;
  // OpenCL 1.2, 7.4: division and square root are correctly rounded in double, but in float they may be
  // off by 2.5 and 3 units in the last place.
  const T slack_divide = is_double ? T(0) : T(2.5), slack_root = is_double ? T(0) : T(3);
  const auto operands = make_operands<T>();
  Buffer<T> in(context), out(context);
  in.upload(operands);
  out.resize(6 * items);
  const auto program =
      context->program("base/self_test.cl", {is_double ? "SELF_TEST_DOUBLE=1" : "SELF_TEST_DOUBLE=0"});
  Kernel kernel(context, program, "arithmetic");
  kernel.args(in, out, cl_uint{items}).launch(items);
  const auto results = out.download();

  for (std::uint32_t i = 0; i < items; ++i) {
    const T a = operands[3 * i], b = operands[3 * i + 1], c = operands[3 * i + 2];
    const T product = a * b;
    const T* r = &results[6 * i];
    auto require = [&](const char* what, T got, T expected, T slack) {
      const T unit = std::abs(expected) * std::numeric_limits<T>::epsilon();
      if (std::abs(got - expected) <= slack * unit) return;
      std::ostringstream text;
      text.precision(std::numeric_limits<T>::max_digits10);
      text << what << " in " << (is_double ? "double" : "float") << " for a = " << a << ", b = " << b
           << ", c = " << c << " gives " << got << ", not " << expected;
      fail(*context, text.str());
    };
    require("a*b + c, each rounded,", r[0], product + c, 0);
    require("fma(a, b, c)", r[1], std::fma(a, b, c), 0);
    require("a / b", r[2], a / b, slack_divide);
    require("sqrt(b)", r[3], std::sqrt(b), slack_root);
    require("arithmetic with infinity and NaN (-1 means right)", r[4], -1, 0);
    require("a*b - b*a", r[5], 0, 0);
  }
}

/// The kernel `control` on the host, one item.
void expect_control(const std::uint32_t* keys, std::uint32_t* out, std::uint32_t& odd) {
  std::copy(keys, keys + 8, out);
  std::sort(out, out + 8);
  std::uint32_t steps = 0;
  for (std::uint64_t n = std::uint64_t{keys[0]} + 1; n != 1; ++steps) n = n % 2 == 0 ? n / 2 : 3 * n + 1;
  out[8] = steps;
  odd += steps % 2;
  const std::uint64_t product = (keys[1] + 0x100000001u) * 0x9e3779b97f4a7c15u;
  out[9] = static_cast<std::uint32_t>(product >> 32) ^ static_cast<std::uint32_t>(product);
}

void check_control(const std::shared_ptr<Context>& context) {
  Sequence sequence;
  std::vector<std::uint32_t> keys(8 * items), expected(10 * items);
  for (auto& key : keys) key = sequence.next() >> (sequence.next() % 20);
  std::uint32_t expected_odd = 0;
  for (std::uint32_t i = 0; i < items; ++i) expect_control(&keys[8 * i], &expected[10 * i], expected_odd);

  Buffer<std::uint32_t> in(context), out(context), odd(context);
  in.upload(keys);
  out.resize(10 * items);
  odd.resize(1);
  odd.zero();
  Kernel kernel(context, context->program("base/self_test.cl", {"SELF_TEST_DOUBLE=0"}), "control");
  kernel.args(in, out, odd, cl_uint{items}).launch(items);

  const auto results = out.download();
  const auto wrong = std::mismatch(results.begin(), results.end(), expected.begin());
  if (wrong.first != results.end())
    fail(*context, "integer control flow gives " + std::to_string(*wrong.first) + ", not " +
                       std::to_string(*wrong.second) + ", as result " +
                       std::to_string(wrong.first - results.begin()));
  if (odd.download()[0] != expected_odd)
    fail(*context, "an atomic counter gives " + std::to_string(odd.download()[0]) + ", not " +
                       std::to_string(expected_odd));
}

}  // namespace

void self_test(const std::shared_ptr<Context>& context) {
  check_control(context);
  check_arithmetic<float>(context);
  if (context->info().fp64) check_arithmetic<double>(context);
}

}  // namespace powercell::cl
