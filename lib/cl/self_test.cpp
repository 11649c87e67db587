#include "lib/cl/self_test.hpp"

#include "lib/cl/program.hpp"
#include "lib/cl/self_test_results.hpp"

namespace powercell::cl {
namespace {

using ContextPointer = std::shared_ptr<Context>;
using ProgramPointer = std::shared_ptr<const Program>;

void require_no_fault(const Context& context, const std::string& fault) {
  if (fault.empty()) return;
  const DeviceInfo& info = context.info();
  throw Error(ErrorCode::self_test_failed,
              "the device " + info.name + " (" + info.platform_name + ", driver " + info.driver_version +
                  ") computes wrongly: " + fault +
                  "; update its driver or choose another device (POWERCELL_DEVICE or --device)");
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
  const auto operands = arithmetic_operands<T>();
  Buffer<T> in(context), out(context);
  in.upload(operands);
  out.resize(6 * self_test_items);
  Kernel kernel(context, program, sizeof(T) == 8 ? "arithmetic_double" : "arithmetic_float");
  kernel.args(in, out, cl_uint{self_test_items}).launch(self_test_items);
  require_no_fault(*context, arithmetic_fault<T>(operands, out.download()));
}

}  // namespace

void self_test(const std::shared_ptr<Context>& context) {
  const bool fp64 = context->info().fp64;
  const auto program =
      context->program("base/self_test.cl", {fp64 ? "SELF_TEST_DOUBLE=1" : "SELF_TEST_DOUBLE=0"});
  test_control(context, program);
  test_arithmetic<float>(context, program);
  if (fp64) test_arithmetic<double>(context, program);
}

}  // namespace powercell::cl
