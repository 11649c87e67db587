/// \file
/// Reports of a run: the self-check line for people, a JSON object for programs.
#pragma once

#include <chrono>
#include <nlohmann/json_fwd.hpp>
#include <powercell/powercell.hpp>
#include <string>
#include <vector>

namespace powercell::app {

struct CommonOptions;

/// Seconds since construction or the last call of lap().
class Stopwatch {
 public:
  double lap();

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

class Progress;

/// ", 10.2 s building kernels" if that took noticeable time, for reports.
std::string building_note(double seconds);

/// Figures of a run.
struct RunReport {
  std::size_t seeds = 0, cells = 0, hidden = 0, duplicate = 0;
  std::size_t selected = 0;  ///< seeds whose cells were asked for
  std::size_t outside = 0;   ///< seeds outside the domain's box, also in periodic domains
  double measure = 0, domain_measure = 0, relative_error = 0;
  std::string device, precision, neighbors;
  Timings timings;              ///< of the last time
  std::vector<double> repeats;  ///< seconds in all of each time that the diagram was computed
  /// Seconds beside `timings.total`: of reading, opening the device, compiling kernels and writing, and of
  /// the whole run, which is their sum but for milliseconds.
  double read = 0, open = 0, build = 0, write = 0, run = 0;
  std::vector<std::string> files;
  std::string crs, projection;     ///< of the inputs and of the plane; empty if nothing names one
  std::vector<std::string> notes;  ///< how the inputs were read
};

/// Writes notes about a file to standard error, one a line, unless the options ask for quiet.
void print_notes(const std::vector<std::string>& notes, const std::string& file, const CommonOptions& options,
                 Progress& progress);

/// Enters the seconds of the run.
/// \pre its stages are those of `stage`, and one for computing
void describe_times(const Progress& progress, RunReport& report);

/// Everything but the seconds of reading and writing and the files. Computes the measures.
RunReport report_of(Diagram& diagram);

/// The keys that programs may rely on are written down in docs/guide.md.
nlohmann::json as_json(const RunReport& report);

/// Indented. File names may not be valid UTF-8: invalid bytes become U+FFFD.
std::string json_text(const nlohmann::json& json);

/// "4,812 cells, 188 hidden, 0 duplicate; sum of measures / domain = 1 + 2.2e-16; ..."
std::string self_check_line(const RunReport& report);

/// The allowed relative error of the sum of the measures.
double partition_tolerance(Precision precision);

/// \throw Error internal if the measures do not sum to the domain's within partition_tolerance
void require_partition(const RunReport& report);

}  // namespace powercell::app
