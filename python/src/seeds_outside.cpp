#include "apps/io/tables/seeds_outside.hpp"

#include <cmath>

#include "python/src/call.hpp"

namespace powercell::python {
namespace {

/// The way in, in words of NumPy; empty if none was found.
std::string advice(const io::WayIn& way) {
  switch (way.kind) {
    case io::WayIn::Kind::columns: {
      std::string order;
      for (const std::size_t column : way.columns)
        order += (order.empty() ? "" : ", ") + std::to_string(column);
      return "; positions[:, [" + order + "]] would put " + std::to_string(std::lround(100 * way.share)) +
             " % inside";
    }
    case io::WayIn::Kind::seeds_in_lengths:
      return "; the domain could be in degrees and the seeds in lengths: bring both into one coordinate "
             "system, "
             "e.g. with to_crs() of GeoPandas";
    case io::WayIn::Kind::seeds_in_degrees:
      return "; the seeds could be in degrees and the domain in lengths: bring both into one coordinate "
             "system, "
             "e.g. with to_crs() of GeoPandas";
    case io::WayIn::Kind::unit: {
      const nb::object factor = nb::float_(way.factor);
      return "; " + std::string(nb::str(factor).c_str()) +
             " times their coordinates would lie inside: give both in one unit";
    }
    default:
      return {};
  }
}

/// How many seeds miss the domain's box and what would bring them in; empty if at least one in twenty lies in
/// it.
std::string seeds_outside(const Domain& domain, const Matrix<double>& positions) {
  const std::span all = span_of(positions);
  const io::SeedBox box = io::seed_box(domain);
  if (!io::most_outside(box, all)) return {};
  return io::outside_line(box, all, true) +
         advice(io::way_in(box, all, io::coordinate_columns(all, box.dimension)));
}

}  // namespace

void bind_seeds_outside(nb::module_& m) {
  m.def("seeds_outside", &seeds_outside, "domain"_a, "positions"_a);
}

}  // namespace powercell::python
