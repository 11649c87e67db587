// The command line tool. Each subcommand has a file of its own. Exit codes: 0 done, 1 failed, 2 wrong usage,
// 130 interrupted, 141 if the reader of standard output left before the end.
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "apps/command_line.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/printable.hpp"

namespace {

enum ExitCode { done = 0, failed = 1, wrong_usage = 2, was_interrupted = 130, closed_pipe = 141 };

int report(int code, std::string message) {
  while (!message.empty() && message.back() == '\n') message.pop_back();
  // Messages contain file names as they were given.
  fmt::print(stderr, "powercell: error: {}\n", powercell::io::one_line(std::move(message)));
  return code;
}

int run(int argc, char** argv) {
  powercell::app::CommandLine line;
  CLI::App& app = line.app;
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return report(wrong_usage, powercell::app::fault_of_usage(app, error));
  }
  powercell::app::catch_interrupts();
  int code = done;
  try {
    code = line.commands.at(app.get_subcommands().front()->get_name())();
  } catch (const powercell::app::WrongUsage& error) {
    return report(wrong_usage, powercell::app::fault_of_usage(app, error));
  }
  errno = 0;
  const bool written = std::fflush(stdout) == 0 && !std::ferror(stdout);
  if (!written && errno != EPIPE)  // a reader that has what it wants is no failure
    return report(failed, "not all of standard output could be written");
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const powercell::Error& error) {
    // Also if the signal made something else fail: a driver's compiler removes its files on a signal.
    if (error.code() == powercell::ErrorCode::interrupted || powercell::app::interrupted())
      // The library says that its callback stopped it; the tool may say how to go on.
      return report(was_interrupted,
                    std::string_view(error.what()).starts_with("interrupted") ? error.what() : "interrupted");
    return report(failed, error.what());
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::broken_pipe) return closed_pipe;
    return report(failed, error.what());
  } catch (const std::bad_alloc&) {
    return report(failed, "out of memory; fewer seeds or a smaller domain may fit");
  } catch (const std::exception& error) {
    return report(failed, fmt::format("{} (unexpected; please report)", error.what()));
  }
}
