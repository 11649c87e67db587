#include "apps/tune/settings.hpp"

#include <algorithm>

namespace powercell::app {
namespace {

using Values = std::vector<std::uint64_t>;

Values without(std::uint64_t now, Values values) {
  std::erase(values, now);
  return values;
}

Values other_lanes(std::uint64_t now) {
  return without(now, {1, 4, 8});
}

Values other_groups(std::uint64_t now) {
  constexpr std::uint64_t most = 1024;
  Values values;
  for (const std::uint64_t size : {now / 4, now / 2, now * 2, now * 4})
    if (size >= 1 && size <= most) values.push_back(size);
  return values;
}

Values other_pairs(std::uint64_t now) {
  constexpr std::uint64_t least = 1024, most = std::uint64_t{1} << 22;
  Values values;
  for (const std::uint64_t pairs : {now / 4, now / 2, now * 2, now * 4})
    if (pairs >= least && pairs <= most) values.push_back(pairs);
  return values;
}

}  // namespace

const std::vector<Setting>& all_settings() {
  static const std::vector<Setting> all = {
      {"polygon_lanes", 2, UsedBy::both,
       [](const DeviceSettings& s) { return static_cast<std::uint64_t>(s.polygon_lanes); },
       [](DeviceSettings& s, std::uint64_t n) { s.polygon_lanes = static_cast<int>(n); }, other_lanes},
      {"polyhedron_lanes", 3, UsedBy::both,
       [](const DeviceSettings& s) { return static_cast<std::uint64_t>(s.polyhedron_lanes); },
       [](DeviceSettings& s, std::uint64_t n) { s.polyhedron_lanes = static_cast<int>(n); }, other_lanes},
      {"group_size", 0, UsedBy::both, [](const DeviceSettings& s) -> std::uint64_t { return s.group_size; },
       [](DeviceSettings& s, std::uint64_t n) { s.group_size = n; }, other_groups},
      {"chunk_pairs", 0, UsedBy::diagram, [](const DeviceSettings& s) { return s.chunk_pairs; },
       [](DeviceSettings& s, std::uint64_t n) { s.chunk_pairs = n; }, other_pairs},
      {"launch_pairs", 0, UsedBy::device_diagram, [](const DeviceSettings& s) { return s.launch_pairs; },
       [](DeviceSettings& s, std::uint64_t n) { s.launch_pairs = n; }, other_pairs},
  };
  return all;
}

std::vector<std::string> setting_names() {
  std::vector<std::string> names;
  for (const Setting& one : all_settings()) names.emplace_back(one.name);
  return names;
}

const Setting& setting(const std::string& name) {
  return *std::find_if(all_settings().begin(), all_settings().end(),
                       [&](const Setting& one) { return one.name == name; });
}

}  // namespace powercell::app
