/// \file
/// The fuzz targets: each takes any bytes, calls the library or a reader with what they say, and checks
/// what must hold. It returns where all is well, and throws Finding, or is stopped by a sanitizer, where not.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

namespace powercell::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// What a target found wrong.
struct Finding : std::logic_error {
  using std::logic_error::logic_error;
};

inline void require(bool condition, const std::string& what) {
  if (!condition) throw Finding(what);
}

// Readers of files (files.cpp). The first byte chooses the format, the rest is the file.
void meshes(Bytes input);    ///< .off .obj .ply .stl .mesh .msh .tet .txt
void grids(Bytes input);     ///< .vtk .vtu
void polygons(Bytes input);  ///< .geojson .wkt .svg
void seeds(Bytes input);     ///< text, .npy, random:
void trees(
    Bytes input);  ///< tables, JSON and earlier layouts of treemaps; small ones are laid out (documents.cpp)
void documents(Bytes input);  ///< masses, saved diagrams, records of benchmarks, PNG, JPEG (documents.cpp)

// Public entry points. The bytes are numbers and choices, see input.hpp.
void domains(Bytes input);      ///< Domain::polygon, surface, volume, box (domains.cpp)
void diagrams(Bytes input);     ///< Diagram in any order of calls, join, verify (diagrams.cpp)
void c_interface(Bytes input);  ///< powercell.h, null pointers and short arrays included (c_interface.cpp)
void device_diagrams(Bytes input);  ///< DeviceDiagram, against Diagram (device_diagrams.cpp)
void triangulations(Bytes input);   ///< regular_triangulation (triangulations.cpp)
void treemaps(Bytes input);         ///< treemap, relative_positions (treemaps.cpp)
void transports(Bytes input);       ///< TransportSolver in any order of calls, integrate (transports.cpp)
void samplings(Bytes input);        ///< sample, spacing, spectrum, random_points (samplings.cpp)
void remeshings(Bytes input);       ///< remesh, mesh_quality, farthest_from (remeshings.cpp)

struct Target {
  const char* name;
  void (*run)(Bytes);
};
inline constexpr Target kTargets[] = {{"meshes", meshes},
                                      {"grids", grids},
                                      {"polygons", polygons},
                                      {"seeds", seeds},
                                      {"trees", trees},
                                      {"documents", documents},
                                      {"domains", domains},
                                      {"diagrams", diagrams},
                                      {"c_interface", c_interface},
                                      {"device_diagrams", device_diagrams},
                                      {"triangulations", triangulations},
                                      {"treemaps", treemaps},
                                      {"transports", transports},
                                      {"samplings", samplings},
                                      {"remeshings", remeshings}};

}  // namespace powercell::fuzz
