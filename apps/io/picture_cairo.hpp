/// \file
/// Pixels and pages through cairo.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/io/picture_scene.hpp"

namespace powercell::io {

/// Draws a flat picture as PNG or PDF. \throw Error write_failed
void draw_png(const std::string& path, const Scene& scene);
void draw_pdf(const std::string& path, const Scene& scene);

/// Writes pixels as PNG. \param rgb height x width x 3, row-major, from the top. \throw Error write_failed
void write_pixels(const std::string& path, const std::vector<std::uint8_t>& rgb, int width, int height);

}  // namespace powercell::io
