#include "apps/io/read/vtu_data.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>

#include "apps/io/read/bytes.hpp"
#include "apps/io/read/file.hpp"

namespace powercell::io {
namespace {

// An upper bound of zlib's compression ratio (1032 in its technical notes).
constexpr std::uint64_t best_compression = 1040;

std::array<int, 256> base64_values() {
  std::array<int, 256> values;
  values.fill(-1);
  const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t k = 0; k < digits.size(); ++k)
    values[static_cast<unsigned char>(digits[k])] = static_cast<int>(k);
  return values;
}

// Decodes `text` up to its end or its first padding '=', and removes that part.
std::string base64(std::string_view& text, std::size_t most_bytes, const std::string& name) {
  static const std::array<int, 256> values = base64_values();
  std::string bytes;
  bytes.reserve(std::min(most_bytes, text.size() / 4 * 3 + 3));
  std::uint32_t bits = 0;
  int digits = 0;
  std::size_t at = 0;
  for (; at < text.size() && bytes.size() < most_bytes; ++at) {
    const char c = text[at];
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    if (c == '=') break;
    const int value = values[static_cast<unsigned char>(c)];
    if (value < 0)
      fail_file(name, fmt::format("byte 0x{:02x} in base64 data", static_cast<unsigned char>(c)));
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    if (++digits == 4) {
      for (int shift : {16, 8, 0}) bytes += static_cast<char>(bits >> shift & 0xff);
      bits = 0;
      digits = 0;
    }
  }
  if (digits >= 2) bytes += static_cast<char>(bits >> (digits == 2 ? 4 : 10) & 0xff);
  if (digits == 3) bytes += static_cast<char>(bits >> 2 & 0xff);
  while (at < text.size() && text[at] == '=') ++at;
  text.remove_prefix(at);
  if (bytes.size() > most_bytes) bytes.resize(most_bytes);
  return bytes;
}

std::uint64_t header_number(std::string_view header, std::size_t k, const VtuStorage& storage,
                            const std::string& name) {
  if (header.size() / storage.header_bytes <= k) fail_file(name, "the header of an array is truncated");
  const char* at = header.data() + k * storage.header_bytes;
  const bool swapped = swapped_from(storage.order);
  return storage.header_bytes == 8 ? load_number<std::uint64_t>(at, swapped)
                                   : load_number<std::uint32_t>(at, swapped);
}

// Numbers in the header of a compressed array: blocks, bytes of a block, bytes of the last, then the
// compressed bytes of each block.
struct Blocks {
  std::uint64_t count, size, last;
  std::uint64_t header_bytes;
};

Blocks read_blocks(std::string_view header, std::size_t bytes_left, const VtuStorage& storage,
                   const std::string& name) {
  Blocks blocks{header_number(header, 0, storage, name), header_number(header, 1, storage, name),
                header_number(header, 2, storage, name), 0};
  if (blocks.count > bytes_left / storage.header_bytes) {
    fail_file(name, fmt::format("a compressed array announces {} blocks, more than the file can hold",
                                blocks.count));
  }
  blocks.header_bytes = (3 + blocks.count) * storage.header_bytes;
  return blocks;
}

std::string inflate_blocks(std::string_view header, const Blocks& blocks, std::string_view data,
                           const VtuStorage& storage, const std::string& name) {
  std::string bytes;
  for (std::uint64_t b = 0; b < blocks.count; ++b) {
    const std::uint64_t packed = header_number(header, 3 + b, storage, name);
    const std::uint64_t plain = b + 1 == blocks.count && blocks.last != 0 ? blocks.last : blocks.size;
    if (packed > data.size()) fail_file(name, fmt::format("block {} of a compressed array is truncated", b));
    if (plain / best_compression > packed)
      fail_file(name, fmt::format("block {} of a compressed array announces {} bytes, more than it can hold",
                                  b, plain));
    const std::size_t before = bytes.size();
    bytes.resize(before + static_cast<std::size_t>(plain));
    uLongf got = static_cast<uLongf>(plain);
    const int code = uncompress(reinterpret_cast<Bytef*>(bytes.data() + before), &got,
                                reinterpret_cast<const Bytef*>(data.data()), static_cast<uLong>(packed));
    if (code != Z_OK || got != plain)
      fail_file(name, fmt::format("block {} of a compressed array is damaged (zlib: {})", b, zError(code)));
    data.remove_prefix(static_cast<std::size_t>(packed));
  }
  return bytes;
}

}  // namespace

