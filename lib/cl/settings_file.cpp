#include "lib/cl/settings_file.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <powercell/version.hpp>
#include <system_error>
#include <utility>

#include "lib/base/float_environment.hpp"
#include "lib/base/text.hpp"
#include "lib/cl/disk_cache.hpp"
#include "lib/cl/quirks.hpp"
#include "lib/report/log.hpp"

namespace powercell {
namespace cl {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view first_line = "powercell device settings 1";
constexpr std::size_t most_bytes = 4096;  // of a file

struct Line {
  std::string_view key;
  std::string value;
};

/// What the file is for: any other value is of something else.
std::array<Line, 6> identity(const DeviceInfo& device) {
  constexpr std::size_t most = 200;
  return {{{"platform", readable(device.platform_name, most)},
           {"vendor", readable(device.vendor, most)},
           {"device", readable(device.name, most)},
           {"type", name(device.type)},
           {"driver", readable(device.driver_version, most)},
           {"library", POWERCELL_VERSION}}};
}

constexpr std::uint64_t least_pairs = 1024;

/// A number of the file, in its range.
struct Number {
  const char* key;
  std::uint64_t (*get)(const DeviceSettings&);
  void (*set)(DeviceSettings&, std::uint64_t);
  bool (*is_right)(std::uint64_t);
};

bool is_group(std::uint64_t n) {
  return n <= 1024 && std::has_single_bit(n);
}
bool is_lanes(std::uint64_t n) {
  return n == 1 || n == 4 || n == 8;
}

/// The numbers, in the order of the file.
constexpr Number numbers[] = {
    {"group_size", [](const DeviceSettings& s) -> std::uint64_t { return s.group_size; },
     [](DeviceSettings& s, std::uint64_t n) { s.group_size = n; }, is_group},
    {"polygon_lanes", [](const DeviceSettings& s) { return static_cast<std::uint64_t>(s.polygon_lanes); },
     [](DeviceSettings& s, std::uint64_t n) { s.polygon_lanes = static_cast<int>(n); }, is_lanes},
    {"polyhedron_lanes",
     [](const DeviceSettings& s) { return static_cast<std::uint64_t>(s.polyhedron_lanes); },
     [](DeviceSettings& s, std::uint64_t n) { s.polyhedron_lanes = static_cast<int>(n); }, is_lanes},
    {"chunk_pairs", [](const DeviceSettings& s) { return s.chunk_pairs; },
     [](DeviceSettings& s, std::uint64_t n) { s.chunk_pairs = n; },
     [](std::uint64_t n) { return n >= least_pairs && n <= std::uint64_t{1} << 22; }},
    {"launch_pairs", [](const DeviceSettings& s) { return s.launch_pairs; },
     [](DeviceSettings& s, std::uint64_t n) { s.launch_pairs = n; },
     [](std::uint64_t n) { return n >= least_pairs && n <= std::uint64_t{1} << 26; }},
};

/// Takes lines from the front of a text.
class Lines {
 public:
  explicit Lines(std::string_view text) : left_(text) {}
  /// The next one, without its newline; the last need not have one. Empty at the end.
  std::string_view next() {
    const std::string_view line = left_.substr(0, left_.find('\n'));
    left_.remove_prefix(std::min(left_.size(), line.size() + 1));
    return line;
  }
  /// The value of the next line if its key is `key`.
  std::optional<std::string_view> value(std::string_view key) {
    const std::string_view line = next();
    if (!line.starts_with(key) || line.size() <= key.size() || line[key.size()] != ' ') return std::nullopt;
    return line.substr(key.size() + 1);
  }
  bool at_end() const { return left_.empty(); }

 private:
  std::string_view left_;
};

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::string malformed(std::string_view key) {
  return "it is malformed where '" + std::string(key) + "' is expected";
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(most_bytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount())));
  return text;
}

/// Empty if the settings can be used on the device.
std::string settings_fault(const DeviceInfo& device, const DeviceSettings& settings) {
  for (const Number& number : numbers)
    if (const std::uint64_t value = number.get(settings); !number.is_right(value))
      return std::string(number.key) + " is out of range: " + std::to_string(value);
  if (settings.group_size > device.max_work_group_size)
    return "group_size is " + std::to_string(settings.group_size) + ", the device permits " +
           std::to_string(device.max_work_group_size);
  return {};
}

}  // namespace

