/// \file
/// A file of seeds that is larger than memory.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "apps/io/read/mapped_bytes.hpp"
#include "apps/io/tables/read_seeds.hpp"
#include "apps/io/tables/seeds_npy.hpp"
#include "apps/io/tables/seeds_text.hpp"

namespace powercell::io {

/// Seeds of an .npy, or of text or CSV, some at a time. Text is read once to count its seeds.
class SeedStream {
 public:
  /// \param otherwise  what to do with other kinds of seeds, for the messages: "leave --memory out"
  /// \throw Error invalid_file, invalid_seed, invalid_argument (other kinds of seeds)
  SeedStream(const std::string& path, int dimension, const ColumnChoice& choice,
             const std::string& otherwise);

  std::uint64_t count() const { return count_; }
  const SeedColumns& columns() const { return columns_; }  ///< of text
  /// Tells this file, as it is, and the columns from others, and from itself after a change.
  std::string stamp() const { return file_.stamp() + choice_name_; }
  /// Reads the seeds first, first + 1, ...: as many as there are weights. Text is read from its beginning if
  /// these do not follow those before.
  /// \throw Error as the constructor
  void read(std::uint64_t first, std::span<double> positions, std::span<double> weights);
  /// \throw Error invalid_file if somebody has written to the file
  void require_unchanged() const;

 private:
  void begin_text();

  std::string path_, choice_name_;
  int dimension_;
  ColumnChoice choice_;
  MappedBytes file_;
  std::optional<NpySeeds> array_;
  std::unique_ptr<SeedText> text_;  // if it is none
  std::uint64_t text_next_ = 0;     // the seed that text_ reads next
  std::uint64_t count_ = 0;
  SeedColumns columns_;
};

}  // namespace powercell::io
