# Writes OUTPUT, a C++ file that defines powercell::cl::embedded_kernels() (lib/cl/program_source.hpp): the path below
# FOLDER and the text of every .cl and .h file. The text is an array of bytes, not a string literal, so that text of any
# content and length passes every compiler unchanged.
file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*.cl ${FOLDER}/*.h)
list(SORT files)
set(arrays "")
set(table "")
set(number 0)
foreach(file IN LISTS files)
  file(READ ${FOLDER}/${file} hex HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${hex}")
  string(APPEND arrays "const unsigned char text_${number}[] = {${bytes}0};  // ${file}\n")
  string(APPEND table
    "      {\"${file}\", {reinterpret_cast<const char*>(text_${number}), sizeof(text_${number}) - 1}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUTPUT} "// Generated from kernels/ by cmake/embed_kernels_run.cmake.
#include \"lib/cl/program_source.hpp\"

namespace powercell::cl {
namespace {
${arrays}}  // namespace

const SourceFiles& embedded_kernels() {
  static const SourceFiles files = {
${table}  };
  return files;
}

}  // namespace powercell::cl
")
