#include "lib/cl/program_build.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <regex>
#include <thread>

#include "lib/cl/program_source.hpp"
#include "tests/cl/support.hpp"

using namespace powercell;
namespace fs = std::filesystem;

namespace {

const char* const triple = "__kernel void triple(__global uint* x) { x[get_global_id(0)] *= 3; }";

/// Runs the kernel `triple` of a program on 5.
cl_uint run_triple(std::shared_ptr<const cl::Program> program) {
  auto context = test_device().context();
  cl::Buffer<cl_uint> x(context);
  x.upload(std::vector<cl_uint>{5});
  cl::Kernel(context, std::move(program), "triple").args(x).launch(1, 1);
  return x.download()[0];
}

}  // namespace

TEST_CASE("a kernel that does not build is reported with place, device, options and log") {
  const cl::SourceFiles files = {{"stage/bad.cl", "#include \"base/ok.cl\"\n\nint f() { return missing; }\n"},
                                 {"base/ok.cl", "typedef int ok;\n"}};
  auto request = test_request(cl::expand_includes(files, "stage/bad.cl"));
  request.name = "kernels/stage/bad.cl";
  const auto& context = *test_device().context();
  const auto error = error_of([&] { cl::build_program(context, request, nullptr, nullptr); });
  REQUIRE(error);
  CHECK(error->code() == ErrorCode::build_failed);
  const std::string message = error->what();
  CHECK(contains(message, "kernels/stage/bad.cl"));
  CHECK(contains(message, context.info().name));
  CHECK(contains(message, "-cl-std=CL1.2 -w -DTEST=1"));
  CHECK(contains(message, "missing"));
  // Drivers that do not heed #line tell the line of the whole source.
  CHECK(std::regex_search(message, std::regex(R"((bad\.cl|:\d+):\d+)")));
  if (contains(message, "bad.cl:")) CHECK(contains(message, "bad.cl:3"));
}

TEST_CASE("a log of any length is cut to something readable") {
  std::string source;
  for (int i = 0; i < 400; ++i) source += "int f" + std::to_string(i) + "() { return missing; }\n";
  const auto error =
      error_of([&] { cl::build_program(*test_device().context(), test_request(source), nullptr, nullptr); });
  REQUIRE(error);
  CHECK(std::string(error->what()).size() < 5000);
}

TEST_CASE("options hold the defines in order and never a blank") {
  CHECK(cl::build_options({"B=1", "A=2"}) == "-cl-std=CL1.2 -w -DB=1 -DA=2");
  for (const char* bad : {"", "A=1 -cl-fast-relaxed-math", "A=\"x\""})
    CHECK_THROWS_AS(cl::build_options({bad}), Error);
}

TEST_CASE("the cache key depends on source and options") {
  const auto& context = *test_device().context();
  auto request = test_request(triple);
  const auto key = cl::cache_key(context, request);
  CHECK(key == cl::cache_key(context, test_request(triple)));
  request.options += " -DMORE=1";
  CHECK_FALSE(key == cl::cache_key(context, request));
  std::string other = triple;
  other += ' ';
  CHECK_FALSE(key == cl::cache_key(context, test_request(other)));
}

TEST_CASE("a program comes from disk the second time, and is compiled again after damage") {
  TemporaryFolder folder;
  const cl::DiskCache cache(folder.path());
  const auto& context = *test_device().context();
  const auto request = test_request(triple);
  const auto key = cl::cache_key(context, request);
  auto build = [&] {
    cl::ProgramOrigin origin{};
    CHECK(run_triple(cl::build_program(context, request, &cache, &origin)) == 15);
    return origin;
  };
  CHECK(build() == cl::ProgramOrigin::compiled);
  CHECK(build() == cl::ProgramOrigin::disk);

  fs::resize_file(cache.path(key), fs::file_size(cache.path(key)) / 2);
  CHECK(build() == cl::ProgramOrigin::compiled);
  CHECK(build() == cl::ProgramOrigin::disk);

  // Whole on disk, but not what the driver takes.
  REQUIRE(cache.write(key, cl::Binary(500, 0x7f)));
  CHECK(build() == cl::ProgramOrigin::compiled);
  CHECK(build() == cl::ProgramOrigin::disk);
}

TEST_CASE("a cache that cannot be written does not stop a program") {
  TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "in the way";
  const cl::DiskCache cache(folder.path() / "file" / "cache");
  for (int round = 0; round < 2; ++round) {
    cl::ProgramOrigin origin{};
    CHECK(run_triple(cl::build_program(*test_device().context(), test_request(triple), &cache, &origin)) ==
          15);
    CHECK(origin == cl::ProgramOrigin::compiled);
  }
}

TEST_CASE("one context builds a program once, whoever asks") {
  Environment never("POWERCELL_CACHE", "never");  // else a later run would find it on disk
  const Device device = Device::choose(test_device().info().selector());
  auto context = device.context();
  std::vector<std::shared_ptr<const cl::Program>> programs(4);
  std::vector<std::thread> threads;
  for (auto& program : programs)
    threads.emplace_back([&] {
      program = context->program("base/self_test.cl", {"SELF_TEST_DOUBLE=0", "T=1"});
    });
  for (auto& thread : threads) thread.join();
  for (const auto& program : programs) CHECK(program == programs[0]);
  CHECK(programs[0] != context->program("base/self_test.cl", {"SELF_TEST_DOUBLE=0"}));
  const double before = device.build_seconds();
  CHECK(before > 0);
  const KernelBuilds builds = kernel_builds();
  CHECK(builds.seconds >= before);  // of all devices
  CHECK(builds.processor_seconds > 0);
  CHECK_FALSE(builds.running);
  context->program("base/self_test.cl", {"SELF_TEST_DOUBLE=0", "T=1"});
  CHECK(device.build_seconds() == before);
  CHECK(kernel_builds().seconds == builds.seconds);
  CHECK_THROWS_AS(context->program("base/nowhere.cl", {}), Error);
}

TEST_CASE("whether the disk is used follows driver and environment") {
  const auto& context = *test_device().context();
  Environment always("POWERCELL_CACHE", "always");
  CHECK(cl::uses_disk_cache(context));
  Environment never("POWERCELL_CACHE", "never");
  CHECK_FALSE(cl::uses_disk_cache(context));
  Environment unset("POWERCELL_CACHE", "");
  CHECK(cl::uses_disk_cache(context) == (context.info().platform_name != "Portable Computing Language"));
}

TEST_CASE("child: fill the cache" * doctest::skip()) {
  CHECK(Device::choose().info().selector() == test_device().info().selector());
}

TEST_CASE("two processes that fill one cache at once both work, and leave whole entries") {
  TemporaryFolder folder;
  Environment place("POWERCELL_CACHE_DIR", folder.path().string()), always("POWERCELL_CACHE", "always");
  const std::string child = child_command("child: fill the cache");
  CHECK(std::system((child + " & first=$!; " + child + " && wait $first").c_str()) == 0);
  std::size_t entries = 0;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    CHECK(entry.path().extension() == ".clbin");
    ++entries;
  }
  CHECK(entries == 1);
  CHECK(Device::choose().build_seconds() < 0.5);
}
