// usage: host_forked WHEN: calls powercell in a child process.
//   before   the parent has not used it
//   listed   the parent has listed devices
//   used     the parent has computed; the child makes a diagram of its own
//   kept     the child goes on with the parent's diagram, its device in memory and its transport
//   cached   the child reads results that the parent had computed
//   ended    the child destroys what the parent has made, and ends
// Prints what the child says. Ends with the child's status: 2 if it was refused, 3 if it hangs.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <memory>
#include <powercell/powercell.hpp>
#include <string_view>

using namespace powercell;

namespace {

std::unique_ptr<Diagram> make() {
  const double low[] = {0, 0}, high[] = {1, 1}, positions[] = {.2, .3, .7, .2, .5, .8};
  auto diagram = std::make_unique<Diagram>(Device::choose(), Domain::box(low, high));
  diagram->set_seeds({2, positions, {}});
  diagram->measures();
  return diagram;
}

int child(std::string_view when, std::unique_ptr<Diagram>& kept) try {
  if (when == "ended") {
    kept.reset();
    std::exit(0);
  }
  if (when == "kept") {
    const double positions[] = {.25, .3, .7, .2, .5, .8};
    kept->set_seeds({2, positions, {}});
    kept->measures();
  } else if (when == "cached") {
    return kept->measures().total() > 0.999 ? 0 : 5;
  } else {
    make();
  }
  return 0;
} catch (const Error& error) {
  std::printf("%s: %s\n", name(error.code()), error.what());
  return 2;
}

}  // namespace

int main(int, char** argv) {
  const std::string_view when = argv[1];
  std::unique_ptr<Diagram> kept;
  if (when == "listed") devices();
  if (when != "listed" && when != "before") kept = make();
  const pid_t pid = fork();
  if (pid == 0) {
    const int status = child(when, kept);
    std::fflush(stdout);
    _exit(status);
  }
  int status = 0, waited = 0;
  for (; waited < 600 && waitpid(pid, &status, WNOHANG) == 0; ++waited) usleep(100000);
  if (waited == 600) {
    kill(pid, SIGKILL);
    return 3;
  }
  if (WIFSIGNALED(status)) return 4;
  if (kept) {  // the parent goes on
    const double positions[] = {.2, .35, .7, .2, .5, .8};
    kept->set_seeds({2, positions, {}});
    if (!(kept->measures().total() > 0.999)) return 5;
  }
  return WEXITSTATUS(status);
}
