#include "lib/exchange/same_call.hpp"

#include <bit>
#include <concepts>
#include <powercell/version.hpp>
#include <string_view>
#include <utility>

#include "lib/base/random.hpp"
#include "lib/base/same_values.hpp"
#include "lib/domain/region_mesh.hpp"

namespace powercell::exchange {
namespace {

class Digest {
 public:
  Digest& add(std::integral auto number) {
    value_ = mixed_bits(value_ ^ static_cast<std::uint64_t>(number));
    return *this;
  }
  Digest& add(double value) { return add(std::bit_cast<std::uint64_t>(value)); }
  Digest& add(const Border& border) {
    return add(std::uint64_t{static_cast<std::uint32_t>(border.kind)} << 32 | border.index);
  }
  template <class Values>
  Digest& add_all(const Values& values) {
    for (const auto& value : values) add(value);
    return add(values.size());
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0;
};

}  // namespace

std::vector<NamedValue> call_values(const Domain& domain, const Options& options) {
  const RegionMesh& mesh = domain.mesh();
  const auto number = [](auto value) { return static_cast<std::uint64_t>(value); };  // of an enumeration
  Digest periods;
  if (mesh.period)
    for (int axis = 0; axis < mesh.dimension; ++axis)
      periods.add(mesh.period->is_periodic(axis)).add_all(mesh.period->given(axis));
  return {{"the version of powercell", Digest().add_all(std::string_view(version())).value()},
          {"the kind of domain", Digest()
                                     .add(number(mesh.kind))
                                     .add(mesh.dimension)
                                     .add(domain.is_solid())
                                     .add(domain.is_periodic())
                                     .value()},
          {"the vertices of the domain",
           Digest().add_all(mesh.vertices).add_all(mesh.low).add_all(mesh.high).add(mesh.measure).value()},
          {"the regions of the domain",
           Digest().add_all(mesh.region_offset).add_all(mesh.region_vertex).add_all(mesh.facet).value()},
          {"the periods of the domain", periods.value()},
          {"Options::precision", number(options.precision)},
          {"Options::decisions", number(options.decisions)},
          {"Options::certify", number(options.certify)}};
}

void require_same_call(const Domain& domain, const DistributedOptions& options, Post& post) {
  std::vector<NamedValue> values = call_values(domain, options.diagram);
  values.push_back({"DistributedOptions::redistribute", static_cast<std::uint64_t>(options.redistribute)});
  require_same(values, post);
}

}  // namespace powercell::exchange
