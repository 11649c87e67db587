/// \file
/// Numbers by keys: a row where there are few, a hash table where there are many. Internal.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace powercell::solid {

inline constexpr std::uint32_t none = ~std::uint32_t{0};

class Lookup {
 public:
  void clear() {
    row_.clear();
    if (!table_.empty()) table_.clear();
  }
  /// Adds a key, which must be new.
  void add(std::uint64_t key, std::uint32_t value) {
    row_.emplace_back(key, value);
    if (row_.size() == few) table_.insert(row_.begin(), row_.end());
    if (row_.size() > few) table_.emplace(key, value);
  }
  /// The value of a key, or `none`.
  std::uint32_t find(std::uint64_t key) const {
    if (row_.size() < few) {
      for (const auto& [k, value] : row_)
        if (k == key) return value;
      return none;
    }
    const auto found = table_.find(key);
    return found == table_.end() ? none : found->second;
  }

 private:
  static constexpr std::size_t few = 64;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> row_;
  std::unordered_map<std::uint64_t, std::uint32_t> table_;
};

}  // namespace powercell::solid
