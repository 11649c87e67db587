// Files that announce far more than they contain are refused by name, before memory is allocated for it.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <zlib.h>

#include "apps/io/read/domain.hpp"
#include "apps/io/read/image.hpp"
#include "apps/io/tables/read_seeds.hpp"
#include "apps/io/tables/read_tree.hpp"
#include "tests/readers/fixtures.hpp"

using namespace powercell;
using namespace powercell::io;
using namespace powercell::io::test;

namespace {

long most_memory_kib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

struct Claim {
  const char* extension;
  std::string before, after;  // around the count
};

template <class Number>
std::string bytes_of(Number value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

const std::string triangle = "0 0 0\n1 0 0\n0 1 0\n";
const std::string ply = "ply\nformat ascii 1.0\nelement vertex ";
const std::string properties = "\nproperty float x\nproperty float y\nproperty float z\n";
const std::string vtk = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n";
const std::string vtk_points = vtk + "POINTS 3 double\n" + triangle;
const std::string msh2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n";
const std::string msh4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n";

const Claim claims[] = {
    {".off", "OFF\n", " 1 0\n" + triangle},
    {".off", "OFF\n3 ", " 0\n" + triangle + "3 0 1 2\n"},
    {".off", "OFF\n3 1 0\n" + triangle, " 0 1 2\n"},
    {".ply", ply, properties + "end_header\n" + triangle},
    {".ply", ply + "3" + properties + "element face ",
     "\nproperty list uchar int vertex_indices\nend_header\n" + triangle + "3 0 1 2\n"},
    {".ply",
     ply + "3" + properties + "element face 1\nproperty list uint int vertex_indices\nend_header\n" +
         triangle,
     " 0 1 2\n"},
    {".mesh", "MeshVersionFormatted 2\nDimension 3\nVertices ", "\n0 0 0 0\n"},
    {".mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 1\n0 0 0 0\nTetrahedra ", "\n1 1 1 1 0\n"},
    {".mesh", "MeshVersionFormatted 2\nDimension 3\nVertices 1\n0 0 0 0\nEdges ", "\n1 1 0\n"},
    {".msh", msh2, "\n1 0 0 0\n$EndNodes\n"},
    {".msh", msh2 + "1\n1 0 0 0\n$EndNodes\n$Elements\n", "\n1 4 2 0 1 1 1 1 1\n$EndElements\n"},
    {".msh", msh4 + "1 ", " 1 1\n3 1 0 1\n1\n0 0 0\n$EndNodes\n"},
    {".msh", msh4, " 1 1 1\n3 1 0 1\n1\n0 0 0\n$EndNodes\n"},
    {".vtk", vtk + "POINTS ", " double\n0 0 0\n"},
    {".vtk", vtk_points + "CELLS ", " 4\n3 0 1 2\n"},
    {".vtk", vtk_points + "CELLS 1 ", "\n3 0 1 2\n"},
    {".vtk", vtk_points + "CELLS 1 4\n", " 0 1 2\n"},
    {".vtk", vtk_points + "CELLS 1 4\n3 0 1 2\nCELL_TYPES ", "\n5\n"},
    {".vtk", vtk_points + "FIELD f ", "\na 1 1 double\n0\n"},
    {".vtk", vtk_points + "FIELD f 1\na ", " 4 double\n0\n"},
    {".vtu", "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"",
     "\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 "
     "0 0"
     "</DataArray></Points></Piece></UnstructuredGrid></VTKFile>"},
    {".tet", "", " 1\n" + triangle + "0 0 1\n0 1 2 3\n"},
    {".tet", "4 ", "\n" + triangle + "0 0 1\n0 1 2 3\n"},
    {".txt", "", " 1\n0 0\n1 0\n0 1\n0 1 2\n"},
    {".txt", "3 ", "\n0 0\n1 0\n0 1\n0 1 2\n"},
};

const char* const counts[] = {"2147483648",
                              "4294967296",
                              "4294967299",
                              "1099511627776",
                              "9223372036854775807",
                              "18446744073709551615",
                              "99999999999999999999999"};

void check_refused(const std::string& text, const std::string& extension) {
  CAPTURE(text);
  const std::string message = refusal([&] { parse_domain(text, extension, std::nullopt, "f"); });
  CHECK_MESSAGE(says(message, "invalid_file: f"), message);
}

}  // namespace

TEST_CASE("text files that announce more than they contain") {
  const long before = most_memory_kib();
  for (const Claim& claim : claims)
    for (const char* count : counts) check_refused(claim.before + count + claim.after, claim.extension);
  CHECK(most_memory_kib() - before < 64 * 1024);
}

TEST_CASE("binary files that announce more than they contain") {
  const long before = most_memory_kib();
  const std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex 3" + properties +
                          "element face 1\nproperty list uint int vertex_indices\nend_header\n" +
                          std::string(36, '\0');
  for (const std::uint32_t count : {0x80000000u, 0xffffffffu, 1000u}) {
    check_refused(ply + bytes_of(count) + bytes_of(0), ".ply");
    check_refused(std::string(80, ' ') + bytes_of(count) + std::string(50, '\0'), ".stl");
  }
  for (const std::uint64_t count : {std::uint64_t{1} << 40, ~std::uint64_t{0}, std::uint64_t{1} << 61}) {
    std::string msh = "$MeshFormat\n4.1 1 8\n" + bytes_of(1) + "\n$EndMeshFormat\n$Nodes\n";
    for (const std::uint64_t number : {std::uint64_t{1}, count, std::uint64_t{1}, count})
      msh += bytes_of(number);
    msh +=
        bytes_of(3) + bytes_of(1) + bytes_of(0) + bytes_of(count) + std::string(64, '\0') + "\n$EndNodes\n";
    check_refused(msh, ".msh");
    // Raw appended data with a header that announces the number of bytes.
    check_refused(
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\"><UnstructuredGrid>"
        "<Piece NumberOfPoints=\"1\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" "
        "NumberOfComponents=\"3\" format=\"appended\" "
        "offset=\"0\"/></Points><Cells/></Piece></UnstructuredGrid>"
        "<AppendedData encoding=\"raw\">_" +
            bytes_of(count) + std::string(24, '\0') + "</AppendedData></VTKFile>",
        ".vtu");
    // Compressed: number of blocks, their size, the size of the last, the compressed size of each.
    check_refused(
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
        "compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid><Piece NumberOfPoints=\"1\" "
        "NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
        "format=\"appended\" offset=\"0\"/></Points><Cells/></Piece></UnstructuredGrid>"
        "<AppendedData encoding=\"raw\">_" +
            bytes_of(count) + bytes_of(count) + bytes_of(count) + bytes_of(count) + std::string(24, '\0') +
            "</AppendedData></VTKFile>",
        ".vtu");
    check_refused(
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
        "compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid><Piece NumberOfPoints=\"1\" "
        "NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
        "format=\"appended\" offset=\"0\"/></Points><Cells/></Piece></UnstructuredGrid>"
        "<AppendedData encoding=\"raw\">_" +
            bytes_of(std::uint64_t{1}) + bytes_of(count) + bytes_of(count) + bytes_of(std::uint64_t{8}) +
            std::string(24, '\0') + "</AppendedData></VTKFile>",
        ".vtu");
  }
  CHECK(most_memory_kib() - before < 64 * 1024);
}

TEST_CASE("tables of seeds that announce more than they contain") {
  const long before = most_memory_kib();
  for (const char* count : counts) {
    CAPTURE(count);
    CHECK(says(refusal([&] { parse_seeds_text(std::string(count) + "\n0 0\n1 1\n", 2, "f"); }),
               "invalid_file"));
    for (const std::string& shape : {std::string("(") + count + ", 2)", std::string("(2, ") + count + ")"}) {
      std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }\n";
      const auto length = static_cast<std::uint16_t>(header.size());
      const std::string npy =
          std::string("\x93NUMPY\x01\x00", 8) + bytes_of(length) + header + std::string(32, '\0');
      CHECK(says(refusal([&] { parse_seeds_npy(npy, 2, "f"); }), "invalid_file"));
    }
  }
  CHECK(most_memory_kib() - before < 64 * 1024);
}

