#include "apps/outputs.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <powercell/error.hpp>

#include "apps/common.hpp"
#include "apps/io/atomic_file.hpp"
#include "apps/io/write/output.hpp"

namespace powercell::app {
namespace {

namespace fs = std::filesystem;

/// Pipes and terminals may be named more than once: they receive one output after the other.
bool is_stream(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_regular_file(path, ignored);
}

}  // namespace

void add_output_files(CLI::App& command, std::vector<std::string>& files, const std::string& kinds,
                      std::function<void(const std::string&)> check) {
  const auto refusal = [check = std::move(check)](const std::string& path) -> std::string {
    try {
      check(path);
      return {};
    } catch (const Error& error) {
      return error.what();
    }
  };
  command.add_option("-o,--output", files, "File to write; may be repeated: " + kinds)
      ->check(refusal)
      ->type_name("FILE")
      ->default_str("none")
      ->expected(1)
      ->take_all();
}

void add_table_file(CLI::App& command, std::string& file) {
  command
      .add_option("--table", file, "CSV with one row for each seed, or an array of NumPy with its results")
      ->type_name("FILE.csv|FILE.npy")
      ->default_str("none");
}

void check_writable(std::vector<std::string> files, std::initializer_list<std::string> more, bool json) {
  files.insert(files.end(), more);
  std::map<fs::path, std::string> named;
  bool piped = false;
  for (const std::string& path : files) {
    if (path.empty()) continue;
    if (io::is_standard_output(path)) {
      if (json || piped)
        throw WrongUsage(fmt::format("{} '-' would mix on the standard output; name files",
                                     json ? "--json and the file" : "two files"));
      piped = true;
      continue;
    }
    io::check_can_create(path);
    if (is_stream(path)) continue;
    std::error_code ignored;
    const auto [first, is_new] =
        named.emplace(fs::weakly_canonical(fs::absolute(path, ignored), ignored), path);
    if (!is_new)
      throw WrongUsage(fmt::format(
          "{} and {} are the same file, so one output would overwrite the other; choose another name",
          first->second, path));
  }
  if (piped) io::reserve_standard_output();
}

void write_diagram(const std::vector<std::string>& files, Diagram& diagram, const SeedsView& seeds,
                   const OutputChoice& choice) {
  if (files.empty()) return;
  const bool solid = diagram.domain().is_solid();
  diagram.compute(true, true);
  const Cells none;
  const JoinedCells& joined = diagram.joined();
  for (const std::string& path : files)
    io::write_output(path, {diagram.domain(), seeds, diagram.measures(), solid ? none : diagram.cells(),
                            joined, diagram.adjacency(), choice.weights_as_discs, choice.inputs,
                            choice.whole_cells, choice.style});
}

}  // namespace powercell::app
