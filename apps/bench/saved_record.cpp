#include "apps/bench/saved_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "apps/common.hpp"
#include "apps/io/read/file.hpp"

namespace powercell::app {
namespace {

using nlohmann::json;

double rate_of(const json& row, const char* results) {
  const double rate = row.at(results).at("cells_per_second").get<double>();
  if (!(rate > 0) || !std::isfinite(rate))
    throw std::invalid_argument(fmt::format("'cells_per_second' of '{}' is not above 0", results));
  return rate;
}

double scatter_of(const json& row, const char* results) {
  const double scatter = row.at(results).value("scatter", 0.0);  // missing in older files
  if (!(scatter >= 0) || !std::isfinite(scatter))
    throw std::invalid_argument(fmt::format("'scatter' of '{}' is not 0 or above", results));
  return scatter;
}

std::size_t seeds_of(const json& row) {
  const json& n = row.at("n");
  if (!n.is_number_unsigned() || n.get<std::uint64_t>() == 0)
    throw std::invalid_argument("'n' is not a whole number above 0");
  return n.get<std::size_t>();
}

[[noreturn]] void refuse(const std::string& path, const std::string& fault) {
  io::fail_file(path, fault + "; --compare takes a file that 'powercell bench --json FILE' writes");
}

// The library's message without its prefix of name and number.
std::string reason(const json::exception& error) {
  const std::string text = error.what();
  const std::size_t end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

}  // namespace

std::string SavedRow::title() const {
  return fmt::format("{} in {} with {} seeds on {}", domain, precision, with_commas(n), device);
}

const SavedRow* SavedRecord::find(const std::string& device, const std::string& selector,
                                  const std::string& domain, const std::string& precision,
                                  std::size_t n) const {
  const SavedRow* found = nullptr;
  for (const SavedRow& row : rows) {
    if (row.device != device || row.domain != domain || row.precision != precision) continue;
    if (n != 0 && row.n != n) continue;
    if (!found || (found->selector != selector && row.selector == selector)) found = &row;
  }
  return found;
}

std::vector<std::size_t> SavedRecord::sizes(const std::string& device, const std::string& selector,
                                            const std::string& domain, const std::string& precision) const {
  std::set<std::size_t> found;
  for (const SavedRow& row : rows)
    if (row.domain == domain && find(device, selector, domain, precision, row.n)) found.insert(row.n);
  return {found.begin(), found.end()};
}

SavedRecord SavedRecord::of_device(const std::string& selector) const {
  SavedRecord part = *this;
  std::erase_if(part.rows, [&](const SavedRow& row) { return row.selector != selector; });
  return part;
}

SavedRecord saved(const BenchRecord& record, const std::string& path) {
  SavedRecord result{path,
                     version(),
                     record.revision,
                     record.date,
                     record.description,
                     {},
                     record.host.processors,
                     record.others.value_or(0)};
  for (const BenchRow& row : record.rows)
    if (row.failure.empty())
      result.rows.push_back({row.device, row.selector, row.domain, row.precision, row.n, row.rate(),
                             row.adjacency_rate(), row.measures.scatter(), row.adjacency.scatter()});
  return result;
}

SavedRecord parse_record(std::string_view bytes, const std::string& name) {
  SavedRecord record;
  record.path = name;
  std::string reading = "the file";
  try {
    const json whole = json::parse(bytes);
    if (!whole.is_object() || whole.value("format", json()) != bench_format)
      refuse(name, fmt::format("is JSON, but its 'format' is not '{}'", bench_format));
    if (const json& found = whole.at("format_version"); found != bench_format_version)
      refuse(name, fmt::format("is of format version {}, this powercell reads {}", found.dump(),
                               bench_format_version));
    record.version = whole.at("version").get<std::string>();
    if (!whole.at("revision").is_null()) record.revision = whole.at("revision").get<std::string>();
    record.date = whole.at("date").get<std::string>();
    record.description = whole.value("description", std::string());  // missing in older files
    if (const json host = whole.value("host", json::object()); host.contains("processors"))
      record.processors = host.at("processors").get<unsigned>();
    if (const json others = whole.value("used_by_others", json()); !others.is_null())
      record.others = others.get<double>();
    std::size_t number = 0;
    for (const json& row : whole.at("rows")) {
      reading = fmt::format("row {}", number++);
      if (!row.at("passed").get<bool>()) continue;
      record.rows.push_back({row.at("device").get<std::string>(), row.at("selector").get<std::string>(),
                             row.at("domain").get<std::string>(), row.at("precision").get<std::string>(),
                             seeds_of(row), rate_of(row, "measures"), rate_of(row, "adjacency"),
                             scatter_of(row, "measures"), scatter_of(row, "adjacency")});
    }
  } catch (const json::parse_error& error) {
    refuse(name, fmt::format("is not JSON at byte {}", error.byte));
  } catch (const json::exception& error) {
    refuse(name, fmt::format("{}: {}", reading, reason(error)));
  } catch (const std::invalid_argument& error) {
    refuse(name, fmt::format("{}: {}", reading, error.what()));
  }
  return record;
}

SavedRecord read_record(const std::string& path) {
  return parse_record(io::read_file(path), path);
}

}  // namespace powercell::app
