#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cctype>
#include <powercell/version.hpp>
#include <sstream>

#include "apps/help_text.hpp"
#include "apps/manuals/manuals.hpp"
#include "apps/option_words.hpp"

namespace powercell::app {
namespace {

/// Characters as they are for troff, which gives some of them a meaning or another look.
std::string troff(const std::string& text) {
  std::string safe;
  for (const char c : text) switch (c) {
      case '\\':
        safe += "\\e";
        break;
      case '-':
        safe += "\\-";
        break;
      case '\'':
        safe += "\\(aq";
        break;
      case '^':
        safe += "\\(ha";
        break;
      case '~':
        safe += "\\(ti";
        break;
      case '`':
        safe += "\\(ga";
        break;
      default:
        safe += c;
    }
  return safe;
}

/// A line of text; one that begins with a dot would be a request.
std::string text_line(const std::string& line) {
  return (line.starts_with('.') ? "\\&" : "") + troff(line) + "\n";
}

std::string paragraph(const std::string& text) {
  constexpr std::size_t width = 70;  // of the source; man(1) fills lines anew
  std::istringstream lines(wrapped(text, 0, 0, width));
  std::string out;
  for (std::string line; std::getline(lines, line);) out += text_line(line);
  return out;
}

/// Lines as they are.
std::string block(const std::vector<std::string>& lines) {
  std::string out = ".nf\n";
  for (const std::string& line : lines) out += text_line(line);
  return out + ".fi\n";
}

std::string upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// Names in bold, values in italics.
std::string formatted_title(const CLI::Option& option) {
  if (option.get_positional()) return "\\fI" + troff(title_of(option)) + "\\fR";
  std::string title;
  for (const std::string& name : names_of(option)) {
    if (!title.empty()) title += ", ";
    title += "\\fB" + troff(name) + "\\fR";
  }
  const OptionValue value = value_of(option);
  if (!value.name.empty()) return title + " \\fI" + troff(value.name) + "\\fR";
  const std::string shown = title_of(option);
  if (const std::size_t given = shown.find('['); given != std::string::npos)
    title += troff(shown.substr(given));
  return title;
}

std::string entries(const std::vector<const CLI::Option*>& options) {
  std::string out;
  for (const CLI::Option* option : options)
    out += ".TP\n" + formatted_title(*option) + "\n" + paragraph(text_of(*option));
  return out;
}

/// The text below the options. "Examples:" and the like on a line of their own begin sections, indented lines
/// are left as they are, and others are notes.
std::string footer_sections(const std::string& footer) {
  std::istringstream lines(footer);
  std::string notes, others, text;
  std::vector<std::string> indented;
  std::string* section = &notes;
  const auto flush = [&] {
    if (!text.empty()) *section += (section->empty() ? "" : ".PP\n") + paragraph(text);
    if (!indented.empty()) *section += block(indented);
    text.clear();
    indented.clear();
  };
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("  ")) {
      indented.push_back(line);
      continue;
    }
    if (!indented.empty()) flush();
    if (line.ends_with(':') && line.find_first_of(" .,") == std::string::npos) {
      flush();
      section = &others;
      others += ".SH " + upper_case(line.substr(0, line.size() - 1)) + "\n";
      continue;
    }
    if (section == &others) {  // a section ends with its indented lines
      flush();
      section = &notes;
    }
    text += line + " ";
  }
  flush();
  return (notes.empty() ? "" : ".SH NOTES\n" + notes) + others;
}

std::string list_of_commands(const CLI::App& app) {
  std::string out = ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app))
    out += ".TP\n\\fB" + troff(command->get_name()) + "\\fR\n" + paragraph(command->get_description());
  return out;
}

std::string page_name(const CLI::App& app, const CLI::App& command) {
  return &command == &app ? app.get_name() : app.get_name() + "-" + command.get_name();
}

std::string see_also(const CLI::App& app, const CLI::App& command) {
  std::string out;
  const auto add = [&](const CLI::App& other) {
    if (&other == &command) return;
    out += (out.empty() ? "" : ",\n") + std::string(".BR ") + troff(page_name(app, other)) + " (1)";
  };
  add(app);
  for (const CLI::App* other : commands_of(app)) add(*other);
  return ".SH SEE ALSO\n" + out + "\n";
}

}  // namespace

std::string manual_page(const CLI::App& app, const CLI::App& command, const std::string& date) {
  const std::string name = page_name(app, command);
  std::string called = app.get_name();
  if (&command != &app) called += " " + command.get_name();
  std::string page = fmt::format(
      ".\\\" Written from the options of the tool.\n.TH {} 1 \"{}\" \"powercell {}\" \"User Commands\"\n"
      ".ad l\n.nh\n",  // words are not broken at hyphens: names would be copied with them
      troff(upper_case(name)), date, version());
  page += ".SH NAME\n" + troff(name) + " \\- " + troff(command.get_description()) + "\n";
  page += ".SH SYNOPSIS\n\\fB" + troff(called) + "\\fR";
  if (!options_of(command).empty()) page += " [\\fIOPTIONS\\fR]";
  for (const CLI::Option* option : positionals_of(command))
    page += std::string(option->get_required() ? " " : " [") + "\\fI" + troff(title_of(*option)) +
            (option->get_required() ? "\\fR" : "\\fR]");
  if (!commands_of(command).empty()) page += " \\fICOMMAND\\fR";
  page += "\n";
  if (const auto positionals = positionals_of(command); !positionals.empty())
    page += ".SH ARGUMENTS\n" + entries(positionals);
  bool first = true;
  for (const std::string& group : groups_of(command)) {
    page += (first ? ".SH " + upper_case(group) : ".SS " + troff(group)) + "\n" +
            entries(options_of(command, group));
    first = false;
  }
  if (!commands_of(command).empty()) page += list_of_commands(command);
  return page + footer_sections(command.get_footer()) + see_also(app, command);
}

}  // namespace powercell::app
