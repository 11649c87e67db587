# Writes OUTPUT, a C++ file that defines powercell::cl::embedded_kernels(): pairs of path and text.
file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*.cl ${FOLDER}/*.h)
list(SORT files)
set(body "")
foreach(file IN LISTS files)
  file(READ ${FOLDER}/${file} hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
  string(APPEND body "    {\"${file}\", {")
  string(MAKE_C_IDENTIFIER "${file}" identifier)
  string(APPEND arrays "const unsigned char ${identifier}[] = {${bytes}0};\n")
  set(body "${body}reinterpret_cast<const char*>(${identifier}), sizeof(${identifier}) - 1}},\n")
endforeach()
file(WRITE ${OUTPUT} "// Generated from kernels/ by cmake/embed_kernels_run.cmake.
#include <string_view>
#include <utility>
#include <vector>
namespace powercell::cl {
namespace {
${arrays}}  // namespace
const std::vector<std::pair<std::string_view, std::string_view>>& embedded_kernels();
const std::vector<std::pair<std::string_view, std::string_view>>& embedded_kernels() {
  static const std::vector<std::pair<std::string_view, std::string_view>> kernels = {
${body}  };
  return kernels;
}
}  // namespace powercell::cl
")
