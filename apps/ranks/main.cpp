// mpirun -n 4 powercell_mpi: what the tool does, with seeds that several processes share. Exit codes are
// those of the tool, and the first rank speaks for all.
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "apps/command_line.hpp"
#include "apps/help_text.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/printable.hpp"
#include "apps/ranks/diagram.hpp"

namespace {

using namespace powercell;

enum ExitCode { done = 0, failed = 1, wrong_usage = 2, was_interrupted = 130 };

int report(const app::Ranks& ranks, int code, std::string message) {
  while (!message.empty() && message.back() == '\n') message.pop_back();
  if (ranks.is_first()) fmt::print(stderr, "powercell_mpi: error: {}\n", io::one_line(std::move(message)));
  return code;
}

int run(int argc, char** argv, app::Ranks& ranks) {
  CLI::App line("Power diagrams of seeds that several processes of MPI share.");
  line.name("powercell_mpi");
  line.formatter(app::help_format());
  line.get_help_ptr()->description("Show this help");
  line.set_version_flag("--version", std::string(version()), "Show the version");
  line.require_subcommand(1);
  const app::Command diagram = app::add_diagram_of_ranks(line, ranks);
  try {
    line.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return ranks.is_first() ? line.exit(success) : static_cast<int>(done);
  } catch (const CLI::ParseError& error) {
    return report(ranks, wrong_usage, app::fault_of_usage(line, error));
  }
  app::catch_interrupts();
  try {
    return diagram();
  } catch (const app::WrongUsage& error) {
    return report(ranks, wrong_usage, app::fault_of_usage(line, error));
  } catch (const Error& error) {
    if (error.code() == ErrorCode::interrupted) return report(ranks, was_interrupted, "interrupted");
    return report(ranks, failed, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int code = failed;
  try {
    app::Ranks ranks;
    code = run(argc, argv, ranks);
  } catch (const std::exception& error) {
    // What the ranks have not agreed on: others may wait for this one.
    fmt::print(stderr, "powercell_mpi: error: {} (unexpected; please report)\n", error.what());
    MPI_Abort(MPI_COMM_WORLD, failed);
  }
  MPI_Finalize();
  return code;
}
