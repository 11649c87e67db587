/// \file
/// The writers of geometry behind `write_output`. Each throws Error write_failed.
#pragma once

#include <string>

#include "apps/io/write/output.hpp"

namespace powercell::io {

/// VTK unstructured grid of the convex pieces of the cells, one for each region a cell meets: VTK_POLYGON on
/// polygons and surfaces, VTK_POLYHEDRON in volumes; with DiagramOutput::whole_cells of whole cells. Elements
/// share their points, so that neighbours have the same faces (shared_points.hpp, shared_cells.hpp). Cell
/// data: `seed`, `region`, `weight`, `measure` (of the whole cell), `piece_measure`, and the columns of
/// numbers of the seeds' table; of whole cells without `region` and `piece_measure`. In volumes ordered by
/// the number of vertices.
void write_vtu(const std::string& path, const DiagramOutput& output);

/// VTK polygons: the convex pieces of the cells, in volumes the faces of the joined cells. Cell data: `seed`,
/// `weight`, `measure` (of the whole cell), in volumes `neighbor` (the seed behind a wall, -1 at the domain's
/// boundary) and `facet` (of the domain, behind a face at its boundary, as Border::index; -1 for walls), and
/// the columns of numbers of the seeds' table.
void write_vtp(const std::string& path, const DiagramOutput& output);

/// Polygon soups: cells share no corners, so that other programs can move them apart. OBJ: each cell is a
/// group `cell_<seed>`.
void write_obj(const std::string& path, const DiagramOutput& output);
/// Binary; each face has the property `seed` (int) and a colour.
void write_ply(const std::string& path, const DiagramOutput& output);
/// Each face has its cell's colour; its seed follows as a comment on the line.
void write_off(const std::string& path, const DiagramOutput& output);

/// Text, of volumes: a closed solid `cell_<seed>` for each cell, its triangles counter-clockwise seen from
/// outside. Walls have the same triangles in both cells.
void write_stl(const std::string& path, const DiagramOutput& output);

/// Gmsh 4.1: see gmsh_model.hpp. Tags of cells are their seeds from 1.
void write_gmsh(const std::string& path, const DiagramOutput& output);

/// Neper's tessellation, of polygons and volumes that are not periodic: cells with their seeds, whose weights
/// are radii there; vertices, edges, faces and polyhedra; the domain with what lies in its vertices, edges
/// and facets. The `*id` of a cell is its seed from 1.
void write_tess(const std::string& path, const DiagramOutput& output);

/// `{"powercell": version, "domain": {…}, "check": {…}, "points": number of distinct points, "borders": how
/// to read them, "cells": […]}`, one cell a line, in input order. A cell has `seed`, `position`, `weight`,
/// `status`, `measure`, `centroid` (null if empty), `second_moment`, `vertices`, `points` (the number of each
/// vertex among the distinct points: cells share them, and walls), `faces` (polygon: rings, outer ones
/// counter-clockwise, holes clockwise; surface: polygons; volume: faces seen from outside; indices into
/// `vertices`) and `borders` (one for each edge of each face; in volumes one for each face). Numbers read
/// back the same. Where the cells do not fit together, which only decisions by rounding cause, "points" is
/// null and cells have none.
void write_json(const std::string& path, const DiagramOutput& output);

/// One page for a browser, which needs nothing else: it turns, slices and colours the cells, and shows the
/// row of a cell that is chosen. view/data.hpp describes what it holds. Of volumes up to most_seeds_in_view,
/// elsewhere four times as many.
/// \throw Error unsupported for more, or too many triangles
void write_html(const std::string& path, const DiagramOutput& output);
constexpr std::size_t most_seeds_in_view = 250'000;

/// A FeatureCollection with a Feature for each seed in input order: a Polygon, a MultiPolygon if the cell has
/// several parts, or null if it is empty; properties `seed`, `weight`, `status`, `measure`, after those of
/// the seeds' table (kept_columns.hpp); `id` is the seed's number, or its id if a column of ids was chosen.
/// Coordinates are those of the domain's file, and so is the member `crs`. Of a projected domain, walls have
/// vertices added so that edges that are straight on the map follow them.
void write_geojson(const std::string& path, const DiagramOutput& output);

}  // namespace powercell::io
