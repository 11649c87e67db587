#include "lib/exchange/same_call.hpp"

#include <bit>
#include <concepts>
#include <powercell/version.hpp>
#include <string_view>
#include <utility>

#include "lib/base/random.hpp"
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

struct Part {
  const char* name;
  std::uint64_t digest;
};

std::vector<Part> parts_of(const Domain& domain, const DistributedOptions& options) {
  const RegionMesh& mesh = domain.mesh();
  const auto number = [](auto value) { return static_cast<std::uint64_t>(value); };  // of an enumeration
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
          {"Options::precision", number(options.diagram.precision)},
          {"Options::decisions", number(options.diagram.decisions)},
          {"Options::certify", number(options.diagram.certify)},
          {"DistributedOptions::redistribute", number(options.redistribute)}};
}

}  // namespace

void require_same_call(const Domain& domain, const DistributedOptions& options, Post& post) {
  const std::vector<Part> parts = parts_of(domain, options);
  std::vector<std::uint64_t> digests, first, other;
  for (const Part& part : parts) digests.push_back(part.digest);
  const std::vector<Bytes> all = post.share({packed(digests)});
  unpack(all[0], first);
  for (std::size_t rank = 1; rank < all.size(); ++rank) {
    unpack(all[rank], other);
    if (other == first) continue;
    std::string differ;
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (other.size() != parts.size() || other[k] != first[k])
        differ += (differ.empty() ? "" : ", ") + std::string(parts[k].name);
    throw Error(ErrorCode::invalid_argument, "ranks 0 and " + std::to_string(rank) + " differ in " + differ +
                                                 "; call with the same domain and options on all ranks");
  }
}

}  // namespace powercell::exchange
