/// \file
/// Pictures of diagrams and meshes.
#pragma once

#include <powercell/shapes.hpp>
#include <string>

#include "apps/io/write/output.hpp"

namespace powercell::io {

/// Whether the file's extension is that of a picture: .svg, .png or .pdf.
bool is_picture(const std::string& path);
/// Whether files of that extension show the colours of cells: pictures, .ply, .off and .html.
bool is_coloured(const std::string& path);

/// Polygon domains: coloured cells, a disc at each seed, the outline of the domain, and a legend if colours
/// mean something; by default 1600 pixels on the long side (a page: 1200 points). In SVG each cell is a
/// `<path id="cell-i" data-seed="i">` with a title.
/// \throw Error write_failed
void write_svg(const std::string& path, const DiagramOutput& output);
void write_pdf(const std::string& path, const DiagramOutput& output);
/// Polygon domains as above; surfaces and volumes shaded in perspective, volumes opened, with their cells
/// drawn a little apart.
/// \throw Error write_failed
void write_png(const std::string& path, const DiagramOutput& output);

constexpr int usual_width_of_two = 2200;  ///< of a picture of two meshes, in pixels

/// PNG of two meshes of one surface beside each other, with their edges.
/// \param style  size and camera; each mesh has half of the width
/// \throw Error write_failed
void write_before_and_after(const std::string& path, const TriangleMesh& before, const TriangleMesh& after,
                            const PictureStyle& style);

}  // namespace powercell::io
