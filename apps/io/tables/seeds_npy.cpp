// Seeds as a NumPy array (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html).
#include "apps/io/tables/seeds_npy.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "apps/io/read/bytes.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/tables/read_seeds.hpp"

namespace powercell::io {
namespace {

struct Array {
  NumberType type = NumberType::f64;
  bool swapped = false;
  bool fortran = false;
  std::uint64_t rows = 0, columns = 0;
};

// The text after `'key':` in the header, which is the literal of a Python dict.
std::string_view value_of(std::string_view header, std::string_view key, const std::string& name) {
  std::size_t at = header.find(fmt::format("'{}'", key));
  if (at != std::string_view::npos) at = header.find(':', at);
  if (at != std::string_view::npos) at = header.find_first_not_of(' ', at + 1);
  if (at == std::string_view::npos) fail_file(name, fmt::format("the header of the array has no '{}'", key));
  return header.substr(at);
}

void read_type(std::string_view header, Array& array, const std::string& name) {
  std::string_view descr = value_of(header, "descr", name);
  if (!descr.starts_with('\''))
    fail_file(name, "is a structured array; save plain columns, e.g. numpy.column_stack");
  descr = descr.substr(1, descr.find('\'', 1) == std::string_view::npos ? 0 : descr.find('\'', 1) - 1);
  const std::string_view shown = descr;
  if (!descr.empty() && std::string_view("<>|=").find(descr[0]) != std::string_view::npos) {
    array.swapped =
        (descr[0] == '>') != (std::endian::native == std::endian::big) && descr[0] != '|' && descr[0] != '=';
    descr.remove_prefix(1);
  }
  constexpr std::pair<std::string_view, NumberType> known[] = {
      {"f4", NumberType::f32}, {"f8", NumberType::f64}, {"i1", NumberType::i8}, {"i2", NumberType::i16},
      {"i4", NumberType::i32}, {"i8", NumberType::i64}, {"u1", NumberType::u8}, {"u2", NumberType::u16},
      {"u4", NumberType::u32}, {"u8", NumberType::u64}};
  for (const auto& [word, type] : known) {
    if (descr != word) continue;
    array.type = type;
    return;
  }
  fail_file(name, fmt::format("numbers of type '{}' are not read; convert with .astype(float)",
                              shown.substr(0, 40)));
}

void read_shape(std::string_view header, Array& array, const std::string& name) {
  const std::string_view shape = value_of(header, "shape", name);
  const std::size_t close = shape.find(')');
  std::vector<std::uint64_t> extents;
  for (std::size_t at = 1; shape.starts_with('(') && close != std::string_view::npos && at < close;) {
    std::uint64_t extent = 0;
    const auto [end, code] = std::from_chars(shape.data() + at, shape.data() + close, extent);
    if (code != std::errc()) fail_file(name, "the header of the array has a shape that cannot be read");
    extents.push_back(extent);
    at = static_cast<std::size_t>(end - shape.data());
    while (at < close && (shape[at] == ',' || shape[at] == ' ' || shape[at] == 'L')) ++at;
  }
  if (extents.size() != 2)
    fail_file(name, fmt::format("is an array of {} dimensions; seeds are rows: shape (n, d) or (n, d + 1)",
                                extents.size()));
  array.rows = extents[0];
  array.columns = extents[1];
}

// Leaves the scanner at the first number.
Array read_header(std::string_view bytes, ByteScanner& scanner, const std::string& name) {
  if (!bytes.starts_with("\x93NUMPY")) fail_file(name, "does not begin as a .npy file");
  scanner.skip(6, 1, "the header");
  const auto version = scanner.next<std::uint8_t>("the header");
  scanner.skip(1, 1, "the header");
  if (version < 1 || version > 3) fail_file(name, fmt::format("version {} of .npy is not known", version));
  const std::size_t length =
      version == 1 ? scanner.next<std::uint16_t>("the header") : scanner.next<std::uint32_t>("the header");
  scanner.need(length, 1, "the header");
  const std::string_view header = bytes.substr(scanner.offset(), length);
  scanner.skip(length, 1, "the header");
  Array array;
  read_type(header, array, name);
  array.fortran = value_of(header, "fortran_order", name).starts_with("True");
  read_shape(header, array, name);
  return array;
}

}  // namespace

NpySeeds::NpySeeds(std::string_view bytes, int dimension, const std::string& name)
    : name_(name), d_(static_cast<std::size_t>(dimension)) {
  ByteScanner scanner(bytes, name, std::endian::little);
  const Array array = read_header(bytes, scanner, name);
  if (array.columns != d_ && array.columns != d_ + 1) {
    fail_file(name,
              fmt::format("has {} columns; seeds of this domain have {} coordinates and may have a weight",
                          array.columns, d_));
  }
  scanner.need(array.rows, array.columns * size_of(array.type), "the array");
  begin_ = bytes.data() + scanner.offset();
  type_ = array.type;
  swapped_ = array.swapped;
  fortran_ = array.fortran;
  rows_ = array.rows;
  columns_ = array.columns;
}

void NpySeeds::read(std::uint64_t first, std::span<double> positions, std::span<double> weights) const {
  const std::size_t size = size_of(type_);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const std::uint64_t row = first + k;
    weights[k] = 0;
    for (std::size_t column = 0; column < columns_; ++column) {
      const std::size_t at = fortran_ ? column * rows_ + row : row * columns_ + column;
      const double value = load_number(begin_ + at * size, type_, swapped_);
      if (!std::isfinite(value)) {
        throw Error(ErrorCode::invalid_seed,
                    fmt::format("{}: seed {} (row from 0), column {}: {} is not finite; take the seed "
                                "out or give it a finite value",
                                name_, row, column, value));
      }
      (column < d_ ? positions[k * d_ + column] : weights[k]) = value;
    }
  }
}

SeedTable parse_seeds_npy(std::string_view bytes, int dimension, const std::string& name) {
  const NpySeeds seeds(bytes, dimension, name);
  SeedTable table;
  table.dimension = dimension;
  table.positions.resize(seeds.rows() * static_cast<std::size_t>(dimension));
  table.weights.resize(seeds.rows());
  seeds.read(0, table.positions, table.weights);
  return table;
}

}  // namespace powercell::io
