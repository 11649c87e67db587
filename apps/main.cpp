// The command line tool. Each subcommand has a file of its own. Exit codes: 0 done, 1 failed, 2 wrong usage,
// 130 interrupted, 141 if the reader of standard output left before the end.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <map>
#include <new>
#include <system_error>

#include "apps/common.hpp"
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

// Reports a fault of the arguments in one line that points to --help.
int report_usage(const CLI::App& app, const std::exception& error) {
  std::string command = "powercell";
  for (const CLI::App* used : app.get_subcommands()) command += " " + used->get_name();
  std::string what = error.what();
  // For a word that is not a subcommand CLI11 reports a missing subcommand.
  if (const auto words = app.remaining(); app.get_subcommands().empty() && !words.empty())
    what = fmt::format("unknown {} '{}'", words[0].starts_with('-') ? "option" : "command", words[0]);
  return report(wrong_usage, fmt::format("{} (see '{} --help')", what, command));
}

int run(int argc, char** argv) {
  CLI::App app{"Power diagrams (weighted Voronoi diagrams) of polygons, surfaces and volumes on OpenCL."};
  app.name("powercell");
  app.set_version_flag("--version", std::string(powercell::version()));
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  powercell demo                                       pictures of three real shapes\n"
      "  powercell devices                                    the devices for --device\n"
      "  powercell diagram --domain square --seeds random:2000 -o cells.svg\n"
      "  powercell transport --domain square --seeds random:1000 -o equal.svg\n"
      "  powercell remesh mesh.off --count 5000 -o new.off    well-shaped triangles\n"
      "  powercell verify --device cpu                        does this device compute correctly?\n"
      "  powercell bench                                      and how fast?\n"
      "  powercell treemap sales.csv -o sales.svg             hierarchical data as nested cells\n"
      "  powercell sample --image photo.png -n 8000 -o dots.svg\n"
      "Environment: POWERCELL_DEVICE, POWERCELL_CACHE_DIR, POWERCELL_CACHE, POWERCELL_LOG (info, detail).");
  const std::map<std::string, powercell::app::Command> commands = {
      {"devices", powercell::app::add_devices(app)}, {"diagram", powercell::app::add_diagram(app)},
      {"verify", powercell::app::add_verify(app)},   {"demo", powercell::app::add_demo(app)},
      {"bench", powercell::app::add_bench(app)},     {"transport", powercell::app::add_transport(app)},
      {"treemap", powercell::app::add_treemap(app)}, {"remesh", powercell::app::add_remesh(app)},
      {"sample", powercell::app::add_sample(app)},
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return report_usage(app, error);
  }
  powercell::app::catch_interrupts();
  int code = done;
  try {
    code = commands.at(app.get_subcommands().front()->get_name())();
  } catch (const powercell::app::WrongUsage& error) {
    return report_usage(app, error);
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
      return report(was_interrupted, "interrupted");
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
