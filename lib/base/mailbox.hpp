/// \file
/// Carries messages between shards, some of which are here, and compares what they were given.
#pragma once

#include <cstdint>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "lib/base/bytes.hpp"

namespace powercell {

/// Where some shards are here and others elsewhere, all places call the same functions in the same order.
class Mailbox {
 public:
  using Letters = std::map<int, Bytes>;  ///< by number of the shard that they go to, or come from

  Mailbox() = default;
  Mailbox(const Mailbox&) = delete;
  Mailbox& operator=(const Mailbox&) = delete;
  virtual ~Mailbox() = default;

  virtual int shards() const = 0;        ///< in all
  virtual int first() const = 0;         ///< the number of the first shard that is here; the others follow it
  virtual const char* noun() const = 0;  ///< what messages call a shard

  /// \param letters  of each shard here, to any
  /// \return to each shard here
  virtual std::vector<Letters> deliver(std::vector<Letters> letters) = 0;
  /// The same where one shard is here.
  Letters deliver_one(Letters letters) {
    std::vector<Letters> own(1);
    own[0] = std::move(letters);
    return std::move(deliver(std::move(own))[0]);
  }
  /// \param own  of each shard here
  /// \return of all shards
  virtual std::vector<Bytes> share(std::vector<Bytes> own) = 0;

  /// The sums over all shards of `count` numbers.
  /// \param own  of each shard here, as many of each
  std::vector<std::uint64_t> sums(const std::vector<std::vector<std::uint64_t>>& own) {
    std::vector<Bytes> bytes;
    for (const std::vector<std::uint64_t>& values : own) bytes.push_back(packed(values));
    std::vector<std::uint64_t> sums, values;
    for (const Bytes& of_shard : share(std::move(bytes))) {
      unpack(of_shard, values);
      sums.resize(values.size());
      for (std::size_t k = 0; k < values.size(); ++k) sums[k] += values[k];
    }
    return sums;
  }
};

/// An argument, or what tells it from others.
struct NamedValue {
  std::string name;
  std::uint64_t value;
};

/// \param own  of this rank; on all ranks those of the same names in the same order
/// \throw Error invalid_argument, with what differs
void require_same(const std::vector<NamedValue>& own, Mailbox& mailbox);

}  // namespace powercell
