#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/manuals/manuals.hpp"
#include "apps/option_words.hpp"

namespace powercell::app {
namespace {

std::string with_escapes(const std::string& text, std::string_view special) {
  std::string safe;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) safe += '\\';
    safe += c;
  }
  return safe;
}

/// In the single quotes of a shell.
std::string in_quotes(const std::string& text) {
  std::string safe = "'";
  for (const char c : text) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return safe + "'";
}

/// What completes a value, as _arguments takes it.
std::string action(const OptionValue& value) {
  std::string words;
  for (const std::string& word : value.words) words += (words.empty() ? "" : " ") + with_escapes(word, ":");
  const std::string files = value.files ? "_files" : "_files -/";
  if (!value.files && !value.folders) return words.empty() ? " " : "(" + words + ")";
  if (words.empty()) return files;
  return fmt::format("{{_alternative \"words:word:({})\" \"files:file:{}\"}}", words, files);
}

std::string value_spec(const OptionValue& value) {
  return fmt::format(":{}:{}", with_escapes(value.name, ":"), action(value));
}

/// Specifications for _arguments, one for each name.
std::string option_specs(const CLI::Option& option) {
  const OptionValue value = value_of(option);
  const bool repeated = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  std::string specs;
  for (const std::string& name : names_of(option)) {
    std::string spec = (repeated ? "*" : "") + name;
    if (!value.name.empty()) spec += name.starts_with("--") ? "=" : "+";
    spec += "[" + with_escapes(short_text(option.get_description()), "[]:\\") + "]";
    if (!value.name.empty()) spec += value_spec(value);
    specs += " \\\n          " + in_quotes(spec);
  }
  return specs;
}

std::string zsh_branch(const CLI::App& command) {
  std::string text = fmt::format("      {})\n        _arguments", command.get_name());
  for (const CLI::Option* option : options_of(command)) text += option_specs(*option);
  for (const CLI::Option* option : positionals_of(command)) {
    if (command.get_name() == "help")
      text += " \\\n          '1:command:_powercell_commands'";
    else
      text += " \\\n          " + in_quotes("1" + value_spec(value_of(*option)));
  }
  return text + "\n        ;;\n";
}

}  // namespace

std::string zsh_completion(const CLI::App& app) {
  std::string text =
      "#compdef powercell\n# Completion of powercell for zsh. Written from the options of the tool.\n"
      "_powercell_commands() {\n  local -a commands=(\n";
  for (const CLI::App* command : commands_of(app))
    text += "    " +
            in_quotes(command->get_name() + ":" + with_escapes(short_text(command->get_description()), ":")) +
            "\n";
  text +=
      "  )\n  _describe command commands\n}\n"
      "_powercell() {\n  local curcontext=$curcontext state line\n  typeset -A opt_args\n"
      "  _arguments -C";
  for (const CLI::Option* option : options_of(app)) text += option_specs(*option);
  text +=
      " \\\n    '1:command:_powercell_commands' '*::argument:->arguments'\n"
      "  if [[ $state == arguments ]]; then\n    case $words[1] in\n";
  for (const CLI::App* command : commands_of(app)) text += zsh_branch(*command);
  return text + "    esac\n  fi\n}\n_powercell \"$@\"\n";
}

}  // namespace powercell::app
