#include "bench/record.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <powercell/version.hpp>
#include <stdexcept>
#include <thread>

namespace powercell::bench {

Record::Record(std::string part_, const Work& work_, const Contender& contender)
    : part(std::move(part_)),
      work(work_),
      stage(contender.stage),
      precision(contender.precision),
      provider(contender.provider),
      peer(contender.peer) {}

double Record::least() const {
  return seconds.empty() ? std::numeric_limits<double>::infinity()
                         : *std::min_element(seconds.begin(), seconds.end());
}

RecordFile::RecordFile(std::string path) : path_(std::move(path)) {
  const DeviceInfo& info = device().info();
  all_["context"] = {{"device", info.name},
                     {"type", name(info.type)},
                     {"driver", info.driver_version},
                     {"powercell", version()},
                     {"revision", POWERCELL_REVISION},
                     {"host_threads", std::thread::hardware_concurrency()}};
  all_["records"] = nlohmann::json::array();
  write();
}

void RecordFile::add(const Record& r) {
  const std::string name = r.work.name(r.stage, r.precision, r.provider);
  nlohmann::json entry = {{"part", r.part},
                          {"name", name},
                          {"stage", r.stage},
                          {"domain", r.work.domain},
                          {"distribution", test::name(r.work.distribution)},
                          {"weights", test::name(r.work.weights)},
                          {"precision", r.precision},
                          {"provider", r.provider},
                          {"peer", r.peer},
                          {"n", r.work.n}};
  if (!r.skipped.empty()) entry["skipped"] = r.skipped;
  if (!r.seconds.empty()) {
    entry["seconds"] = r.seconds;
    entry["cpu_seconds"] = r.cpu_seconds;
    entry["relative_error"] = r.relative_error;
  }
  if (r.bytes_per_seed >= 0) entry["bytes_per_seed"] = r.bytes_per_seed;
  all_["records"].push_back(std::move(entry));
  write();

  std::string result = r.skipped;
  char text[64];
  if (!r.seconds.empty()) {
    std::snprintf(text, sizeof text, "%10.4f s, least of %zu", r.least(), r.seconds.size());
    result = text;
  } else if (r.bytes_per_seed >= 0) {
    std::snprintf(text, sizeof text, "%10.0f bytes per seed", r.bytes_per_seed);
    result = text;
  }
  std::fprintf(stderr, "%-8s %-58s %s\n", r.part.c_str(), name.c_str(), result.c_str());
}

void RecordFile::write() const {
  const std::string aside = path_ + ".part";
  std::ofstream out(aside);
  out << all_.dump(1) << '\n';
  out.close();
  if (!out || std::rename(aside.c_str(), path_.c_str()) != 0)
    throw std::runtime_error("cannot write " + path_);
}

}  // namespace powercell::bench
