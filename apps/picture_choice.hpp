/// \file
/// The options on pictures: --camera, --up, --size, --no-cut, --color-by and --no-legend.
#pragma once

#include <powercell/domain.hpp>
#include <string>
#include <vector>

#include "apps/io/picture/style.hpp"
#include "apps/io/picture/vector.hpp"

namespace CLI {
class App;
}

namespace powercell::app {

struct SizeArguments {
  std::string size;
};

struct CameraArguments : SizeArguments {
  std::string camera, up;
};

struct PictureArguments : CameraArguments {
  std::string color_by;
  bool no_cut = false, no_legend = false;
};

/// Adds --size.
/// \param usual  pixels without it
void add_size_option(CLI::App& command, SizeArguments& arguments, int usual = 1600);
/// Adds --size, --camera and --up.
void add_camera_options(CLI::App& command, CameraArguments& arguments, int usual = 1600);
/// Adds them all.
/// \param files  the option whose files they are for, as the help names it
void add_picture_options(CLI::App& command, PictureArguments& arguments, const std::string& files);

/// What a diagram is drawn from.
struct DrawnInputs {
  const std::vector<std::string>& files;  ///< to be written
  DomainKind kind;
  io::InputView inputs;
  const SeedsView& seeds;
};

/// To be called before a long computation.
/// \throw WrongUsage for options without a picture, and for those that this kind of domain has no use for;
/// Error invalid_argument as io::colour_by
io::PictureStyle picture_style(const PictureArguments& arguments, const DrawnInputs& drawn);

/// \throw WrongUsage for a camera along --up
void set_camera(const CameraArguments& arguments, io::Vec3& towards, io::Vec3& up);
/// Of --size, if it is given.
io::PictureSize picture_size(const SizeArguments& arguments, const io::PictureSize& otherwise = {});

}  // namespace powercell::app
