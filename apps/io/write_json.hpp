/// \file
/// A diagram as one JSON object.
#pragma once

#include <string>

#include "apps/io/output.hpp"

namespace powercell::io {

/// `{"powercell": version, "domain": {…}, "check": {…}, "borders": how to read them, "cells": […]}`,
/// one cell a line, in input order. A cell has `seed`, `position`, `weight`, `status`, `measure`,
/// `centroid` (null where empty), `second_moment`, `vertices`, `faces` (polygon: rings, outer ones
/// counter-clockwise, holes clockwise; surface: polygons; volume: faces seen from outside; indices
/// into `vertices`) and `borders` (one for each edge of each face; in volumes one for each face).
/// Numbers read back the same. \throw Error write_failed
void write_json(const std::string& path, const DiagramOutput& output);

}  // namespace powercell::io
