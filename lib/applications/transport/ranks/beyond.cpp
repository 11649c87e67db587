#include "lib/applications/transport/ranks/beyond.hpp"

#include <algorithm>
#include <map>

namespace powercell {

Beyond::Beyond(const std::vector<std::uint32_t>& kept, std::span<const double> positions, std::size_t d,
               const Numbering& numbers, RankMailbox& mailbox)
    : numbers_(numbers),
      mailbox_(mailbox),
      d_(d),
      rows_(mailbox, kept.size()),
      index_here_(numbers.count()),
      positions_(positions.begin(), positions.end()),
      from_(static_cast<std::size_t>(mailbox.shards())),
      to_(static_cast<std::size_t>(mailbox.shards())) {
  for (std::uint32_t k = 0; k < kept.size(); ++k) index_here_[kept[k]] = k;
}

void Beyond::meet(std::span<const std::uint64_t> numbers) {
  std::map<int, std::vector<std::uint64_t>> unknown;
  for (const std::uint64_t number : numbers) {
    if (numbers_.is_here(number)) continue;
    const auto index = static_cast<std::uint32_t>(here() + slot_.size());
    if (!slot_.emplace(number, index).second) continue;
    const int owner = numbers_.owner(number);
    unknown[owner].push_back(number);
    from_[static_cast<std::size_t>(owner)].push_back(index);
  }
  row_.resize(slot_.size());
  positions_.resize((here() + slot_.size()) * d_);
  std::vector<Mailbox::Letters> letters(1);
  for (const auto& [to, wanted] : unknown) letters[0][to] = packed(wanted);
  letters = mailbox_.deliver(std::move(letters));
  for (auto& [from, letter] : letters[0]) {
    std::vector<std::uint64_t> wanted, row;
    std::vector<double> position;
    unpack(letter, wanted);
    for (const std::uint64_t number : wanted) {
      const std::uint32_t k = index_here_[numbers_.index(number)];
      to_[static_cast<std::size_t>(from)].push_back(k);
      row.push_back(rows_.first() + k);
      position.insert(position.end(), &positions_[k * d_], &positions_[k * d_] + d_);
    }
    letter = packed(row, position);
  }
  letters = mailbox_.deliver(std::move(letters));
  for (const auto& [from, letter] : letters[0]) {
    std::vector<std::uint64_t> row;
    std::vector<double> position;
    unpack(letter, row, position);
    const std::vector<std::uint64_t>& wanted = unknown.at(from);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      const std::uint32_t index = slot_.at(wanted[k]);
      row_[index - here()] = row.at(k);
      std::copy_n(&position.at(k * d_), d_, &positions_[index * d_]);
    }
  }
}

Vector Beyond::values(const Vector& here_values) {
  std::vector<Mailbox::Letters> letters(1);
  std::vector<double> values;
  for (std::size_t rank = 0; rank < to_.size(); ++rank) {
    if (to_[rank].empty()) continue;
    values.clear();
    for (const std::uint32_t k : to_[rank]) values.push_back(here_values[k]);
    letters[0][static_cast<int>(rank)] = packed(values);
  }
  letters = mailbox_.deliver(std::move(letters));
  Vector result(static_cast<Eigen::Index>(slot_.size()));
  for (const auto& [from, letter] : letters[0]) {
    unpack(letter, values);
    const std::vector<std::uint32_t>& indices = from_[static_cast<std::size_t>(from)];
    for (std::size_t k = 0; k < indices.size(); ++k)
      result[static_cast<Eigen::Index>(indices[k] - here())] = values.at(k);
  }
  return result;
}

}  // namespace powercell
