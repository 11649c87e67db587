/// \file
/// What the tool writes of a diagram, and the one door to every format.
#pragma once

#include <powercell/domain.hpp>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>
#include <string>
#include <string_view>

namespace powercell::io {

/// A computed diagram as the writers see it; nothing is owned. n seeds in every part.
struct DiagramOutput {
  const Domain& domain;
  SeedsView seeds;
  const Measures& measures;
  const Cells& cells;
  const JoinedCells& joined;
  const Adjacency& adjacency;
  /// Whether flat pictures show a weight as the disc of radius sqrt(w). Not where only the differences of
  /// weights mean something, as of those that were solved for.
  bool weights_as_discs = true;
};

/// Extensions that `write_output` knows, for messages: ".svg .png ...".
std::string_view known_outputs();
/// Whether `write_output` knows the extension of `path` (upper or lower case).
bool known_output(const std::string& path);
/// \throw Error invalid_file if it does not
void check_output_format(const std::string& path);
/// Refuses, before anything is computed, what `write_output` would refuse for this kind of domain.
/// \throw Error invalid_file (unknown extension), unsupported (a flat format for a surface or volume)
void check_output(const std::string& path, DomainKind kind);

/// Writes a picture (.svg .png .pdf), geometry (.vtu .vtp .obj .ply .off, .geojson) or everything (.json), by
/// the extension of `path`.
/// \throw Error as check_output; write_failed
void write_output(const std::string& path, const DiagramOutput& output);

}  // namespace powercell::io
