#include "apps/help_text.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <sstream>

#include "apps/option_words.hpp"

namespace powercell::app {
namespace {

constexpr std::size_t column_of_texts = 28;

std::size_t help_width() {
  constexpr std::size_t usual = 100, least = 60, most = 120;
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return usual;
  return std::clamp<std::size_t>(size.ws_col, least, most);
}

std::string entry(const std::string& title, const std::string& text) {
  std::string line = "  " + title;
  if (text.empty()) return line + "\n";
  if (line.size() + 2 > column_of_texts)
    line += "\n" + std::string(column_of_texts, ' ');
  else
    line.resize(column_of_texts, ' ');
  return line + wrapped(text, column_of_texts, column_of_texts, help_width()) + "\n";
}

std::string usage_line(const CLI::App& command, const std::string& name) {
  std::string line = "Usage: " + name;
  if (!options_of(command).empty()) line += " [OPTIONS]";
  for (const CLI::Option* option : positionals_of(command))
    line += " " + (option->get_required() ? title_of(*option) : "[" + title_of(*option) + "]");
  if (!commands_of(command).empty()) line += " COMMAND";
  return line + "\n";
}

class HelpFormat : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* command, std::string name, CLI::AppFormatMode) const override {
    std::string text = command->get_description() + "\n" + usage_line(*command, name);
    if (const auto positionals = positionals_of(*command); !positionals.empty()) {
      text += "\nArguments:\n";
      for (const CLI::Option* option : positionals) text += entry(title_of(*option), text_of(*option));
    }
    for (const std::string& group : groups_of(*command)) {
      text += "\n" + group + ":\n";
      for (const CLI::Option* option : options_of(*command, group))
        text += entry(title_of(*option), text_of(*option));
    }
    if (const auto commands = commands_of(*command); !commands.empty()) {
      text += "\nCommands:\n";
      for (const CLI::App* one : commands) text += entry(one->get_name(), one->get_description());
    }
    return text + "\n" + make_footer(command);
  }
};

}  // namespace

std::string wrapped(const std::string& text, std::size_t column, std::size_t indent, std::size_t width) {
  std::istringstream words(text);
  std::string out;
  bool first = true;
  for (std::string word; words >> word; first = false) {
    if (first) {
      column += word.size();
    } else if (column + 1 + word.size() > width) {
      out += "\n" + std::string(indent, ' ');
      column = indent + word.size();
    } else {
      out += ' ';
      column += 1 + word.size();
    }
    out += word;
  }
  return out;
}

std::shared_ptr<CLI::FormatterBase> help_format() {
  return std::make_shared<HelpFormat>();
}

}  // namespace powercell::app
