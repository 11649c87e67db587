#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/manuals/manuals.hpp"
#include "apps/option_words.hpp"

namespace powercell::app {
namespace {

std::string assignments(const OptionValue& value) {
  std::string text;
  if (!value.words.empty()) text += fmt::format(" words='{}'", fmt::join(value.words, " "));
  if (value.folders) text += " files=d";
  if (value.files) text += " files=f";
  return text;
}

/// The branch of one command: its options, what follows `prev`, and what its arguments are.
std::string bash_branch(const CLI::App& command, const std::vector<std::string>& arguments) {
  std::vector<std::string> all;
  std::string cases;
  for (const CLI::Option* option : options_of(command)) {
    const std::vector<std::string> names = names_of(*option);
    all.insert(all.end(), names.begin(), names.end());
    const OptionValue value = value_of(*option);
    if (!value.name.empty())
      cases += fmt::format("        {}) value=1{} ;;\n", fmt::join(names, " | "), assignments(value));
  }
  std::string text = fmt::format("    {})\n      options='{}'\n", command.get_name(), fmt::join(all, " "));
  if (!cases.empty()) text += "      case $prev in\n" + cases + "      esac\n";
  OptionValue positional;
  for (const CLI::Option* option : positionals_of(command)) positional = value_of(*option);
  if (!arguments.empty()) positional.words = arguments;
  if (const std::string set = assignments(positional); !set.empty())
    text += "      [[ $value ]] || [[ $cur == -* ]] ||" + set + "\n";
  return text + "      ;;\n";
}

constexpr const char* bash_start =
    R"(# Completion of powercell for bash. Written from the options of the tool.
_powercell() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]}
  local command='' options='' words='' files='' value='' i
  # Bash splits --option=value into three words.
  if [[ $cur == '=' ]]; then
    cur=''
  elif [[ $prev == '=' ]] && ((COMP_CWORD > 1)); then
    prev=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    if [[ ${COMP_WORDS[i]} != -* ]]; then
      command=${COMP_WORDS[i]}
      break
    fi
  done
  case $command in
)";

constexpr const char* bash_end = R"(  esac
  if [[ ! $value && ! $words && ! $files ]] || [[ ! $value && $cur == -* ]]; then
    words=$options files=''
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
  if [[ $files ]]; then
    compopt -o filenames
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -"$files" -- "$cur")
  fi
  # "random:" needs more behind it.
  if ((${#COMPREPLY[@]} == 1)) && [[ ${COMPREPLY[0]} == *: ]]; then
    compopt -o nospace
  fi
}
complete -F _powercell powercell
)";

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::vector<std::string> options;
  for (const CLI::Option* option : options_of(app))
    for (const std::string& name : names_of(*option)) options.push_back(name);
  const std::vector<std::string> names = command_names(app);
  std::string text = bash_start;
  text += fmt::format("    '')\n      options='{}'\n      [[ $cur == -* ]] || words='{}'\n      ;;\n",
                      fmt::join(options, " "), fmt::join(names, " "));
  for (const CLI::App* command : commands_of(app))
    text += bash_branch(*command, command->get_name() == "help" ? names : std::vector<std::string>());
  return text + bash_end;
}

}  // namespace powercell::app
