#include "apps/io/write/vtk_file.hpp"

#include <zlib.h>

#include <bit>
#include <powercell/error.hpp>
#include <vector>

#include "apps/io/base64.hpp"

namespace powercell::io {
namespace {

constexpr std::size_t block_size = std::size_t{1} << 20;

}  // namespace

VtkFile::VtkFile(const std::string& path, std::string_view type) : file_(path), type_(type) {
  const char* order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  file_.write("<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type_ + "\" version=\"1.0\" byte_order=\"" +
              order + "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n");
  open(type_);
}

void VtkFile::open(std::string_view element, std::string_view attributes) {
  file_.write('<');
  file_.write(element);
  if (!attributes.empty()) file_.write(' ');
  file_.write(attributes);
  file_.write(">\n");
}

void VtkFile::close(std::string_view element) {
  file_.write("</");
  file_.write(element);
  file_.write(">\n");
}

void VtkFile::empty(std::string_view element, std::string_view attributes) {
  file_.write('<');
  file_.write(element);
  file_.write(' ');
  file_.write(attributes);
  file_.write("/>\n");
}

// The format: a header of 64-bit integers (number of blocks, size of a block, size of the last block if it is
// shorter, else 0, and the compressed size of each block), then the blocks; header and blocks are separate
// base64 runs.
void VtkFile::array_bytes(std::string_view name, std::string_view type, int components,
                          std::string_view bytes) {
  // One component is the default; written out, it makes meshio read a matrix of one column.
  const std::string shape = components == 1 ? "" : "\" NumberOfComponents=\"" + std::to_string(components);
  file_.write("<DataArray type=\"" + std::string(type) + "\" Name=\"" + std::string(name) + shape +
              "\" format=\"binary\">\n");
  const std::size_t blocks = (bytes.size() + block_size - 1) / block_size;
  std::vector<std::uint64_t> header = {blocks, block_size, bytes.size() % block_size};
  std::string packed;
  std::vector<Bytef> block(compressBound(block_size));
  for (std::size_t b = 0; b < blocks; ++b) {
    const auto part = bytes.substr(b * block_size, block_size);
    uLongf size = block.size();
    if (compress2(block.data(), &size, reinterpret_cast<const Bytef*>(part.data()), part.size(), 3) != Z_OK) {
      throw Error(ErrorCode::write_failed, "zlib could not compress the array " + std::string(name));
    }
    header.push_back(size);
    packed.append(reinterpret_cast<const char*>(block.data()), size);
  }
  write_base64(file_, {reinterpret_cast<const char*>(header.data()), header.size() * sizeof(std::uint64_t)});
  write_base64(file_, packed);
  file_.write("\n</DataArray>\n");
}

void VtkFile::finish() {
  close(type_);
  close("VTKFile");
  file_.commit();
}

}  // namespace powercell::io
