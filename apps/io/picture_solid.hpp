/// \file
/// Pictures of surfaces and volumes in perspective.
#pragma once

#include <string>

#include "apps/io/output.hpp"
#include "apps/io/picture_render.hpp"

namespace powercell::io {

/// The cells of a surface, smooth where the surface is, with their walls as lines.
Model surface_model(const DiagramOutput& output);
/// The cells of a volume without the octant towards the camera, each drawn towards its centroid. With
/// many cells they stay where they are and only the faces in sight are kept.
Model volume_model(const DiagramOutput& output);

/// Render and write as PNG. \throw Error write_failed
void draw_surface(const std::string& path, const DiagramOutput& output);
void draw_volume(const std::string& path, const DiagramOutput& output);

}  // namespace powercell::io
