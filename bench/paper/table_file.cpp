#include "bench/paper/table_file.hpp"

#include <cstdio>
#include <ctime>
#include <powercell/error.hpp>
#include <powercell/version.hpp>
#include <thread>

namespace powercell::paper {
namespace {

std::string today() {
  const std::time_t now = std::time(nullptr);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
  return text;
}

}  // namespace

Command parse_command(int argc, char** argv) {
  std::filesystem::path folder = ".";
  bool quick = false;
  std::vector<std::string> words;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word == "--quick") {
      quick = true;
    } else if (word == "--out" && k + 1 < argc) {
      folder = argv[++k];
    } else if (word.starts_with("-")) {
      throw Error(ErrorCode::invalid_argument, "unknown option " + word);
    } else {
      words.push_back(word);
    }
  }
  std::filesystem::create_directories(folder);
  return {{Device::choose(), folder, quick}, words};
}

TableFile::TableFile(const Study& study, const std::string& name, const std::string& setting,
                     std::initializer_list<const char*> columns)
    : path_(study.folder / (name + ".csv")), file_(path_), columns_(columns.size()) {
  const DeviceInfo& info = study.device.info();
  file_ << "# " << setting << "\n# device: " << info.name << ", driver " << info.driver_version << ", "
        << info.compute_units << " compute units; host threads: " << std::thread::hardware_concurrency()
        << "\n# measured on " << today() << ", powercell " << version() << ", revision " << POWERCELL_REVISION
        << (study.quick ? "; quick: small inputs" : "") << "\n";
  const char* comma = "";
  for (const char* column : columns) {
    file_ << comma << column;
    comma = ",";
  }
  file_ << "\n" << std::flush;
}

void TableFile::row(std::initializer_list<Value> values) {
  if (values.size() != columns_)
    throw Error(ErrorCode::internal, path_.string() + ": a row has " + std::to_string(values.size()) +
                                         " values for " + std::to_string(columns_) + " columns");
  std::string line;
  for (const Value& value : values) {
    if (!line.empty()) line += ",";
    char number[32];
    if (const auto* text = std::get_if<std::string>(&value)) {
      line += *text;
    } else if (const auto* count = std::get_if<std::uint64_t>(&value)) {
      line += std::to_string(*count);
    } else {
      std::snprintf(number, sizeof number, "%.4g", std::get<double>(value));
      line += number;
    }
  }
  file_ << line << "\n" << std::flush;
  if (!file_) throw Error(ErrorCode::write_failed, "cannot write " + path_.string());
}

}  // namespace powercell::paper
