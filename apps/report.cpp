#include "apps/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/common.hpp"
#include "apps/io/printable.hpp"
#include "apps/progress.hpp"

namespace powercell::app {

double Stopwatch::lap() {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - last_).count();
  last_ = now;
  return seconds;
}

void print_notes(const std::vector<std::string>& notes, const std::string& file, const CommonOptions& options,
                 Progress& progress) {
  if (options.quiet) return;
  progress.aside([&] {
    for (const std::string& note : notes)
      fmt::print(stderr, "powercell: note: {}\n", io::one_line(fmt::format("{}: {}", file, note)));
  });
}

RunReport report_of(Diagram& diagram) {
  const Measures& measures = diagram.measures();
  RunReport report;
  report.seeds = diagram.size();
  report.selected = measures.mass.size();
  report.cells = measures.count(SeedStatus::ok);
  report.hidden = measures.count(SeedStatus::hidden);
  report.duplicate = measures.count(SeedStatus::duplicate);
  report.measure = measures.total();
  report.domain_measure = measures.domain_measure;
  report.relative_error = measures.relative_error();
  report.device = device_name(diagram.device());
  report.precision = precision_name(diagram.precision());
  report.neighbors = neighbors_name(diagram.neighbors());
  report.timings = diagram.timings();
  return report;
}

void describe_times(const Progress& progress, RunReport& report) {
  report.read = progress.seconds(stage::reading);
  report.open = progress.seconds(stage::opening);
  report.write = progress.seconds(stage::writing);
  report.build = progress.build();
  report.run = progress.run();
}

std::string building_note(double seconds) {
  constexpr double noticeable = 0.05;
  return seconds < noticeable ? "" : fmt::format(", {:.1f} s building kernels", seconds);
}

nlohmann::json as_json(const RunReport& report) {
  const Timings& t = report.timings;
  return {{"seeds", report.seeds},
          {"selected", report.selected},
          {"cells", report.cells},
          {"hidden", report.hidden},
          {"duplicate", report.duplicate},
          {"outside", report.outside},
          {"measure", report.measure},
          {"domain_measure", report.domain_measure},
          {"relative_error",
           report.selected < report.seeds ? nlohmann::json() : nlohmann::json(report.relative_error)},
          {"device", report.device},
          {"precision", report.precision},
          {"neighbors", report.neighbors},
          {"version", version()},
          {"seconds",
           {{"total", t.total},
            {"prepare", t.prepare},
            {"pairs", t.pairs},
            {"neighbors", t.neighbors},
            {"clip", t.clip},
            {"collect", t.collect},
            {"certify", t.certify},
            {"read", report.read},
            {"open", report.open},
            {"build", report.build},
            {"write", report.write},
            {"run", report.run}}},
          {"repeats", report.repeats},
          {"pairs", t.pair_count},
          {"retried", t.retried},
          {"uncertain", t.uncertain},
          {"on_host", t.on_host},
          {"rounds", t.rounds},
          {"crs", report.crs},
          {"projection", report.projection},
          {"notes", report.notes},
          {"files", report.files}};
}

std::string json_text(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

namespace {

std::string sum_text(const RunReport& report) {
  if (report.selected < report.seeds)
    return fmt::format("of {} selected among {} seeds; they measure {:.6g} of {:.6g}",
                       with_commas(report.selected), with_commas(report.seeds), report.measure,
                       report.domain_measure);
  const double defect = report.domain_measure > 0 ? report.measure / report.domain_measure - 1 : 0;
  return fmt::format("sum of measures / domain = 1 {} {:.1e}", defect < 0 ? '-' : '+', std::abs(defect));
}

}  // namespace

std::string self_check_line(const RunReport& report) {
  std::string line =
      fmt::format("{} cells, {} hidden, {} duplicate; {}; {}, {}, {}; {:.3f} s", with_commas(report.cells),
                  with_commas(report.hidden), with_commas(report.duplicate), sum_text(report), report.device,
                  report.precision, report.neighbors, report.timings.total);
  line += fmt::format(" (and {:.3f} s reading, {:.3f} s writing", report.read, report.write);
  line += building_note(report.build) + ")";
  if (report.repeats.size() > 1)
    line += fmt::format("; first {:.4g} s, least of the {} after it {:.4g} s", report.repeats.front(),
                        report.repeats.size() - 1,
                        *std::min_element(report.repeats.begin() + 1, report.repeats.end()));
  return line;
}

double partition_tolerance(Precision precision) {
  return precision == Precision::float32 ? 1e-3 : 1e-9;
}

void require_partition(const RunReport& report) {
  if (report.seeds == 0) return;
  const double allowed =
      partition_tolerance(report.precision == "float" ? Precision::float32 : Precision::float64);
  if (report.relative_error <= allowed) return;
  throw Error(
      ErrorCode::internal,
      fmt::format("self-check failed: the measures of the cells sum to {:.17g}, the domain's is {:.17g} "
                  "(relative error {:.1e}, allowed {:.0e}); do not use these results, and please report "
                  "the input ('powercell verify' shows more)",
                  report.measure, report.domain_measure, report.relative_error, allowed));
}

}  // namespace powercell::app
