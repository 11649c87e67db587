#include <powercell/verify.hpp>

#include "python/src/call.hpp"
#include "python/src/options.hpp"

namespace powercell::python {
namespace {

template <class T>
std::vector<T> numbers(const nb::dict& given, const char* key) {
  const std::span all = span_of(nb::cast<Vector<T>>(given[key]));
  return {all.begin(), all.end()};
}

/// Of rows (kind, index).
std::vector<Border> borders(const nb::dict& given, const char* key) {
  const auto all = nb::cast<Matrix<std::uint32_t>>(given[key]);
  std::vector<Border> result;
  for (std::size_t k = 0; k < all.shape(0); ++k)
    result.push_back({static_cast<Border::Kind>(all.data()[2 * k]), all.data()[2 * k + 1]});
  return result;
}

Measures measures_of(const nb::dict& given) {
  Measures measures;
  measures.dimension = nb::cast<int>(given["dimension"]);
  measures.mass = numbers<double>(given, "mass");
  measures.centroid = numbers<double>(given, "centroid");
  for (const std::uint8_t status : numbers<std::uint8_t>(given, "status"))
    measures.status.push_back(static_cast<SeedStatus>(status));
  measures.domain_measure = nb::cast<double>(given["domain_measure"]);
  return measures;
}

JoinedCells cells_of(const nb::dict& given) {
  JoinedCells cells;
  cells.dimension = nb::cast<int>(given["dimension"]);
  cells.cell_dimension = nb::cast<int>(given["cell_dimension"]);
  cells.vertex_offset = numbers<std::uint64_t>(given, "vertex_offset");
  cells.vertices = numbers<double>(given, "vertices");
  cells.face_offset = numbers<std::uint64_t>(given, "face_offset");
  cells.face_border = borders(given, "face_border");
  cells.loop_offset = numbers<std::uint64_t>(given, "loop_offset");
  cells.loop = numbers<std::uint32_t>(given, "loop");
  cells.edge_border = borders(given, "edge_border");
  return cells;
}

/// \param given  the fields of a SavedDiagram, checked; the values of kinds and statuses are in range
std::vector<LawCheck> verify_saved(const Matrix<double>& positions, const Vector<double>& weights,
                                   const nb::dict& given, const nb::dict& cells) {
  const Measures measures = measures_of(given);
  const JoinedCells joined = cells_of(cells);
  const SavedDiagram saved{chosen<DomainKind>("kind", nb::cast<std::string>(given["kind"]),
                                              {{"polygon", DomainKind::polygon},
                                               {"surface", DomainKind::surface},
                                               {"volume", DomainKind::volume}}),
                           chosen<Precision>("precision", nb::cast<std::string>(given["precision"]),
                                             {{"double", Precision::float64}, {"float", Precision::float32}}),
                           {measures.dimension, span_of(positions), span_of(weights)},
                           measures,
                           joined};
  VerifyOptions options;
  options.samples = whole<std::size_t>(given, "samples");
  options.random_seed = whole<std::uint64_t>(given, "random_seed");
  return without_lock([&] { return verify(saved, options); });
}

}  // namespace

void bind_checks(nb::module_& m) {
  nb::class_<LawCheck>(m, "LawCheck", "One law and how well it holds.")
      .def_ro("law", &LawCheck::law)
      .def_ro("passed", &LawCheck::passed)
      .def_ro("value", &LawCheck::value)
      .def_ro("tolerance", &LawCheck::tolerance)
      .def_ro("detail", &LawCheck::detail);
  m.def("verify_saved", &verify_saved, "positions"_a, "weights"_a, "given"_a, "cells"_a);
}

}  // namespace powercell::python
