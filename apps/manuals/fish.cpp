#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/manuals/manuals.hpp"
#include "apps/option_words.hpp"

namespace powercell::app {
namespace {

/// In the single quotes of fish, which knows \' and \\ there.
std::string fish_quoted(const std::string& text) {
  std::string safe = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') safe += '\\';
    safe += c;
  }
  return safe + "'";
}

std::string fish_value(const OptionValue& value) {
  std::string text;
  if (value.files || value.folders) text += " -F";
  if (!value.words.empty()) text += " -a " + fish_quoted(fmt::format("{}", fmt::join(value.words, " ")));
  return text;
}

std::string fish_option(const CLI::Option& option, const std::string& condition) {
  std::string line = "complete -c powercell -n " + condition;
  for (const std::string& name : names_of(option))
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  const OptionValue value = value_of(option);
  if (!value.name.empty()) line += " -r" + fish_value(value);
  return line + " -d " + fish_quoted(short_text(option.get_description())) + "\n";
}

}  // namespace

std::string fish_completion(const CLI::App& app) {
  const std::string names = fmt::format("{}", fmt::join(command_names(app), " "));
  std::string text =
      "# Completion of powercell for fish. Written from the options of the tool.\ncomplete -c powercell -f\n";
  const std::string no_command = fish_quoted("not __fish_seen_subcommand_from " + names);
  for (const CLI::Option* option : options_of(app)) text += fish_option(*option, no_command);
  for (const CLI::App* command : commands_of(app))
    text += fmt::format("complete -c powercell -n {} -a {} -d {}\n", no_command, command->get_name(),
                        fish_quoted(short_text(command->get_description())));
  for (const CLI::App* command : commands_of(app)) {
    const std::string given = fish_quoted("__fish_seen_subcommand_from " + command->get_name());
    for (const CLI::Option* option : options_of(*command)) text += fish_option(*option, given);
    for (const CLI::Option* option : positionals_of(*command)) {
      OptionValue value = value_of(*option);
      if (command->get_name() == "help") value.words = command_names(app);
      if (const std::string what = fish_value(value); !what.empty())
        text.append("complete -c powercell -n ").append(given).append(what).append("\n");
    }
  }
  return text;
}

}  // namespace powercell::app
