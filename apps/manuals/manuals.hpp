/// \file
/// Manual pages and completion of shells, from the options of the tool.
#pragma once

#include <string>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace powercell::app {

/// The page for man(1) of the tool, or of one of its commands.
/// \param command  `app` or a command of it
/// \param date  of the page, as YYYY-MM-DD
std::string manual_page(const CLI::App& app, const CLI::App& command, const std::string& date);

std::string bash_completion(const CLI::App& app);
std::string zsh_completion(const CLI::App& app);
std::string fish_completion(const CLI::App& app);

/// The beginning of a description, for menus.
std::string short_text(const std::string& description);

}  // namespace powercell::app
