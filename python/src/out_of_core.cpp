#include <nanobind/stl/pair.h>

#include <algorithm>
#include <powercell/error.hpp>
#include <powercell/out_of_core.hpp>

#include "python/src/call.hpp"
#include "python/src/options.hpp"
#include "python/src/seeds.hpp"

namespace powercell::python {
namespace {

/// Ends the computation after a function of Python has failed; what it threw comes out of Call::run().
void require_ran(bool ran) {
  if (!ran) throw Error(ErrorCode::interrupted, "a function of the caller has failed");
}

/// Copies what a function of Python has read. \throw Error invalid_argument if that are not all of the seeds
void copy_block(const nb::handle block, int dimension, std::span<double> positions,
                std::span<double> weights) {
  const auto [points, heavy] = nb::cast<std::pair<Matrix<double>, Weights>>(block);
  const SeedsView read = seeds_of(points, heavy);
  if (read.dimension != dimension || read.positions.size() != positions.size() ||
      (heavy && read.weights.size() != weights.size()))
    throw Error(ErrorCode::invalid_argument, "a source of seeds has read a block of another shape");
  std::copy(read.positions.begin(), read.positions.end(), positions.begin());
  if (heavy)
    std::copy(read.weights.begin(), read.weights.end(), weights.begin());
  else
    std::fill(weights.begin(), weights.end(), 0.0);
}

/// \param read  a function of the first seed and the number of seeds that returns arrays of positions and
///              weights; the latter may be None
/// \param take  a function of CellRows
OutOfCoreReport compute(const Device& device, const Domain& domain, std::uint64_t count,
                        const std::string& name, const nb::object& read, const nb::object& take,
                        const nb::dict& given, const nb::dict& options, nb::object progress) {
  Call call(std::move(progress));
  const int dimension = domain.dimension();
  const SeedSource source{count, dimension, name,
                          [&](std::uint64_t first, std::span<double> positions, std::span<double> weights) {
                            require_ran(call.python([&] {
                              copy_block(read(first, weights.size()), dimension, positions, weights);
                            }));
                          }};
  OutOfCoreOptions with;
  with.diagram = options_of(options);
  with.diagram.progress = [&](double fraction) { return call.report(fraction); };
  with.folder = nb::cast<std::string>(given["folder"]);
  with.memory = whole<std::uint64_t>(given, "memory");
  with.walls = nb::cast<bool>(given["walls"]);
  with.piece_seeds = whole<std::uint64_t>(given, "piece_seeds");
  const auto use = [&](CellRows rows) { require_ran(call.python([&] { take(nb::cast(std::move(rows))); })); };
  return call.run([&] { return compute_out_of_core(device, domain, source, use, with); });
}

}  // namespace

void bind_out_of_core(nb::module_& m) {
  nb::class_<OutOfCoreReport>(m, "OutOfCoreReport",
                              "What a computation out of core came to, and what it took.")
      .def_ro("cells", &OutOfCoreReport::cells, "Seeds with a cell.")
      .def_ro("hidden", &OutOfCoreReport::hidden, "Seeds whose cell is empty.")
      .def_ro("duplicate", &OutOfCoreReport::duplicate, "Seeds at the place of another.")
      .def_ro("measure", &OutOfCoreReport::measure, "Sum of the masses, compensated.")
      .def_ro("domain_measure", &OutOfCoreReport::domain_measure, "Area or volume of the domain.")
      .def_ro("pieces", &OutOfCoreReport::pieces)
      .def_ro("kept", &OutOfCoreReport::kept, "Pieces that an earlier run had finished.")
      .def_ro("again", &OutOfCoreReport::again, "Pieces computed twice, for flat cells of other pieces.")
      .def_ro("rounds", &OutOfCoreReport::rounds, "Of all pieces.")
      .def_ro("fetched", &OutOfCoreReport::fetched,
              "Seeds read for the cells of another piece, once for each.")
      .def_ro("neighbors", &OutOfCoreReport::neighbors, "Of these, with a wall in the end.")
      .def_ro("clipped", &OutOfCoreReport::clipped, "Cells, counted each time.")
      .def_ro("bytes_read", &OutOfCoreReport::bytes_read,
              "Of seeds and results, from the source and the folder.")
      .def_ro("bytes_written", &OutOfCoreReport::bytes_written, "To the folder.")
      .def_ro("sort", &OutOfCoreReport::sort, "Seconds.")
      .def_ro("compute", &OutOfCoreReport::compute, "Seconds.")
      .def_ro("gather", &OutOfCoreReport::gather, "Seconds.");
  nb::class_<CellRows>(m, "CellRows")
      .def_ro("first", &CellRows::first)
      .def_ro("measures", &CellRows::measures)
      .def_prop_ro("indptr", [](nb::handle self) { return view(nb::cast<CellRows&>(self).offset, self); })
      .def_prop_ro("indices", [](nb::handle self) { return view(nb::cast<CellRows&>(self).neighbor, self); })
      .def_prop_ro("data", [](nb::handle self) { return view(nb::cast<CellRows&>(self).wall, self); })
      .def_prop_ro("shift", [](nb::handle self) { return shifts(nb::cast<CellRows&>(self), self); })
      .def_ro("all_walls", &CellRows::all_walls);
  m.def("compute_out_of_core", &compute, "device"_a, "domain"_a, "count"_a, "name"_a, "read"_a, "take"_a,
        "given"_a, "options"_a, "progress"_a.none());
}

}  // namespace powercell::python
