#include "apps/domain_choice.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <powercell/error.hpp>

#include "apps/common.hpp"
#include "apps/io/names.hpp"
#include "apps/io/read/domain_box.hpp"
#include "apps/option_words.hpp"

namespace powercell::app {
namespace {

io::DomainArrays read_solid(const DomainArguments& arguments) {
  if (!arguments.kind.empty() && arguments.kind != "surface")
    throw WrongUsage(fmt::format(
        "--solid takes the inside of a surface, but --kind is {}; leave one of them out", arguments.kind));
  const std::optional<DomainKind> kind = io::domain_kind(arguments.kind);
  io::DomainArrays arrays = io::read_domain_arrays(arguments.domain, kind);
  const DomainKind found = arrays.kind;
  try {
    if (found == DomainKind::volume) arrays = io::read_domain_arrays(arguments.domain, DomainKind::surface);
  } catch (const Error&) {  // it has no triangles beside its tetrahedra
  }
  if (arrays.kind != DomainKind::surface)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("--solid takes the inside of a closed surface, but {} is a {}; leave --solid out",
                            arguments.domain, io::name(found)));
  arrays.solid = true;
  return arrays;
}

}  // namespace

void add_domain_options(CLI::App& command, DomainArguments& arguments) {
  command.add_option("--kind", arguments.kind, "For files that can be read as more than one kind of domain")
      ->check(one_of({"polygon", "surface", "volume"}))
      ->default_str("the highest dimension that the file has");
  command.add_flag(
      "--periodic{xyz}", arguments.periodic,
      "Identify opposite sides of the box, square or cube: along all axes, or those given, as in "
      "--periodic=xz");
  command.add_flag(
      "--solid", arguments.solid,
      "Take the inside of a closed surface (.off .obj .ply .stl and others) as the domain: measures and "
      "walls, for --table and --walls");
}

io::DomainArrays read_domain_arrays(const DomainArguments& arguments) {
  io::DomainArrays arrays = arguments.solid
                                ? read_solid(arguments)
                                : io::read_domain_arrays(arguments.domain, io::domain_kind(arguments.kind));
  io::make_periodic(arrays, arguments.periodic, arguments.domain);
  return arrays;
}

}  // namespace powercell::app
