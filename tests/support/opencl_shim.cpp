// The requests and queries of tests.
#include "tests/support/opencl_layer.hpp"

namespace powercell::test::shim {

Calls calls() {
  const std::lock_guard lock(layer().mutex);
  return layer().calls;
}

void reset_calls() {
  const std::lock_guard lock(layer().mutex);
  layer().calls = {};
  layer().device_calls = 0;
  layer().peak_bytes = layer().total_bytes;
}

std::uint64_t device_calls() {
  const std::lock_guard lock(layer().mutex);
  return layer().device_calls;
}

Alive alive() {
  const std::lock_guard lock(layer().mutex);
  const auto count = [](Kind kind) {
    int sum = 0;
    for (const auto& [object, references] : layer().held[kind]) sum += references;
    return sum;
  };
  return {count(context), count(queue), count(buffer), count(program),
          count(kernel),  count(event), count(map)};
}

std::string to_string(const Alive& a) {
  std::string text;
  const auto add = [&](const char* what, int count) { text += std::to_string(count) + " " + what + " "; };
  add("contexts", a.contexts), add("queues", a.queues), add("buffers", a.buffers),
      add("programs", a.programs);
  add("kernels", a.kernels), add("events", a.events), add("maps", a.maps);
  return text;
}

std::size_t peak_buffer_bytes() {
  const std::lock_guard lock(layer().mutex);
  return layer().peak_bytes;
}

int wrong_releases() {
  const std::lock_guard lock(layer().mutex);
  return layer().wrong_releases;
}

void fail(Entry entry, std::uint64_t nth, cl_int code) {
  Layer& l = layer();
  const std::lock_guard lock(l.mutex);
  l.failing = entry;
  l.fail_in = nth;
  l.code = code;
  l.fired = false;
}

void lose_device(std::uint64_t nth, cl_int code) {
  Layer& l = layer();
  const std::lock_guard lock(l.mutex);
  l.lose_in = nth;
  l.code = code;
  l.lost = l.fired = false;
}

bool fired() {
  const std::lock_guard lock(layer().mutex);
  return layer().fired;
}

void limit_memory(std::size_t bytes) {
  const std::lock_guard lock(layer().mutex);
  layer().memory_limit = bytes;
}

void pretend(cl_device_info property, std::uint64_t value) {
  const std::lock_guard lock(layer().mutex);
  layer().pretended[property] = value;
}

void force_group_size(std::size_t items) {
  const std::lock_guard lock(layer().mutex);
  layer().group_size = items;
}

void behave() {
  Layer& l = layer();
  const std::lock_guard lock(l.mutex);
  l.failing = Entry::count;
  l.fail_in = l.lose_in = 0;
  l.lost = false;
  l.memory_limit = std::numeric_limits<std::size_t>::max();
  l.group_size = 0;
  l.pretended.clear();
}

}  // namespace powercell::test::shim
