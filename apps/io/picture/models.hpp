/// \file
/// Models of diagrams and meshes for pictures.
#pragma once

#include <powercell/shapes.hpp>

#include "apps/io/picture/normals.hpp"
#include "apps/io/picture/render.hpp"
#include "apps/io/write/output.hpp"

namespace powercell::io {

/// The cells of a surface, smooth where the surface is; each cell is a part.
Model surface_model(const DiagramOutput& output);

/// The cells of a volume, by its style all or without those in the octant towards the camera, each drawn
/// towards its centroid. With many cells they stay where they are and only the faces in sight are kept.
Model volume_model(const DiagramOutput& output);

/// The triangles of a mesh, each a part.
Model mesh_model(const TriangleMesh& mesh, const Normalization& normalize);

}  // namespace powercell::io
