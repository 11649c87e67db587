// powercell manuals: manual pages and completions, written by the build and installed (cmake/install.cmake).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <powercell/error.hpp>

#include "apps/common.hpp"
#include "apps/io/atomic_file.hpp"
#include "apps/manuals/manuals.hpp"
#include "apps/option_words.hpp"

namespace powercell::app {
namespace {

namespace fs = std::filesystem;

struct ManualArguments {
  std::string folder, date;
};

void write_manual(const fs::path& path, const std::string& text) {
  std::error_code problem;
  fs::create_directories(path.parent_path(), problem);
  if (problem)
    throw Error(ErrorCode::write_failed, "the folder '" + path.parent_path().string() +
                                             "' cannot be created: " + problem.message() +
                                             "; name another one");
  io::AtomicFile file(path.string());
  file.write(text);
  file.commit();
}

/// "2026-11-26", as far as digits tell.
std::string wrong_date(const std::string& date) {
  constexpr std::string_view form = "dddd-dd-dd";
  const bool right = std::equal(date.begin(), date.end(), form.begin(), form.end(),
                                [](char c, char f) { return f == 'd' ? c >= '0' && c <= '9' : c == f; });
  return right ? std::string() : "'" + date + "' is not a date such as 2026-11-26";
}

int write_all(const CLI::App& app, const ManualArguments& arguments) {
  const fs::path folder = arguments.folder, pages = folder / "man" / "man1";
  write_manual(pages / "powercell.1", manual_page(app, app, arguments.date));
  for (const CLI::App* command : commands_of(app))
    write_manual(pages / ("powercell-" + command->get_name() + ".1"),
                 manual_page(app, *command, arguments.date));
  write_manual(folder / "bash-completion" / "completions" / "powercell", bash_completion(app));
  write_manual(folder / "zsh" / "site-functions" / "_powercell", zsh_completion(app));
  write_manual(folder / "fish" / "vendor_completions.d" / "powercell.fish", fish_completion(app));
  return 0;
}

}  // namespace

std::string short_text(const std::string& description) {
  constexpr std::size_t most = 70;
  std::string first = description.substr(0, description.find(". "));
  if (first.size() <= most) return first;
  return first.substr(0, first.rfind(' ', most)) + " ...";
}

Command add_manuals(CLI::App& app) {
  auto arguments = std::make_shared<ManualArguments>();
  CLI::App* command = app.add_subcommand("manuals", "Write manual pages and completions of shells");
  command->group("");  // hidden
  command->add_option("folder", arguments->folder, "Folder to write into, laid out as /usr/share")
      ->type_name("FOLDER")
      ->required();
  command->add_option("--date", arguments->date, "Date of the manual pages")
      ->type_name("YYYY-MM-DD")
      ->check(wrong_date)
      ->required();
  command->footer("Examples:\n  powercell manuals ~/.local/share --date 2026-11-26");
  return [&app, arguments] { return write_all(app, *arguments); };
}

}  // namespace powercell::app
