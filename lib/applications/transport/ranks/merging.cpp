#include "lib/applications/transport/ranks/merging.hpp"

#include <algorithm>
#include <bit>
#include <map>

#include "lib/base/positions.hpp"
#include "lib/base/random.hpp"

namespace powercell {
namespace {

/// Equal positions go to the same rank, which depends on nothing else.
int meeting_place(const double* position, std::size_t d, int ranks) {
  std::uint64_t digest = 0;
  for (std::size_t c = 0; c < d; ++c)
    digest = mixed_bits(digest ^ std::bit_cast<std::uint64_t>(position[c] + 0.0));  // -0 is 0
  return static_cast<int>(digest % static_cast<std::uint64_t>(ranks));
}

/// Seeds that meet somewhere.
struct Meeting {
  std::vector<std::uint64_t> number;
  std::vector<double> position;
};

}  // namespace

Merging::Merging(std::span<const double> positions, std::size_t d, const Numbering& numbers,
                 RankMailbox& mailbox)
    : numbers_(numbers), mailbox_(mailbox) {
  const std::vector<std::uint32_t> first_here = first_at_position(positions, d);
  std::map<int, Meeting> sent;
  for (std::size_t i = 0; i < first_here.size(); ++i) {
    if (first_here[i] != i) continue;
    Meeting& meeting = sent[meeting_place(&positions[i * d], d, mailbox.shards())];
    meeting.number.push_back(numbers.first() + i);
    meeting.position.insert(meeting.position.end(), &positions[i * d], &positions[i * d] + d);
  }
  std::vector<Mailbox::Letters> letters(1);
  for (const auto& [to, meeting] : sent) letters[0][to] = packed(meeting.number, meeting.position);
  letters = mailbox.deliver(std::move(letters));

  Meeting all, one;  // ranks in order have numbers that ascend
  std::map<int, std::size_t> end;
  for (const auto& [from, letter] : letters[0]) {
    unpack(letter, one.number, one.position);
    all.number.insert(all.number.end(), one.number.begin(), one.number.end());
    all.position.insert(all.position.end(), one.position.begin(), one.position.end());
    end[from] = all.number.size();
  }
  const std::vector<std::uint32_t> first_there = first_at_position(all.position, d);
  std::size_t k = 0;
  for (auto& [from, letter] : letters[0]) {
    std::vector<std::uint64_t> firsts;
    for (; k < end[from]; ++k) firsts.push_back(all.number[first_there[k]]);
    letter = packed(firsts);
  }
  letters = mailbox.deliver(std::move(letters));

  first_.resize(first_here.size());
  for (const auto& [from, letter] : letters[0]) {
    std::vector<std::uint64_t> firsts;
    unpack(letter, firsts);
    for (k = 0; k < firsts.size(); ++k) first_[numbers.index(sent.at(from).number[k])] = firsts[k];
  }
  for (std::uint32_t i = 0; i < first_.size(); ++i) {
    first_[i] = first_[first_here[i]];
    if (first_[i] == numbers.first() + i) kept_.push_back(i);
  }
}

std::vector<double> Merging::joined(std::span<const double> mass) const {
  std::vector<double> sum(mass.size());
  std::map<int, Meeting> sent;  // with masses in place of positions
  for (std::size_t i = 0; i < mass.size(); ++i) {
    if (numbers_.is_here(first_[i])) {
      sum[numbers_.index(first_[i])] += mass[i];
      continue;
    }
    Meeting& meeting = sent[numbers_.owner(first_[i])];
    meeting.number.push_back(first_[i]);
    meeting.position.push_back(mass[i]);
  }
  std::vector<Mailbox::Letters> letters(1);
  for (const auto& [to, meeting] : sent) letters[0][to] = packed(meeting.number, meeting.position);
  letters = mailbox_.deliver(std::move(letters));
  Meeting one;
  for (const auto& [from, letter] : letters[0]) {
    unpack(letter, one.number, one.position);
    for (std::size_t k = 0; k < one.number.size(); ++k) sum[numbers_.index(one.number[k])] += one.position[k];
  }
  std::vector<double> result;
  for (const std::uint32_t i : kept_) result.push_back(sum[i]);
  return result;
}

void Merging::spread(std::vector<double>& weights) const {
  std::map<int, std::vector<std::uint64_t>> wanted;
  for (const std::uint64_t first : first_)
    if (!numbers_.is_here(first)) wanted[numbers_.owner(first)].push_back(first);
  std::vector<Mailbox::Letters> letters(1);
  for (const auto& [to, numbers] : wanted) letters[0][to] = packed(numbers);
  letters = mailbox_.deliver(std::move(letters));
  for (auto& [from, letter] : letters[0]) {
    std::vector<std::uint64_t> numbers;
    unpack(letter, numbers);
    std::vector<double> values;
    for (const std::uint64_t number : numbers) values.push_back(weights[numbers_.index(number)]);
    letter = packed(values);
  }
  letters = mailbox_.deliver(std::move(letters));
  std::map<std::uint64_t, double> elsewhere;
  for (const auto& [from, letter] : letters[0]) {
    std::vector<double> values;
    unpack(letter, values);
    for (std::size_t k = 0; k < values.size(); ++k) elsewhere[wanted.at(from)[k]] = values[k];
  }
  for (std::size_t i = 0; i < weights.size(); ++i)
    weights[i] = numbers_.is_here(first_[i]) ? weights[numbers_.index(first_[i])] : elsewhere.at(first_[i]);
}

}  // namespace powercell
