// campaign_lattices --k 100: diagrams of lattices of about k^3 seeds, where every decision is a tie, in all
// positions and both precisions. Checks cells against their known measure, walls from both sides and that the
// dual is a triangulation, and prints the time. Exits 1 on a fault.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <powercell/diagram.hpp>

#include "bench/clocks.hpp"
#include "tests/exact/check_triangulation.hpp"
#include "tests/exact/lattices.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The number of walls that differ between their two sides or have no extent.
std::size_t wall_faults(const Adjacency& a) {
  std::size_t faults = 0;
  for (std::uint32_t i = 0; i + 1 < a.offset.size(); ++i)
    for (std::uint64_t k = a.offset[i]; k < a.offset[i + 1]; ++k) {
      const auto begin = a.neighbor.begin() + static_cast<std::ptrdiff_t>(a.offset[a.neighbor[k]]);
      const auto end = a.neighbor.begin() + static_cast<std::ptrdiff_t>(a.offset[a.neighbor[k] + 1]);
      const auto back = std::lower_bound(begin, end, i);
      faults += back == end || *back != i || !(a.wall[k] > 0) ||
                a.wall[static_cast<std::size_t>(back - a.neighbor.begin())] != a.wall[k];
    }
  return faults;
}

bool run(const Device& device, const Lattice& lattice, const Place& place, Precision precision,
         bool with_dual) {
  const LatticeSeeds seeds = lattice_seeds(lattice, place);
  Options options;
  options.precision = precision;
  Diagram diagram(device, box_around(place, lattice.dimension), options);
  diagram.set_seeds(seeds.array.view());
  const double start = bench::processor_seconds();
  diagram.compute(true, with_dual);
  const double spent = bench::processor_seconds() - start;
  const double cell = std::pow(place.scale / static_cast<double>(lattice.k), lattice.dimension) /
                      static_cast<double>(lattice.basis.size());
  double worst = 0;
  for (std::size_t i = 0; i < seeds.array.size(); ++i)
    if (seeds.inside[i]) worst = std::max(worst, std::abs(diagram.measures().mass[i] / cell - 1));
  const std::size_t walls = wall_faults(diagram.adjacency());
  const Triangulated dual = with_dual ? check_triangulation(diagram.dual(), seeds.array) : Triangulated{};
  std::printf("%-13s %-7s %-6s %9zu %9llu %10.1f %11.2g %11.2g %6zu %6zu\n", lattice.name.c_str(),
              place.name.c_str(), precision == Precision::float32 ? "float" : "double", seeds.array.size(),
              static_cast<unsigned long long>(diagram.timings().uncertain),
              1e6 * spent / static_cast<double>(seeds.array.size()), worst,
              diagram.measures().relative_error(), walls, dual.faults);
  std::fflush(stdout);
  return walls + dual.faults == 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t k = 16;
  std::string only, where, real;
  bool without_dual = false;
  CLI::App app("Lattices, where every decision is a tie");
  app.add_option("--k", k, "Periods of the cubic lattice along an axis; the others have about as many seeds")
      ->capture_default_str();
  app.add_option("--only", only, "Only the lattice of this name");
  app.add_option("--place", where, "Only the place of this name");
  app.add_option("--precision", real, "Only this precision")->check(CLI::IsMember({"double", "float"}));
  app.add_flag("--without-dual", without_dual, "Measures and adjacency alone");
  CLI11_PARSE(app, argc, argv);
  try {
    const Device device = Device::choose();
    bool good = true;
    std::printf("%-13s %-7s %-6s %9s %9s %10s %11s %11s %6s %6s\n", "lattice", "place", "real", "cells",
                "on host", "us a cell", "worst cell", "sum", "walls", "dual");
    for (Lattice lattice : lattices()) {
      if (!only.empty() && lattice.name != only) continue;
      const double seeds = std::pow(static_cast<double>(k), 3);
      lattice.k = static_cast<std::size_t>(
          std::lround(std::pow(seeds / static_cast<double>(lattice.basis.size()), 1.0 / lattice.dimension)));
      for (const Place& place : places) {
        if (!where.empty() && place.name != where) continue;
        for (const Precision precision : {Precision::float64, Precision::float32}) {
          if (!real.empty() && (real == "float") != (precision == Precision::float32)) continue;
          good = run(device, lattice, place, precision, !without_dual) && good;
        }
      }
    }
    return good ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "campaign_lattices: %s\n", error.what());
    return 2;
  }
}
