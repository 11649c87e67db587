/// \file
/// Boxes and lattices as arguments of --domain, and --periodic.
#pragma once

#include <string>

#include "apps/io/read/polygons.hpp"

namespace powercell::io {

/// Whether `spec` begins with "box:" or "lattice:".
bool is_box_spec(const std::string& spec);

/// "box:LX,LY[,LZ]:HX,HY[,HZ]", from the lower to the higher corner, or "lattice:ax,ay/bx,by" and
/// "lattice:ax,ay,az/bx,by,bz/cx,cy,cz", which is periodic along all its vectors.
/// \throw Error invalid_argument (what is wrong with it), invalid_domain
DomainArrays parse_box(const std::string& spec);

/// Makes a box periodic along the axes that `axes` names, of x, y and z; "xyz" in the plane stands for "xy".
/// \throw Error invalid_argument (axes), unsupported unless the domain is a box
void make_periodic(DomainArrays& arrays, const std::string& axes, const std::string& spec);

/// "box:0,0:2,1: box, periodic along x".
std::string describe_box(const Domain& domain, const std::string& spec);

}  // namespace powercell::io
