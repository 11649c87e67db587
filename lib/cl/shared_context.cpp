#include "lib/cl/shared_context.hpp"

#include <map>
#include <utility>

#include "lib/cl/context.hpp"
#include "lib/cl/program.hpp"

namespace powercell::cl {
namespace {

/// Those that are there. A context and a device name one; of our own the device alone, with a null context.
struct Registry {
  std::mutex mutex;
  std::map<std::pair<cl_context, cl_device_id>, std::weak_ptr<SharedContext>> known;
};

Registry& registry() {
  static Registry& of_process = *new Registry;  // used by destructors of other static objects
  return of_process;
}

}  // namespace

std::shared_ptr<SharedContext> SharedContext::make(cl_platform_id platform, cl_device_id device) {
  const cl_context_properties properties[] = {CL_CONTEXT_PLATFORM,
                                              reinterpret_cast<cl_context_properties>(platform), 0};
  cl_int status = CL_SUCCESS;
  const cl_context context = clCreateContext(properties, 1, &device, nullptr, nullptr, &status);
  check(status, "creating a context");
  auto made = std::make_shared<SharedContext>(context, device);
  const std::scoped_lock lock(registry().mutex);
  registry().known[{nullptr, device}] = made;
  return made;
}

std::shared_ptr<SharedContext> SharedContext::of_device(cl_device_id device) {
  const std::scoped_lock lock(registry().mutex);
  return registry().known[{nullptr, device}].lock();
}

std::shared_ptr<SharedContext> SharedContext::of_caller(cl_context context, cl_device_id device) {
  const std::scoped_lock lock(registry().mutex);
  auto& all = registry().known;
  std::erase_if(all, [](const auto& entry) { return entry.second.expired(); });  // hosts may make many
  std::weak_ptr<SharedContext>& known = all[{context, device}];
  if (auto found = known.lock()) return found;
  check(clRetainContext(context), "retaining the caller's context");
  auto made = std::make_shared<SharedContext>(context, device);
  known = made;
  return made;
}

SharedContext::~SharedContext() {
  programs_.clear();
  clReleaseContext(context_);
}

bool SharedContext::is_first_launch(cl_program program, const std::string& kernel, std::size_t local) {
  const std::scoped_lock lock(recording_);
  return launched_.emplace(program, kernel, local).second;
}

}  // namespace powercell::cl
