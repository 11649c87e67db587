#include "apps/only.hpp"

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <powercell/error.hpp>

#include "apps/io/printable.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/tables/fields.hpp"

namespace powercell::app {
namespace {

/// The seeds by id; of an id that several seeds have, the number of seeds above one.
struct Ids {
  std::map<std::string_view, std::uint32_t> seed;
  std::map<std::string_view, std::size_t> repeated;

  explicit Ids(const io::SeedTable& seeds) {
    if (!seeds.columns.id || seeds.text.columns == 0) return;
    for (std::uint32_t i = 0; i < seeds.count(); ++i) {
      const std::string_view id = seeds.text.field(i, *seeds.columns.id);
      if (!seed.emplace(id, i).second) ++repeated[id];
    }
  }
};

class OnlyReader {
 public:
  OnlyReader(std::string_view text, const std::string& name, const io::SeedTable& seeds)
      : records_(text, name, io::number_separator(text, '#'), '#'), ids_(seeds), count_(seeds.count()) {}

  std::vector<std::uint32_t> read() {
    io::Fields fields;
    for (bool first = true; records_.next(fields); first = false) {
      const std::string head = io::column_name(fields.front());
      if (first && (head == "seed" || head == "id")) continue;
      const std::uint32_t seed = ids_.seed.empty() ? by_index(fields.front()) : by_id(fields.front());
      if (!seen_.emplace(seed, records_.place()).second)
        records_.fail(fmt::format("seed '{}' is in {} already; name each seed once",
                                  io::readable(std::string(fields.front())), seen_[seed]));
      found_.push_back(seed);
    }
    return std::move(found_);
  }

 private:
  std::uint32_t by_index(std::string_view field) {
    std::uint32_t index = 0;
    const auto [end, failure] = std::from_chars(field.data(), field.data() + field.size(), index);
    if (failure != std::errc() || end != field.data() + field.size())
      records_.fail(
          fmt::format("'{}' is not the index of a seed, a whole number from 0; for names choose "
                      "their column with --id-column",
                      io::readable(std::string(field))));
    if (index >= count_)
      records_.fail(fmt::format("seed {} of {}, counted from 0; there is none", index, count_));
    return index;
  }

  std::uint32_t by_id(std::string_view field) {
    const auto found = ids_.seed.find(field);
    if (found == ids_.seed.end())
      records_.fail(fmt::format("no seed has the id '{}'", io::readable(std::string(field))));
    if (const auto repeated = ids_.repeated.find(field); repeated != ids_.repeated.end())
      records_.fail(
          fmt::format("{} seeds have the id '{}'; give them different ids, or leave --id-column out "
                      "and name seeds by their index",
                      repeated->second + 1, io::readable(std::string(field))));
    return found->second;
  }

  io::Records records_;
  Ids ids_;
  std::size_t count_;
  std::map<std::uint32_t, std::string> seen_;
  std::vector<std::uint32_t> found_;
};

}  // namespace

std::vector<std::uint32_t> read_only(const std::string& path, const io::SeedTable& seeds) {
  return OnlyReader(io::read_file(path), path, seeds).read();
}

}  // namespace powercell::app
