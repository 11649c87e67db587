// Files appear as a whole or not at all, and outputs that cannot be written are refused before any is
// written.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <powercell/error.hpp>

#include "apps/io/atomic_file.hpp"
#include "apps/io/write/output.hpp"
#include "apps/io/write/table.hpp"
#include "tests/writers/made_diagram.hpp"
#include "tests/writers/temporary_folder.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

// The Error that `action` throws: its code, and its message in `message`.
template <class Action>
ErrorCode code_of(const Action& action, std::string& message) {
  try {
    action();
  } catch (const Error& error) {
    message = error.what();
    return error.code();
  }
  FAIL("no error was thrown");
  return ErrorCode::internal;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Limits the size of files of this process, which simulates a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit old_{};
  void (*handler_)(int);
};

const char* const extensions[] = {".svg", ".png", ".pdf", ".vtu",  ".vtp",
                                  ".obj", ".ply", ".off", ".json", ".html"};

}  // namespace

TEST_CASE("a file that cannot grow leaves nothing, for every format") {
  const MadeDiagram made = polygon_diagram(40);
  for (const std::string extension : extensions) {
    CAPTURE(extension);
    TemporaryFolder folder;
    const std::string path = folder.file("diagram" + extension);
    std::string message;
    {
      FileSizeLimit limit(64);
      CHECK(code_of([&] { io::write_output(path, made.output()); }, message) == ErrorCode::write_failed);
    }
    CHECK(contains(message, path));
    CHECK(folder.count() == 0);
    io::write_output(path, made.output());
    CHECK(std::filesystem::file_size(path) > 64);
    CHECK(folder.count() == 1);
  }
}

TEST_CASE("a failed write leaves the older file unchanged") {
  TemporaryFolder folder;
  const std::string path = folder.file("table.csv");
  std::ofstream(path) << "old";
  const MadeDiagram made = polygon_diagram(40);
  std::string message;
  {
    FileSizeLimit limit(64);
    CHECK(code_of([&] { io::write_table(path, made.output().seeds, made.measures, made.adjacency); },
                  message) == ErrorCode::write_failed);
  }
  CHECK(read_all(path) == "old");
  CHECK(folder.count() == 1);
}

TEST_CASE("a full device is an error that says so") {
  if (!std::filesystem::is_character_file("/dev/full")) return;
  const MadeDiagram made = polygon_diagram(10);
  std::string message;
  CHECK(code_of([&] { io::write_walls("/dev/full", made.adjacency); }, message) == ErrorCode::write_failed);
  CHECK(contains(message, "/dev/full"));
  CHECK(contains(message, "space"));
  CHECK(std::filesystem::is_character_file("/dev/full"));
}

TEST_CASE("a folder that does not exist, and a folder in place of a file") {
  TemporaryFolder folder;
  const MadeDiagram made = polygon_diagram(10);
  std::string message;
  const std::string missing = folder.file("missing/diagram.obj");
  CHECK(code_of([&] { io::write_output(missing, made.output()); }, message) == ErrorCode::write_failed);
  CHECK(contains(message, missing));
  CHECK(contains(message, "folder"));
  std::filesystem::create_directory(folder.file("taken.obj"));
  CHECK(code_of([&] { io::write_output(folder.file("taken.obj"), made.output()); }, message) ==
        ErrorCode::write_failed);
  CHECK(folder.count() == 1);
}

TEST_CASE("permissions and links of an older file are kept") {
  TemporaryFolder folder;
  const std::string target = folder.file("target.csv"), link = folder.file("link.csv");
  std::ofstream(target) << "old";
  chmod(target.c_str(), 0640);
  std::filesystem::create_symlink(target, link);
  io::AtomicFile file(link);
  file.write("new");
  CHECK(read_all(target) == "old");
  file.commit();
  CHECK(read_all(target) == "new");
  CHECK(std::filesystem::is_symlink(link));
  struct stat status {};
  stat(target.c_str(), &status);
  CHECK((status.st_mode & 07777) == 0640);
}

TEST_CASE("an interrupt leaves no unfinished file") {
  TemporaryFolder folder;
  io::AtomicFile file(folder.file("long.csv"));
  file.write("begun");
  CHECK(folder.count() == 1);
  io::remove_unfinished_files();
  CHECK(folder.count() == 0);
}

TEST_CASE("the error for an unknown extension lists the known ones") {
  TemporaryFolder folder;
  const MadeDiagram made = polygon_diagram(10);
  for (const std::string name : {"diagram.bmp", "diagram", ".svg.", "svg"}) {
    CAPTURE(name);
    std::string message;
    CHECK_THROWS_AS(io::check_output_format(name), Error);
    CHECK(code_of([&] { io::write_output(folder.file(name), made.output()); }, message) ==
          ErrorCode::invalid_file);
    CHECK(contains(message, name));
    for (const std::string extension : extensions) CHECK(contains(message, extension));
  }
  CHECK_NOTHROW(io::check_output_format("A.SVG"));
  CHECK(folder.count() == 0);
}

TEST_CASE("vector pictures of surfaces and volumes are refused and point to PNG") {
  TemporaryFolder folder;
  const MadeDiagram made = volume_diagram(5);
  for (const std::string extension : {".svg", ".pdf"}) {
    std::string message;
    CHECK(code_of([&] { io::write_output(folder.file("d" + extension), made.output()); }, message) ==
          ErrorCode::unsupported);
    CHECK(contains(message, ".png"));
  }
  CHECK_NOTHROW(io::check_output("d.png", made.domain, 5));
  CHECK(folder.count() == 0);
}
