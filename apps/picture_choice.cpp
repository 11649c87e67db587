#include "apps/picture_choice.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "apps/common.hpp"
#include "apps/io/names.hpp"
#include "apps/io/picture/picture.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::app {
namespace {

constexpr int least_size = 16, most_size = 10'000, least_with_legend = 200;
constexpr const char* picture_group = "Pictures";

using UnitVector = std::array<double, 3>;

struct NamedView {
  std::string_view name;
  UnitVector towards;
};
// Upwards is z, as in the pictures; looking along z, it is y.
constexpr std::array<NamedView, 7> named_views = {{{"front", {0, -1, 0}},
                                                   {"back", {0, 1, 0}},
                                                   {"left", {-1, 0, 0}},
                                                   {"right", {1, 0, 0}},
                                                   {"top", {0, 0, 1}},
                                                   {"bottom", {0, 0, -1}},
                                                   {"iso", {1, -1, 1}}}};

/// Three numbers, not all 0, as a vector of length 1.
/// \param fault  output, if it is none
std::optional<UnitVector> read_direction(const std::string& text, std::string& fault) {
  const std::vector<std::string_view> parts = io::split(text, ',');
  UnitVector axes{};
  bool good = parts.size() == 3;
  for (std::size_t k = 0; k < 3 && good; ++k) good = io::parse_number(parts[k], axes[k]) == io::Parsed::ok;
  if (!good) {
    fault = fmt::format("'{}' is not a direction X,Y,Z such as 1,-2,0.5", io::readable(text));
    return std::nullopt;
  }
  const double largest = std::max({std::abs(axes[0]), std::abs(axes[1]), std::abs(axes[2])});
  if (largest == 0) {
    fault = fmt::format("{} is no direction: all three numbers are 0", io::readable(text));
    return std::nullopt;
  }
  for (double& axis : axes) axis /= largest;
  const double length = std::hypot(axes[0], axes[1], axes[2]);
  for (double& axis : axes) axis /= length;
  return axes;
}

std::optional<UnitVector> read_camera(const std::string& text, std::string& fault) {
  const auto named = std::find_if(named_views.begin(), named_views.end(),
                                  [&](const NamedView& view) { return view.name == text; });
  if (named != named_views.end()) {
    const double length = std::hypot(named->towards[0], named->towards[1], named->towards[2]);
    return UnitVector{named->towards[0] / length, named->towards[1] / length, named->towards[2] / length};
  }
  std::optional<UnitVector> axes = read_direction(text, fault);
  if (!axes && text.find(',') == std::string::npos)
    fault = fmt::format("'{}' is neither X,Y,Z nor front, back, left, right, top, bottom or iso",
                        io::readable(text));
  return axes;
}

std::optional<io::PictureSize> read_size(const std::string& text, std::string& fault) {
  const std::vector<std::string_view> parts = io::split(text, ':');
  std::array<int, 2> sides{0, 0};
  bool good = parts.size() <= 2;
  for (std::size_t k = 0; k < parts.size() && good; ++k) {
    double side = 0;
    good = io::parse_number(parts[k], side) == io::Parsed::ok && side == std::floor(side);
    if (!good) break;
    if (side < least_size || side > most_size) {
      fault = fmt::format("{} is not from {} to {}", parts[k], least_size, most_size);
      return std::nullopt;
    }
    sides[k] = static_cast<int>(side);
  }
  if (!good) {
    fault = fmt::format("'{}' is neither a whole number of pixels nor W:H", io::readable(text));
    return std::nullopt;
  }
  return io::PictureSize{sides[0], sides[1], true};
}

/// A check for CLI11.
/// \param read  one of the functions above
template <class Read>
std::function<std::string(const std::string&)> fault_of(Read read) {
  return [read](const std::string& text) {
    std::string fault;
    read(text, fault);
    return fault;
  };
}

io::Vec3 vector_of(const UnitVector& axes) {
  return {static_cast<float>(axes[0]), static_cast<float>(axes[1]), static_cast<float>(axes[2])};
}

/// Options that would have no effect.
void check_effects(const PictureArguments& arguments, const DrawnInputs& drawn) {
  const bool picture = std::any_of(drawn.files.begin(), drawn.files.end(), io::is_picture);
  const bool colours = std::any_of(drawn.files.begin(), drawn.files.end(), io::is_coloured);
  const auto needs = [](const char* option, const char* what) {
    throw WrongUsage(fmt::format("{} is for pictures; name one, such as {}", option, what));
  };
  const char* example = drawn.kind == DomainKind::polygon ? "-o map.svg" : "-o view.png";
  if (!arguments.color_by.empty() && !colours) needs("--color-by", example);
  if (!arguments.size.empty() && !picture) needs("--size", example);
  const bool turned = !arguments.camera.empty() || !arguments.up.empty();
  const char* camera = arguments.camera.empty() ? "--up" : "--camera";
  if (turned && drawn.kind == DomainKind::polygon)
    throw WrongUsage(
        fmt::format("{} turns pictures of surfaces and volumes, but the domain is flat", camera));
  if (turned && !picture) needs(camera, example);
  if (arguments.no_cut && drawn.kind != DomainKind::volume)
    throw WrongUsage(
        fmt::format("--no-cut: only volumes are opened, but the domain is a {}", io::name(drawn.kind)));
  if (arguments.no_cut && !picture) needs("--no-cut", example);
  if (arguments.no_legend && arguments.color_by.empty())
    throw WrongUsage("--no-legend leaves out the legend of --color-by, which is not given");
}

}  // namespace

