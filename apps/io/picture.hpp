/// \file
/// Pictures of diagrams.
#pragma once

#include <string>

#include "apps/io/output.hpp"

namespace powercell::io {

/// Polygon domains: coloured cells, a disc a seed, the outline of the domain; 1600 px on the long
/// side. In SVG each cell is a `<path id="cell-i" data-seed="i">` with a title. \throw Error write_failed
void write_svg(const std::string& path, const DiagramOutput& output);
void write_pdf(const std::string& path, const DiagramOutput& output);
/// Polygon domains as above; surfaces shaded in perspective with their walls; volumes cut open, their
/// cells drawn a little apart. \throw Error write_failed
void write_png(const std::string& path, const DiagramOutput& output);

}  // namespace powercell::io
