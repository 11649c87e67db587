/// \file
/// The words that options accept: checked, with the closest match in the message, and shown in help, manual
/// pages and completion. And how options appear in these.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace powercell::app {

/// Accepts these words alone.
CLI::Validator one_of(std::vector<std::string> words);

/// Accepts anything. Completion proposes these words, beside files where the option takes files. One that
/// ends with a colon needs more behind it.
CLI::Validator known_words(std::vector<std::string> words);

/// What can be given to an option.
struct OptionValue {
  std::string name;                ///< "FILE", "N", "auto|double|float"; empty for a flag
  std::vector<std::string> words;  ///< of one_of() or known_words()
  bool only_words = false;
  bool files = false, folders = false;  ///< if the name says so
  std::string range;                    ///< "from 0 to 4096"; empty if it is not restricted
};
OptionValue value_of(const CLI::Option& option);

/// "-o" and "--output".
std::vector<std::string> names_of(const CLI::Option& option);
/// "-o, --output FILE", "--periodic[=xyz]"; of a positional argument its name in upper case.
std::string title_of(const CLI::Option& option);
/// The description and, in brackets, default, range and the options that it needs or excludes.
std::string text_of(const CLI::Option& option);

/// The arguments of a command that are told by their place, and its options in a group.
std::vector<const CLI::Option*> positionals_of(const CLI::App& command);
std::vector<const CLI::Option*> options_of(const CLI::App& command, const std::string& group);
/// The groups that have options, in their order.
std::vector<std::string> groups_of(const CLI::App& command);
/// All options but those told by their place.
std::vector<const CLI::Option*> options_of(const CLI::App& command);

/// The commands that help shows.
std::vector<const CLI::App*> commands_of(const CLI::App& app);
std::vector<std::string> command_names(const CLI::App& app);

}  // namespace powercell::app
