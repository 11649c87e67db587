#include "lib/base/mailbox.hpp"

#include <powercell/error.hpp>
#include <string>

namespace powercell {

void require_same(const std::vector<NamedValue>& own, Mailbox& mailbox) {
  std::vector<std::uint64_t> values, first, other;
  for (const NamedValue& named : own) values.push_back(named.value);
  const std::vector<Bytes> all = mailbox.share({packed(values)});
  unpack(all[0], first);
  for (std::size_t rank = 1; rank < all.size(); ++rank) {
    unpack(all[rank], other);
    if (other == first) continue;
    std::string differ;
    for (std::size_t k = 0; k < own.size(); ++k)
      if (other.size() != own.size() || other[k] != first[k])
        differ += (differ.empty() ? "" : ", ") + own[k].name;
    throw Error(ErrorCode::invalid_argument, "ranks 0 and " + std::to_string(rank) + " differ in " + differ +
                                                 "; call with the same domain and options on all ranks");
  }
}

}  // namespace powercell