void add_size_option(CLI::App& command, SizeArguments& arguments, int usual) {
  command
      .add_option("--size", arguments.size, "Longer side of pictures, or W:H, in pixels; in points for PDF")
      ->default_str(std::to_string(usual))
      ->check(fault_of(read_size))
      ->type_name("W[:H]")
      ->group(picture_group);
}

void add_camera_options(CLI::App& command, CameraArguments& arguments, int usual) {
  add_size_option(command, arguments, usual);
  command
      .add_option("--camera", arguments.camera,
                  "Direction from which surfaces and volumes are seen: X,Y,Z, or front, back, left, right, "
                  "top, bottom or iso")
      ->default_str("0.6,-0.8,0.52")
      ->check(fault_of(read_camera))
      ->type_name("X,Y,Z")
      ->group(picture_group);
  command.add_option("--up", arguments.up, "Direction that is shown upwards")
      ->default_str("0,0,1; if the camera looks along it, 0,1,0")
      ->check(fault_of(read_direction))
      ->type_name("X,Y,Z")
      ->group(picture_group);
}

void add_picture_options(CLI::App& command, PictureArguments& arguments, const std::string& files) {
  command
      .add_option(
          "--color-by", arguments.color_by,
          fmt::format("Colour the cells of {} by measure, weight, neighbors, or a column of the seeds' "
                      "table: numbers on a scale, a colour for each text, or texts such as #3a6b9c; "
                      "with a legend",
                      files))
      ->type_name("COLUMN")
      ->default_str("a colour for each cell, apart from its neighbours")
      ->group(picture_group);
  command.add_flag("--no-legend", arguments.no_legend, "No legend for --color-by")->group(picture_group);
  add_camera_options(command, arguments);
  command.add_flag("--no-cut", arguments.no_cut, "Draw volumes whole, not opened towards the camera")
      ->group(picture_group);
}

io::PictureSize picture_size(const SizeArguments& arguments, const io::PictureSize& otherwise) {
  std::string fault;
  return arguments.size.empty() ? otherwise : *read_size(arguments.size, fault);
}

void set_camera(const CameraArguments& arguments, io::Vec3& towards, io::Vec3& up) {
  constexpr float parallel = 1e-4f;  // sine of the angle
  std::string fault;
  if (!arguments.camera.empty()) towards = vector_of(*read_camera(arguments.camera, fault));
  if (!arguments.up.empty()) up = vector_of(*read_direction(arguments.up, fault));
  const auto along_up = [&] { return io::length(io::cross(io::normalized(towards), up)) < parallel; };
  if (along_up() && arguments.up.empty()) up = {0, 1, 0};
  if (along_up())
    throw WrongUsage(
        fmt::format("the camera looks along --up {}, so nothing says what is upwards; choose an "
                    "--up across it",
                    arguments.up));
}

io::PictureStyle picture_style(const PictureArguments& arguments, const DrawnInputs& drawn) {
  check_effects(arguments, drawn);
  io::PictureStyle style;
  style.size = picture_size(arguments);
  style.legend = !arguments.no_legend;
  style.cut = !arguments.no_cut;
  set_camera(arguments, style.towards, style.up);
  if (arguments.color_by.empty()) return style;
  style.colours = io::colour_by(arguments.color_by, drawn.inputs, drawn.seeds);
  const int shorter =
      style.size.height > 0 ? std::min(style.size.width, style.size.height) : style.size.width;
  if (style.legend && shorter < least_with_legend)
    throw WrongUsage(
        fmt::format("--size {}: below {} there is no room for the legend of --color-by; leave it out "
                    "with --no-legend",
                    arguments.size, least_with_legend));
  return style;
}

}  // namespace powercell::app
