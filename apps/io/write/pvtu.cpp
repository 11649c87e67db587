#include "apps/io/write/pvtu.hpp"

#include <filesystem>
#include <powercell/error.hpp>
#include <system_error>

#include "apps/io/printable.hpp"
#include "apps/io/write/formats.hpp"
#include "apps/io/write/output.hpp"
#include "apps/io/write/vtk_file.hpp"

namespace powercell::io {
namespace {

namespace fs = std::filesystem;

/// From the folder of the .pvtu, which names pieces so.
std::string piece_path(const std::string& path, int number) {
  const std::string stem = fs::path(path).stem().string();
  return stem + "/" + stem + "_" + std::to_string(number) + ".vtu";
}

}  // namespace

void write_vtu_piece(const std::string& path, const VtuPiece& piece) {
  const fs::path file = fs::path(path).parent_path() / piece_path(path, piece.number);
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) throw Error(ErrorCode::write_failed, file.parent_path().string() + ": " + error.message());
  piece.diagram.compute(true, true);
  DiagramOutput output{
      piece.diagram.domain(),   {piece.diagram.domain().dimension(), piece.positions, piece.weights},
      piece.diagram.measures(), piece.diagram.cells(),
      piece.diagram.joined(),   piece.diagram.adjacency()};
  output.rows = SelectedRows{piece.seeds, piece.ids};
  write_vtu(file.string(), output);
}

void write_pvtu(const std::string& path, int pieces) {
  VtkFile file(path, "PUnstructuredGrid");
  file.open("PPoints");
  file.empty("PDataArray", "type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"");
  file.close("PPoints");
  file.open("PCellData", "Scalars=\"seed\"");
  file.empty("PDataArray", "type=\"Int64\" Name=\"seed\"");
  file.empty("PDataArray", "type=\"UInt32\" Name=\"region\"");
  for (const char* name : {"weight", "measure", "piece_measure"})
    file.empty("PDataArray", std::string("type=\"Float64\" Name=\"") + name + "\"");
  file.close("PCellData");
  for (int k = 0; k < pieces; ++k) file.empty("Piece", "Source=\"" + xml_text(piece_path(path, k)) + "\"");
  file.finish();
}

}  // namespace powercell::io
