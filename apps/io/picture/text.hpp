/// \file
/// Text in pictures.
#pragma once

#include <string>

using cairo_t = struct _cairo;  // NOLINT(bugprone-reserved-identifier): Cairo's name

namespace powercell::io {

/// Of SVG, as CSS; the first is the font of the other formats.
inline constexpr const char* font_families = "'DejaVu Sans',Verdana,sans-serif";

/// \param size  of an em, pixels
void select_font(cairo_t* to, bool bold, double size);

/// Width of a text of one em in the pictures' font.
double text_width(const std::string& text, bool bold);

/// The text, or its beginning with an ellipsis, at most `most` ems wide.
/// \pre valid UTF-8
std::string shortened(const std::string& text, double most, bool bold);

/// Draws a text whose middle line is at y, or adds its outline to the path.
/// \param share  of its width that lies left of x
void show_text(cairo_t* to, const std::string& text, double x, double y, double share);
void add_text_path(cairo_t* to, const std::string& text, double x, double y, double share);

}  // namespace powercell::io