void require_usable(const DeviceInfo& device, const DeviceSettings& settings) {
  if (const std::string fault = settings_fault(device, settings); !fault.empty())
    throw Error(ErrorCode::invalid_argument, "settings of the device " + device.name + ": " + fault);
}

std::string settings_text(const DeviceInfo& device, const DeviceSettings& settings) {
  std::string text = std::string(first_line) + '\n';
  const auto add = [&](std::string_view key, const std::string& value) {
    text.append(key).append(" ").append(value).append("\n");
  };
  for (const auto& [key, value] : identity(device)) add(key, value);
  for (const Number& number : numbers) add(number.key, std::to_string(number.get(settings)));
  return text + "end\n";
}

ReadSettings parse_settings(const DeviceInfo& device, std::string_view text) {
  if (text.size() > most_bytes) return {{}, "it is longer than any that powercell writes"};
  Lines lines(text);
  if (lines.next() != first_line) return {{}, malformed(first_line)};
  for (const auto& [key, expected] : identity(device)) {
    const auto value = lines.value(key);
    if (!value) return {{}, malformed(key)};
    if (*value != expected)
      return {{},
              "its " + std::string(key) + " is '" + readable(std::string(*value), 200) + "', not '" +
                  expected + "'"};
  }
  DeviceSettings settings;
  for (const Number& number : numbers) {
    const auto value = lines.value(number.key);
    const auto parsed = value ? whole_number(*value) : std::nullopt;
    if (!parsed) return {{}, malformed(number.key)};
    // Checked before it is narrowed.
    if (!number.is_right(*parsed))
      return {{}, std::string(number.key) + " is out of range: " + std::to_string(*parsed)};
    number.set(settings, *parsed);
  }
  if (lines.next() != "end" || !lines.at_end()) return {{}, malformed("end")};
  if (std::string fault = settings_fault(device, settings); !fault.empty()) return {{}, std::move(fault)};
  return {settings, {}};
}

DeviceSettings measured_settings(const DeviceInfo& device) {
  const fs::path path = settings_file(device);
  std::error_code error;
  if (path.empty() || !fs::exists(path, error)) return default_settings(device);
  const auto [settings, fault] = parse_settings(device, text_of(path));
  write_log(LogLevel::info, [&, &what = fault] {
    return "settings of " + device.name + (what.empty() ? " from " : " are not taken from ") + path.string() +
           (what.empty() ? "" : ": " + what + "; 'powercell tune' measures them again");
  });
  return settings.value_or(default_settings(device));
}

}  // namespace cl

DeviceSettings default_settings(const DeviceInfo& device) {
  return cl::quirks_of(device).settings;
}

std::string settings_file(const DeviceInfo& device) {
  const auto folder = cl::DiskCache::default_folder();
  if (folder.empty()) return {};
  const std::string_view parts[] = {device.platform_name, device.vendor, device.name, name(device.type)};
  return (folder / ("settings-" + cl::CacheKey::of(parts).hex() + ".txt")).string();
}

void save_settings(const DeviceInfo& device, const DeviceSettings& settings) {
  const FloatEnvironment environment;
  cl::require_usable(device, settings);
  const std::string path = settings_file(device);
  if (path.empty())
    throw Error(ErrorCode::write_failed,
                "there is no folder for the settings of devices; set POWERCELL_CACHE_DIR or HOME");
  if (!cl::write_whole(path, {cl::settings_text(device, settings)}))
    throw Error(ErrorCode::write_failed, path + ": cannot be written");
}

bool remove_settings(const DeviceInfo& device) {
  const std::string path = settings_file(device);
  std::error_code error;
  const bool removed = !path.empty() && std::filesystem::remove(path, error);
  if (error) throw Error(ErrorCode::write_failed, path + ": cannot be removed (" + error.message() + ")");
  return removed;
}

}  // namespace powercell
