// powercell demo: six pictures of what the tool does, and a page that shows them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <future>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "apps/common.hpp"
#include "apps/demo/compiling.hpp"
#include "apps/demo/data.hpp"
#include "apps/demo/page.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/atomic_file.hpp"
#include "apps/progress.hpp"
#include "apps/report.hpp"

namespace powercell::app {
namespace {

namespace fs = std::filesystem;

struct DemoArguments : CommonOptions {
  std::string folder = "powercell-demo";
};

constexpr const char* drawing = "drawing";

/// The pictures in the order of the page. Those of a track are drawn by one thread, one after the other. Two
/// tracks have a device each, since PoCL compiles one kernel at a time for a device that is opened once;
/// their kernels differ.
struct Plan {
  DrawPart draw;
  std::size_t track;
};
constexpr Plan plans[] = {{draw_map, 0},     {draw_surface, 1},  {draw_volume, 1},
                          {draw_treemap, 2}, {draw_stipples, 0}, {draw_mesh, 2}};
constexpr std::size_t tracks = 3, tracks_with_device = 2;
constexpr std::size_t programs_of_all = 13;  // to compile, with empty caches

void write_text(const fs::path& path, std::string_view text) {
  io::AtomicFile file(path.string());
  file.write(text);
  file.commit();
}

void make_folder(const std::string& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem || !fs::is_directory(folder))
    throw Error(ErrorCode::write_failed,
                fmt::format("the folder '{}' cannot be created: {}; choose another one with -o", folder,
                            problem ? problem.message() : "a file of that name exists"));
}

/// The width and height that a PNG file says.
std::pair<int, int> png_size(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  unsigned char head[24] = {};
  const bool read = file && std::fread(head, 1, sizeof head, file) == sizeof head;
  if (file) std::fclose(file);
  if (!read) throw Error(ErrorCode::write_failed, path + " was written and cannot be read; try again");
  const auto number = [&](std::size_t at) {
    return head[at] << 24 | head[at + 1] << 16 | head[at + 2] << 8 | head[at + 3];
  };
  return {number(16), number(20)};
}

/// Draws all pictures.
class Demo {
 public:
  Demo(const DemoArguments& arguments, Progress& progress)
      : arguments_(arguments), progress_(progress), parts_(std::size(plans)) {}

  std::vector<DemoPart> draw(const Device& device) {
    std::vector<std::future<void>> running;
    for (std::size_t track = 0; track < tracks; ++track)
      running.push_back(std::async(std::launch::async, [this, track, &device] {
        try {
          run(track, device);
        } catch (...) {
          failed_ = true;  // the others end with the picture that they draw
          throw;
        }
      }));
    for (std::future<void>& one : running) one.wait();
    for (std::future<void>& one : running) one.get();
    return std::move(parts_);
  }

 private:
  void run(std::size_t track, const Device& device) {
    std::optional<Device> own;
    if (track > 0 && track < tracks_with_device) own = open_device(arguments_);
    const Device* used = own ? &*own : track == 0 ? &device : nullptr;
    for (std::size_t k = 0; k < std::size(plans); ++k) {
      if (plans[k].track != track || failed_) continue;
      stop_if_interrupted();
      Stopwatch watch;
      const double compiled = used ? used->build_seconds() : 0;
      DemoPart part = plans[k].draw({arguments_.folder, arguments_}, used);
      part.seconds = std::max(0.0, watch.lap() - (used ? used->build_seconds() - compiled : 0));
      std::tie(part.width, part.height) = png_size(part.files.front());
      finish(k, std::move(part));
    }
  }

  void finish(std::size_t k, DemoPart part) {
    const std::scoped_lock lock(mutex_);
    ++done_;
    progress_.at(static_cast<double>(done_) / static_cast<double>(parts_.size()));
    progress_.count(static_cast<double>(parts_.size()), "pictures");
    if (!arguments_.silent())
      progress_.aside([&] {
        fmt::print("{:<8}  {}: {}; {:.1f} s\n", part.name, part.title, part.line, part.seconds);
        std::fflush(stdout);
      });
    parts_[k] = std::move(part);
  }

  const DemoArguments& arguments_;
  Progress& progress_;
  std::mutex mutex_;
  std::vector<DemoPart> parts_;
  std::size_t done_ = 0;
  std::atomic<bool> failed_{false};
};

/// Where this repository's documents are, seen from the folder, if it is in a clone.
void find_documents(const fs::path& folder, DemoRun& run) {
  std::error_code ignored;
  for (const char* up : {"../", "../../"})
    if (fs::exists(folder / up / "docs" / "guide.md", ignored) &&
        fs::exists(folder / up / "docs" / "applications.md", ignored)) {
      run.repository = up;
      run.has_documents = true;
      return;
    }
}

nlohmann::json as_json(const std::vector<DemoPart>& parts) {
  nlohmann::json pictures = nlohmann::json::array();
  for (const DemoPart& part : parts)
    pictures.push_back({{"name", part.name},
                        {"picture", part.files.front()},
                        {"files", part.files},
                        {"command", part.command},
                        {"seconds", part.seconds},
                        {"report", part.report}});
  return pictures;
}

int run(const DemoArguments& arguments) {
  Progress progress({{stage::opening, 3}, {drawing, 97}}, arguments.silent());
  make_folder(arguments.folder);
  const fs::path folder = arguments.folder, page = folder / "index.html";
  for (const DemoFile& file : demo_files()) write_text(folder / file.name, file.text);
  const Device device = open_device(arguments);
  const DeviceInfo& info = device.info();
  if (!arguments.silent())
    progress.aside([&] { fmt::print("device {} ({})\n", info.name, info.platform_name); });
  progress.begin(drawing);
  std::vector<DemoPart> parts;
  std::size_t programs = 0;
  {
    const Compiling compiling(progress, info.name, programs_of_all, arguments.silent());
    parts = Demo(arguments, progress).draw(device);
    programs = compiling.programs();
  }
  DemoRun run{info.name, info.platform_name, progress.run(), progress.build(), {}, false};
  find_documents(folder, run);
  write_text(page, demo_page(parts, run));
  progress.finish();
  if (arguments.json)
    fmt::print("{}\n", json_text({{"pictures", as_json(parts)},
                                  {"open", page.string()},
                                  {"device", info.name},
                                  {"programs", programs},
                                  {"build", progress.build()},
                                  {"seconds", progress.run()},
                                  {"version", version()}}));
  else if (!arguments.quiet)
    fmt::print(
        "{:.1f} s in all{}\nOpen {}\n", progress.run(),
        progress.build() > noticeable_build ? ", kernels were compiled meanwhile, once for this device" : "",
        page.string());
  return 0;
}

}  // namespace

Command add_demo(CLI::App& app) {
  auto arguments = std::make_shared<DemoArguments>();
  CLI::App* command =
      app.add_subcommand("demo", "Draw six pictures of what the tool does, and a page of them");
  command->add_option("-o,--output", arguments->folder, "Folder to write into")
      ->type_name("FOLDER")
      ->capture_default_str();
  add_common_options(*command, *arguments);
  command->footer("Examples:\n  powercell demo\n  powercell demo -o /tmp/pictures --device gpu");
  return [arguments] { return run(*arguments); };
}

}  // namespace powercell::app
