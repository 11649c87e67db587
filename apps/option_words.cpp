#include "apps/option_words.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

#include "apps/io/closest.hpp"
#include "apps/io/printable.hpp"

namespace powercell::app {
namespace {

// CLI11 adds the descriptions of checks to the name of an option's type, each behind a colon.
constexpr const char *only_mark = ":{", *known_mark = ":words{", *range_mark = " in [";

std::string in_braces(const std::vector<std::string>& words) {
  return fmt::format("{{{}}}", fmt::join(words, ","));
}

/// The words behind a mark.
std::vector<std::string> words_behind(const std::string& type, std::size_t mark) {
  std::vector<std::string> words;
  const std::size_t begin = type.find('{', mark) + 1;
  std::istringstream list(type.substr(begin, type.find('}', begin) - begin));
  for (std::string word; std::getline(list, word, ',');) words.push_back(word);
  return words;
}

std::string readable_number(const std::string& number) {
  const bool whole = std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
  return whole && number.size() > 4 && number.size() < 19 ? io::with_commas(std::stoull(number)) : number;
}

/// "from 0 to 4,096" of " in [0 - 4096]".
std::string range_text(const std::string& type, std::size_t mark) {
  const std::size_t begin = mark + std::string_view(range_mark).size(), middle = type.find(" - ", begin);
  const std::size_t end = type.find(']', begin);
  if (middle == std::string::npos || end == std::string::npos) return {};
  return fmt::format("from {} to {}", readable_number(type.substr(begin, middle - begin)),
                     readable_number(type.substr(middle + 3, end - middle - 3)));
}

std::string plain_name(const std::string& type) {
  if (type == "INT" || type == "UINT") return "N";
  return type == "FLOAT" ? "X" : type;
}

std::string joined_names(const std::set<CLI::Option*>& options) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options) names.push_back(option->get_name());
  std::sort(names.begin(), names.end());  // a set of pointers has no order that is the same every time
  return fmt::format("{}", fmt::join(names, ", "));
}

bool is_flag(const CLI::Option& option) {
  return option.get_items_expected_max() == 0 || option.get_type_size() == 0;
}

}  // namespace

CLI::Validator one_of(std::vector<std::string> words) {
  const std::string description = in_braces(words);
  return CLI::Validator(
      [words = std::move(words)](std::string& word) -> std::string {
        if (std::find(words.begin(), words.end(), word) != words.end()) return {};
        return fmt::format("'{}' is none of {}{}", io::readable(word), fmt::join(words, ", "),
                           io::did_you_mean(io::closest(word, words)));
      },
      description);
}

CLI::Validator known_words(std::vector<std::string> words) {
  return CLI::Validator([](std::string&) { return std::string(); }, "words" + in_braces(words));
}

OptionValue value_of(const CLI::Option& option) {
  OptionValue value;
  if (is_flag(option)) return value;
  const std::string type = option.get_type_name();
  const std::size_t only = type.find(only_mark), known = type.find(known_mark), range = type.find(range_mark);
  const std::size_t range_colon = range == std::string::npos ? range : type.rfind(':', range);
  value.name = plain_name(type.substr(0, std::min({only, known, range_colon})));
  value.only_words = only != std::string::npos;
  if (value.only_words || known != std::string::npos) value.words = words_behind(type, std::min(only, known));
  if (value.only_words) value.name = fmt::format("{}", fmt::join(value.words, "|"));
  if (range != std::string::npos) value.range = range_text(type, range);
  value.files = !value.only_words && value.name.find("FILE") != std::string::npos;
  value.folders = !value.only_words && value.name.find("FOLDER") != std::string::npos;
  return value;
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string title_of(const CLI::Option& option) {
  if (option.get_positional()) {
    std::string name = option.get_name(true);
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return name;
  }
  std::string title = fmt::format("{}", fmt::join(names_of(option), ", "));
  if (!is_flag(option)) return title + " " + value_of(option).name;
  // A flag such as "--periodic{xyz}" has a value that may be given another way.
  if (const auto& names = option.get_lnames(); !names.empty() && option.check_fname(names.front()))
    title += "[=" + option.get_flag_value(names.front(), "") + "]";
  return title;
}

std::string text_of(const CLI::Option& option) {
  std::vector<std::string> notes;
  if (option.get_required()) notes.emplace_back("required");
  if (!is_flag(option) && !option.get_default_str().empty())
    notes.push_back("default: " + option.get_default_str());
  if (const std::string range = value_of(option).range; !range.empty()) notes.push_back(range);
  if (!option.get_needs().empty()) notes.push_back("needs " + joined_names(option.get_needs()));
  if (!option.get_excludes().empty()) notes.push_back("not with " + joined_names(option.get_excludes()));
  if (notes.empty()) return option.get_description();
  return fmt::format("{} [{}]", option.get_description(), fmt::join(notes, "; "));
}

std::vector<const CLI::Option*> positionals_of(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return option->get_positional(); });
}

std::vector<const CLI::Option*> options_of(const CLI::App& command, const std::string& group) {
  return command.get_options([&](const CLI::Option* option) {
    return option->nonpositional() && !group.empty() && option->get_group() == group;
  });
}

std::vector<std::string> groups_of(const CLI::App& command) {
  std::vector<std::string> groups = command.get_groups();
  std::erase_if(groups, [&](const std::string& group) { return options_of(command, group).empty(); });
  return groups;
}

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  std::vector<const CLI::Option*> all;
  for (const std::string& group : groups_of(command))
    for (const CLI::Option* option : options_of(command, group)) all.push_back(option);
  return all;
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands(
      [](const CLI::App* command) { return !command->get_name().empty() && !command->get_group().empty(); });
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
  return names;
}

}  // namespace powercell::app
