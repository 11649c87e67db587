#include "bench/table.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace powercell::bench {

namespace {

/// stage/domain/distribution/weights/precision/provider/n, and what the library appends after it.
struct Name {
  std::string work, way;
};

Name split(const std::string& text) {
  std::vector<std::string> part;
  std::stringstream stream(text);
  for (std::string piece; std::getline(stream, piece, '/');) part.push_back(piece);
  if (part.size() < 7) return {text, ""};
  return {part[0] + " " + part[1] + " " + part[2] + " " + part[3] + " n = " + part[6],
          part[4] + " " + part[5]};
}

bool is_peer(const std::string& way) {
  return way.find("cgal") != std::string::npos || way.find("voro") != std::string::npos;
}

}  // namespace

bool TableReporter::ReportContext(const Context& context) {
  PrintBasicContext(&GetErrorStream(), context);
  return true;
}

void TableReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    const std::string text = run.benchmark_name();
    if (run.error_occurred) {
      failed_ = true;
      std::fprintf(stderr, "%s: %s\n", text.c_str(), run.error_message.c_str());
      continue;
    }
    if (run.run_type != Run::RT_Iteration) continue;
    const Name name = split(text);
    auto row = std::find_if(rows_.begin(), rows_.end(), [&](const auto& r) { return r.first == name.work; });
    if (row == rows_.end()) row = rows_.insert(rows_.end(), {name.work, {}});
    const double seconds =
        run.real_accumulated_time / static_cast<double>(std::max<std::int64_t>(1, run.iterations));
    const auto rate = run.counters.find("cells/s");
    row->second.push_back({name.way, seconds, rate == run.counters.end() ? 0 : rate->second.value});
    std::fprintf(stderr, "%-70s %10.3f s\n", text.c_str(), seconds);
  }
}

void TableReporter::Finalize() {
  std::printf("| work | by | seconds | cells/s | speed relative to first peer |\n|---|---|---:|---:|---:|\n");
  for (const auto& [work, entries] : rows_) {
    const auto peer =
        std::find_if(entries.begin(), entries.end(), [](const Entry& e) { return is_peer(e.way); });
    for (const Entry& e : entries) {
      char ratio[32] = "";
      if (peer != entries.end()) std::snprintf(ratio, sizeof ratio, "%.2f", peer->seconds / e.seconds);
      std::printf("| %s | %s | %.3f | %.0f | %s |\n", work.c_str(), e.way.c_str(), e.seconds,
                  e.cells_per_second, ratio);
    }
  }
}

}  // namespace powercell::bench