std::string decode_vtu_base64(std::string_view text, const VtuStorage& storage, const std::string& name) {
  while (!text.empty() &&
         (text.front() == ' ' || text.front() == '\n' || text.front() == '\r' || text.front() == '\t'))
    text.remove_prefix(1);
  if (!storage.compressed) {
    std::string_view rest = text;
    const std::uint64_t size = header_number(base64(rest, storage.header_bytes, name), 0, storage, name);
    if (size > text.size())
      fail_file(name, fmt::format("an array announces {} bytes, more than the file has left", size));
    // Usually one base64 run contains the header and the data; if the header has its own padding, `rest`
    // begins after it.
    const bool own_run = rest.data() != text.data() && *(rest.data() - 1) == '=';
    std::string_view run = own_run ? rest : text;
    std::string bytes =
        base64(run, static_cast<std::size_t>(size) + (own_run ? 0 : storage.header_bytes), name);
    if (!own_run) bytes.erase(0, storage.header_bytes);
    if (bytes.size() < size)
      fail_file(name,
                fmt::format("an array of {} bytes ends after {}; the file is truncated", size, bytes.size()));
    return bytes;
  }
  std::string_view probe = text;
  const Blocks blocks =
      read_blocks(base64(probe, 3 * storage.header_bytes, name), text.size(), storage, name);
  const std::string header = base64(text, static_cast<std::size_t>(blocks.header_bytes), name);
  std::uint64_t packed = 0;
  for (std::uint64_t b = 0; b < blocks.count; ++b)
    packed += std::min<std::uint64_t>(header_number(header, 3 + b, storage, name), text.size());
  const std::string data =
      base64(text, static_cast<std::size_t>(std::min<std::uint64_t>(packed, text.size())), name);
  return inflate_blocks(header, blocks, data, storage, name);
}

std::string decode_vtu_raw(std::string_view bytes, const VtuStorage& storage, const std::string& name) {
  if (!storage.compressed) {
    const std::uint64_t size = header_number(bytes, 0, storage, name);
    bytes.remove_prefix(storage.header_bytes);
    if (size > bytes.size())
      fail_file(name, fmt::format("an array announces {} bytes, but {} are left; the file is truncated", size,
                                  bytes.size()));
    return std::string(bytes.substr(0, static_cast<std::size_t>(size)));
  }
  const Blocks blocks = read_blocks(bytes, bytes.size(), storage, name);
  if (blocks.header_bytes > bytes.size()) fail_file(name, "the header of a compressed array is truncated");
  return inflate_blocks(bytes, blocks, bytes.substr(static_cast<std::size_t>(blocks.header_bytes)), storage,
                        name);
}

namespace {

template <class Out, class In>
std::vector<Out> convert(std::string_view bytes, bool swapped, const std::string& name) {
  if (bytes.size() % sizeof(In) != 0)
    fail_file(name, fmt::format("an array of {} bytes does not hold whole numbers of {} bytes", bytes.size(),
                                sizeof(In)));
  std::vector<Out> values(bytes.size() / sizeof(In));
  for (std::size_t k = 0; k < values.size(); ++k)
    // NOLINTNEXTLINE(bugprone-signed-char-misuse): In may be Int8
    values[k] = static_cast<Out>(load_number<In>(bytes.data() + k * sizeof(In), swapped));
  return values;
}

NumberType type_of(const std::string& word, const std::string& name) {
  constexpr std::pair<std::string_view, NumberType> known[] = {
      {"Int8", NumberType::i8},    {"UInt8", NumberType::u8},   {"Int16", NumberType::i16},
      {"UInt16", NumberType::u16}, {"Int32", NumberType::i32},  {"UInt32", NumberType::u32},
      {"Int64", NumberType::i64},  {"UInt64", NumberType::u64}, {"Float32", NumberType::f32},
      {"Float64", NumberType::f64}};
  for (const auto& [type_word, type] : known) {
    if (word == type_word) return type;
  }
  fail_file(name, fmt::format("arrays of type '{}' are not read", word.substr(0, 40)));
}

}  // namespace

std::vector<double> vtu_doubles(std::string_view bytes, const std::string& type, const VtuStorage& storage,
                                const std::string& name) {
  return with_number_type(type_of(type, name), [&](auto number) {
    return convert<double, decltype(number)>(bytes, swapped_from(storage.order), name);
  });
}

std::vector<std::int64_t> vtu_integers(std::string_view bytes, const std::string& type,
                                       const VtuStorage& storage, const std::string& name) {
  const NumberType known = type_of(type, name);
  if (known == NumberType::f32 || known == NumberType::f64)
    fail_file(name, fmt::format("an array of type '{}' instead of integers", type));
  return with_number_type(known, [&](auto number) {
    return convert<std::int64_t, decltype(number)>(bytes, swapped_from(storage.order), name);
  });
}

}  // namespace powercell::io
