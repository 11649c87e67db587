#include "apps/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/help_text.hpp"
#include "apps/io/closest.hpp"
#include "apps/io/printable.hpp"
#include "apps/option_words.hpp"

namespace powercell::app {
namespace {

constexpr const char* general_examples =
    "Options without a value are off unless given. 'powercell help COMMAND' lists those of a command.\n"
    "Examples:\n"
    "  powercell demo                                       six pictures, and a page with all of them\n"
    "  powercell devices                                    the devices for --device\n"
    "  powercell diagram --domain square --seeds random:2000 -o cells.svg\n"
    "  powercell transport --domain square --seeds random:1000 -o equal.svg\n"
    "  powercell remesh mesh.off --count 5000 -o new.off    well-shaped triangles\n"
    "  powercell verify --device cpu                        does this device compute correctly?\n"
    "  powercell bench                                      and how fast?\n"
    "  powercell tune                                       settings that make it faster\n"
    "  powercell treemap sales.csv -o sales.svg             hierarchical data as nested cells\n"
    "  powercell sample --image photo.png -n 8000 -o dots.svg\n"
    "Environment:\n"
    "  POWERCELL_DEVICE      the device where --device is not given\n"
    "  POWERCELL_CACHE_DIR   the folder of compiled kernels; else ~/.cache/powercell\n"
    "  POWERCELL_CACHE       never or always keep them there; else where the driver does not keep them "
    "itself\n"
    "  POWERCELL_FP64        never: use devices as if they had no double precision\n"
    "  POWERCELL_LANES       8, 4 or 1: how many numbers kernels take at once, whatever the device\n"
    "  POWERCELL_LOG         info or detail: say on standard error what is done";

Command add_help(CLI::App& app) {
  CLI::App* command = app.add_subcommand("help", "Show the help of a command");
  auto wanted = std::make_shared<std::string>();
  command->add_option("command", *wanted, "One of the commands")->default_str("all of them, in short");
  command->footer("Examples:\n  powercell help\n  powercell help diagram");
  return [&app, wanted] {
    std::string name = app.get_name();
    const CLI::App* shown = &app;
    if (!wanted->empty()) {
      shown = nullptr;
      for (const CLI::App* one : commands_of(app))
        if (one->get_name() == *wanted) shown = one;
      if (!shown)
        throw WrongUsage(fmt::format("unknown command '{}'{}", *wanted,
                                     io::did_you_mean(io::closest(*wanted, command_names(app)))));
      name += " " + *wanted;
    }
    fmt::print("{}", shown->get_formatter()->make_help(shown, name, CLI::AppFormatMode::Normal));
    return 0;
  };
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(command))
    for (const std::string& name : names_of(*option))
      if (name.starts_with("--")) names.push_back(name.substr(2));
  return names;
}

std::string without_dashes(const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  return name.substr(std::min(name.size(), name.find_first_not_of('-')));
}

/// Of a word that begins with a dash and is no option of the command.
std::string unknown_option(const CLI::App& app, const CLI::App& command, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  const std::string meant = io::closest(without_dashes(word), option_names(command));
  std::string text = fmt::format("unknown option '{}'", name);
  if (!meant.empty()) return text + io::did_you_mean("--" + meant);
  std::vector<std::string> others;
  for (const CLI::App* other : commands_of(app)) {
    const std::vector<std::string> names = option_names(*other);
    if (other != &command && std::find(names.begin(), names.end(), without_dashes(word)) != names.end())
      others.push_back(other->get_name());
  }
  if (others.empty()) return text;
  if (&command == &app) return text + " before a command; options follow the command that they are for";
  return text + fmt::format(" of this command; {} {} it", fmt::join(others, ", "),
                            others.size() == 1 ? "has" : "have");
}

/// What is wrong with the words that CLI11 could not use; empty if there are none.
std::string unknown_words(const CLI::App& app, const CLI::App& command, bool only_options) {
  if (app.get_subcommands().empty()) {
    const std::vector<std::string> words = app.remaining();
    if (words.empty()) return {};
    if (words[0].starts_with('-')) return unknown_option(app, app, words[0]);
    return fmt::format("unknown command '{}'{}", words[0],
                       io::did_you_mean(io::closest(words[0], command_names(app))));
  }
  for (const CLI::App* one : {&app, &command})
    for (const std::string& word : one->remaining())
      if (word.starts_with('-') && word.size() > 1 && word != "--") return unknown_option(app, *one, word);
  const std::vector<std::string> words = command.remaining();
  return only_options || words.empty() ? std::string() : fmt::format("unexpected argument '{}'", words[0]);
}

}  // namespace

CommandLine::CommandLine()
    : app("Power diagrams (weighted Voronoi diagrams) of polygons, surfaces and volumes on OpenCL.") {
  app.name("powercell");
  app.formatter(help_format());
  app.get_help_ptr()->description("Show this help");
  app.set_version_flag("--version", std::string(version()), "Show the version");
  app.require_subcommand(1);
  app.footer(general_examples);
  commands = {
      {"devices", add_devices(app)}, {"diagram", add_diagram(app)}, {"verify", add_verify(app)},
      {"demo", add_demo(app)},       {"bench", add_bench(app)},     {"transport", add_transport(app)},
      {"treemap", add_treemap(app)}, {"remesh", add_remesh(app)},   {"sample", add_sample(app)},
      {"tune", add_tune(app)},       {"help", add_help(app)},       {"manuals", add_manuals(app)},
  };
}

std::string fault_of_usage(const CLI::App& app, const std::exception& error) {
  const CLI::App* command = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
  // CLI11 reports a missing option before a mistyped one.
  const bool parsing = dynamic_cast<const CLI::ParseError*>(&error) != nullptr;
  const bool left_over = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  std::string fault = parsing ? unknown_words(app, *command, !left_over) : std::string();
  if (fault.empty()) fault = error.what();
  const std::string name = command == &app ? app.get_name() : app.get_name() + " " + command->get_name();
  return fmt::format("{} (see '{} --help')", fault, name);
}

}  // namespace powercell::app