TEST_CASE("pictures with more pixels than deflate can pack into their size") {
  const auto big_endian = [](unsigned value) {
    return std::string{static_cast<char>(value >> 24), static_cast<char>(value >> 16 & 255),
                       static_cast<char>(value >> 8 & 255), static_cast<char>(value & 255)};
  };
  const auto chunk = [&](const std::string& kind_and_data) {
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(kind_and_data.data()),
                           static_cast<uInt>(kind_and_data.size()));
    return big_endian(static_cast<unsigned>(kind_and_data.size()) - 4) + kind_and_data +
           big_endian(static_cast<unsigned>(sum));
  };
  const long before = most_memory_kib();
  const std::string png =
      "\x89PNG\r\n\x1a\n" +
      chunk("IHDR" + big_endian(16384) + big_endian(16384) + std::string("\x08\0\0\0\0", 5)) +
      chunk("IDAT" + std::string(20, '\0')) + chunk("IEND");
  CHECK(says(refusal([&] { parse_image(png, "f"); }), "bytes cannot hold 16384 x 16384 pixels"));
  CHECK(most_memory_kib() - before < 64 * 1024);
}

TEST_CASE("trees nested so deeply that the paths of their nodes would fill the memory") {
  const long before = most_memory_kib();
  std::string deep;
  for (int level = 0; level < 50000; ++level) deep += "{\"children\":[";
  CHECK(says(refusal([&] {
               std::string ends;
               for (int level = 0; level < 50000; ++level) ends += "]}";
               parse_tree(deep + "{}" + ends, ".json", "f");
             }),
             "nested so deeply"));
  CHECK(most_memory_kib() - before < 2048 * 1024);
  CHECK(says(refusal([&] { parse_tree("{\"value\":1e999}", ".json", "f"); }), "beyond the range of doubles"));
}
