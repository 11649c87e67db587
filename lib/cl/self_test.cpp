#include "lib/cl/self_test.hpp"

#include "lib/cl/accuracy.hpp"
#include "lib/cl/host_arithmetic.hpp"
#include "lib/cl/program.hpp"
#include "lib/cl/self_test_results.hpp"
#include "lib/report/log.hpp"

namespace powercell::cl {
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
