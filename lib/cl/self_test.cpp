#include "lib/cl/self_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "lib/base/error_free.hpp"
#include "lib/cl/accuracy.hpp"
#include "lib/cl/program.hpp"
#include "lib/report/log.hpp"

namespace powercell::cl {

namespace {

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
    const std::uint64_t high = next(), bits = high << 32 | next();
    const T eps = std::numeric_limits<T>::epsilon();
    return 1 + eps * static_cast<T>(bits >> (64 - (std::numeric_limits<T>::digits - 1)));
  }

 private:
  std::uint64_t state_ = 1;
};

template <class T>
struct Expected {
  std::uint32_t at;
  const char* what;
  T value;
};

/// One item of `control`.
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

}  // namespace

template <class T>
std::vector<T> arithmetic_operands() {
  Sequence sequence;
  std::vector<T> operands(3 * self_test_items);
  for (std::uint32_t i = 0; i < self_test_items; ++i) {
    const T a = sequence.fraction<T>() * (i % 2 ? 1 : -1), b = sequence.fraction<T>();
    operands[3 * i] = a;
    operands[3 * i + 1] = b;
    // Minus the rounded product: rounding twice gives 0, once gives the rounding error of the product.
    operands[3 * i + 2] = i % 3 ? -(a * b) : sequence.fraction<T>();
  }
  return operands;
}

template <class T>
std::string arithmetic_fault(std::span<const T> operands, std::span<const T> results) {
  constexpr bool is_double = sizeof(T) == 8;
  for (std::uint32_t i = 0; i < self_test_items; ++i) {
    const T a = operands[3 * i], b = operands[3 * i + 1], c = operands[3 * i + 2];
    const T product = a * b;
    const Expected<T> expected[] = {{0, "a*b + c, each rounded,", product + c},
                                    {1, "fma(a, b, c)", rounded_once(a, b, c)},
                                    {4, "comparing with infinity and NaN (-1 means right)", -1},
                                    {5, "a*b - b*a", 0}};
    for (const auto& [at, what, value] : expected) {
      const T got = results[arithmetic_results * i + at];
      if (got == value) continue;
      std::ostringstream text;
      text.precision(std::numeric_limits<T>::max_digits10);
      text << what << " in " << (is_double ? "double" : "float") << " for a = " << a << ", b = " << b
           << ", c = " << c << " gives " << got << ", not " << value;
      return text.str();
    }
  }
  return {};
}

template std::vector<float> arithmetic_operands();
template std::vector<double> arithmetic_operands();
template std::string arithmetic_fault(std::span<const float>, std::span<const float>);
template std::string arithmetic_fault(std::span<const double>, std::span<const double>);

std::vector<std::uint32_t> control_keys() {
  Sequence sequence;
  std::vector<std::uint32_t> keys(8 * self_test_items);
  for (auto& key : keys) {
    key = sequence.next();
    key >>= sequence.next() % 20;  // small ones too, so that loops differ in length
  }
  return keys;
}

std::string control_fault(std::span<const std::uint32_t> keys, std::span<const std::uint32_t> results,
                          std::uint32_t odd) {
  std::vector<std::uint32_t> expected(10 * self_test_items);
  std::uint32_t expected_odd = 0;
  for (std::uint32_t i = 0; i < self_test_items; ++i)
    expect_control(&keys[8 * i], &expected[10 * i], expected_odd);
  const auto wrong = std::mismatch(results.begin(), results.end(), expected.begin());
  if (wrong.first != results.end())
    return "integer control flow gives " + std::to_string(*wrong.first) + ", not " +
           std::to_string(*wrong.second) + ", as result " + std::to_string(wrong.first - results.begin());
  if (odd != expected_odd)
    return "an atomic counter gives " + std::to_string(odd) + ", not " + std::to_string(expected_odd);
  return {};
}

namespace {

using ContextPointer = std::shared_ptr<Context>;
using ProgramPointer = std::shared_ptr<const Program>;

void require_no_fault(const Context& context, const std::string& fault, bool is_double = false) {
  if (fault.empty()) return;
  const DeviceInfo& info = context.info();
  throw Error(ErrorCode::self_test_failed,
              "the device " + info.name + " (" + info.platform_name + ", driver " + info.driver_version +
                  ") computes wrongly: " + fault +
                  "; update its driver or choose another device (POWERCELL_DEVICE or --device)" +
                  (is_double ? ", or use its single precision alone (POWERCELL_FP64=never)" : ""));
}

/// Whether the driver says that it emulates double precision: right, but slow.
bool is_software(const Context& context) {
  cl_device_fp_config config = 0;
  check(clGetDeviceInfo(context.device(), CL_DEVICE_DOUBLE_FP_CONFIG, sizeof config, &config, nullptr),
        "asking a device for its double precision");
  return (config & CL_FP_SOFT_FLOAT) != 0;
}

void test_control(const ContextPointer& context, const ProgramPointer& program) {
  const auto keys = control_keys();
  Buffer<std::uint32_t> in(context), out(context), odd(context);
  in.upload(keys);
  out.resize(10 * self_test_items);
  odd.resize(1);
  odd.zero();
  Kernel kernel(context, program, "control");
  kernel.args(in, out, odd, cl_uint{self_test_items}).launch(self_test_items);
  require_no_fault(*context, control_fault(keys, out.download(), odd.download()[0]));
}

template <class T>
void test_arithmetic(const ContextPointer& context, const ProgramPointer& program) {
  constexpr bool is_double = sizeof(T) == 8;
  const auto compute = [&](const std::vector<T>& operands) {
    Buffer<T> in(context), out(context);
    const std::size_t items = operands.size() / 3;
    in.upload(operands);
    out.resize(arithmetic_results * items);
    Kernel kernel(context, program, is_double ? "arithmetic_double" : "arithmetic_float");
    kernel.args(in, out, static_cast<cl_uint>(items)).launch(items);
    return out.download();
  };
  const auto operands = arithmetic_operands<T>(), divided = accuracy_operands<T>();
  require_no_fault(*context, arithmetic_fault<T>(operands, compute(operands)), is_double);
  const Accuracy accuracy = measure_accuracy<T>(divided, compute(divided));
  const bool emulated = is_double && is_software(*context);
  write_log(emulated ? LogLevel::info : LogLevel::detail, [&] {
    return "self-test in " + describe(accuracy, is_double) + (emulated ? ", emulated in software" : "");
  });
  require_no_fault(*context, accuracy_fault(accuracy, is_double), is_double);
}

}  // namespace

void self_test(const std::shared_ptr<Context>& context) {
  if (const std::string fault = host_arithmetic_fault(); !fault.empty())
    throw Error(ErrorCode::self_test_failed,
                "this build of powercell computes wrongly on the host: " + fault +
                    "; compile it without -ffast-math and with its own CMake project");
  const bool fp64 = context->info().fp64;
  const auto program =
      context->program("base/self_test.cl", {fp64 ? "SELF_TEST_DOUBLE=1" : "SELF_TEST_DOUBLE=0"});
  test_control(context, program);
  test_arithmetic<float>(context, program);
  if (fp64) test_arithmetic<double>(context, program);
}

}  // namespace powercell::cl
