#include "lib/cl/program_source.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

#include "tests/cl/support.hpp"

using namespace powercell;

TEST_CASE("the embedded kernels are the files, byte by byte") {
  const std::filesystem::path folder = std::filesystem::path(POWERCELL_SOURCE_FOLDER) / "kernels";
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    files += entry.path().extension() == ".cl" || entry.path().extension() == ".h";
  CHECK(cl::embedded_kernels().size() == files);
  for (const auto& [path, text] : cl::embedded_kernels()) {
    const std::string name(path);
    CAPTURE(name);
    std::ifstream file(folder / path, std::ios::binary);
    const std::string on_disk{std::istreambuf_iterator<char>(file), {}};
    CHECK_FALSE(on_disk.empty());
    CHECK(on_disk == text);
  }
}

TEST_CASE("each file is put in once, with the lines it came from") {
  const cl::SourceFiles files = {
      {"a.cl", "#include \"base/b.cl\"\n  #  include \"base/c.cl\" // twice\nint a;\n"},
      {"base/b.cl", "int b;\n#include \"base/c.cl\"\nint after_c;"},
      {"base/c.cl", "#include \"a.cl\"\nint c;\n"},  // a circle
  };
  CHECK(cl::expand_includes(files, "a.cl") ==
        "#line 1 \"kernels/a.cl\"\n"
        "#line 1 \"kernels/base/b.cl\"\n"
        "int b;\n"
        "#line 1 \"kernels/base/c.cl\"\n"
        "#line 2 \"kernels/base/c.cl\"\n"
        "int c;\n"
        "#line 3 \"kernels/base/b.cl\"\n"
        "int after_c;\n"
        "#line 2 \"kernels/a.cl\"\n"
        "#line 3 \"kernels/a.cl\"\n"
        "int a;\n");
}

TEST_CASE("other lines are left alone") {
  const std::string text = "// #include \"b.cl\"\n#define include \"b.cl\"\n#includes\n\n\"#include\"\n";
  const cl::SourceFiles files = {{"a.cl", text}};
  CHECK(cl::expand_includes(files, "a.cl") == "#line 1 \"kernels/a.cl\"\n" + text);
}

TEST_CASE("an include that does not exist is named with its file and line") {
  const cl::SourceFiles files = {{"a.cl", "\n\n#include \"nowhere.cl\"\n"}};
  const auto error = error_of([&] { cl::expand_includes(files, "a.cl"); });
  REQUIRE(error);
  CHECK(error->code() == ErrorCode::internal);
  CHECK(contains(error->what(), "kernels/a.cl:3: "));
  CHECK(contains(error->what(), "\"nowhere.cl\""));
}
