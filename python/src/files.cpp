#include "apps/io/maps/crs.hpp"
#include "apps/io/read/domain.hpp"
#include "apps/io/tables/read_seeds.hpp"
#include "python/src/call.hpp"
#include "python/src/options.hpp"

namespace powercell::python {
namespace {

std::optional<DomainKind> kind_of(const std::string& name) {
  if (name == "auto") return std::nullopt;
  return chosen<DomainKind>("kind", name,
                            {{"auto", DomainKind::polygon},
                             {"polygon", DomainKind::polygon},
                             {"surface", DomainKind::surface},
                             {"volume", DomainKind::volume}});
}

}  // namespace

void bind_files(nb::module_& m) {
  nb::class_<io::LoadedDomain>(m, "LoadedDomain")
      .def_ro("domain", &io::LoadedDomain::domain)
      .def_ro("description", &io::LoadedDomain::description)
      .def_prop_ro("crs", [](const io::LoadedDomain& d) { return d.crs.name; })
      .def_prop_ro("is_in_degrees", [](const io::LoadedDomain& d) { return io::is_in_degrees(d.crs.name); });
  m.def("read_domain", [](const std::string& path, const std::string& kind) {
    const auto wanted = kind_of(kind);
    return without_lock([&] { return io::read_domain(path, wanted); });
  });

  nb::class_<io::SeedTable>(m, "SeedTable")
      .def_prop_ro("positions",
                   [](nb::handle self) {
                     const auto& t = nb::cast<io::SeedTable&>(self);
                     return rows(t.positions, static_cast<std::size_t>(t.dimension), self);
                   })
      .def_prop_ro("weights",
                   [](nb::handle self) { return view(nb::cast<io::SeedTable&>(self).weights, self); })
      .def_prop_ro("crs", [](const io::SeedTable& t) { return t.columns.crs; })
      .def_prop_ro("degrees", [](const io::SeedTable& t) { return t.columns.degrees; })
      .def_prop_ro("names", [](const io::SeedTable& t) { return t.columns.names; })
      .def_prop_ro("taken", [](const io::SeedTable& t) { return t.columns.taken; })
      .def_prop_ro("count", [](const io::SeedTable& t) { return t.columns.count; })
      .def("column", [](const io::SeedTable& t, std::size_t column) {
        std::vector<std::string> fields;
        for (std::size_t row = 0; row < t.text.rows(); ++row) fields.emplace_back(t.text.field(row, column));
        return fields;
      });
  m.def("read_seeds", [](const std::string& path, int dimension, const std::vector<std::string>& position,
                         const std::string& weight, const std::string& radius) {
    io::ColumnChoice choice;
    for (std::size_t k = 0; k < position.size() && k < 3; ++k) choice.position[k] = position[k];
    choice.weight = weight;
    choice.radius = radius;
    return without_lock([&] { return io::read_seed_file(path, dimension, choice); });
  });
}

}  // namespace powercell::python
