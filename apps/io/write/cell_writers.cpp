#include "apps/io/write/cell_writers.hpp"

#include <fmt/format.h>

#include <optional>

#include "apps/io/write/npy.hpp"
#include "apps/io/write/table.hpp"

namespace powercell::io {
namespace {

class CsvTable : public CellWriter {
 public:
  CsvTable(const std::string& path, int dimension) : rows_(begin_table(path, {dimension, {}, {}})) {}

  void add(const CellBatch& cells) override {
    rows_.use(cells.seeds, cells.first);
    for (std::size_t i = 0; i < cells.measures.mass.size(); ++i)
      write_row(rows_, cells.first + i, cells.measures, i, cells.offset[i + 1] - cells.offset[i]);
  }
  void commit() override { rows_.commit(); }

 private:
  SeedRows rows_;
};

std::string table_type(int dimension) {
  std::string fields;
  const auto add = [&fields](std::string_view name, std::string_view type) {
    fields += fmt::format("{}('{}', {})", fields.empty() ? "" : ", ", name, npy_type(type));
  };
  add("status", "u1");
  add("measure", "f8");
  for (const char* name : {"cx", "cy", "cz"})
    if (dimension-- > 0) add(name, "f8");
  add("second_moment", "f8");
  add("neighbors", "u4");
  return "[" + fields + "]";
}

class NpyTable : public CellWriter {
 public:
  NpyTable(const std::string& path, int dimension, std::uint64_t seeds)
      : d_(static_cast<std::size_t>(dimension)), array_(path, table_type(dimension), seeds) {}

  void add(const CellBatch& cells) override {
    const Measures& measures = cells.measures;
    for (std::size_t i = 0; i < measures.mass.size(); ++i) {
      array_.number(static_cast<std::uint8_t>(measures.status[i]));
      array_.number(measures.mass[i]);
      for (std::size_t k = 0; k < d_; ++k) array_.number(measures.centroid[i * d_ + k]);
      array_.number(measures.second_moment[i]);
      array_.number(static_cast<std::uint32_t>(cells.offset[i + 1] - cells.offset[i]));
    }
  }
  void commit() override { array_.commit(); }

 private:
  std::size_t d_;
  NpyWriter array_;
};

constexpr std::array<const char*, 3> shift_names{"sx", "sy", "sz"};

std::string shift_type(int shift_axes) {
  std::string fields;
  for (std::size_t k = 0; k < static_cast<std::size_t>(shift_axes); ++k)
    fields += fmt::format("{}('{}', {})", k == 0 ? "" : ", ", shift_names[k], npy_type("i4"));
  return "[" + fields + "]";
}

class CsvWalls : public CellWriter {
 public:
  CsvWalls(const std::string& path, int shift_axes)
      : file_(path, ','), shift_axes_(static_cast<std::size_t>(shift_axes)) {
    for (const char* column : {"seed", "neighbor", "measure"}) file_.text(column);
    for (std::size_t k = 0; k < shift_axes_; ++k) file_.text(shift_names[k]);
    file_.end_row();
  }

  void add(const CellBatch& cells) override {
    const std::uint64_t before = cells.offset[0];
    for (std::size_t i = 0; i + 1 < cells.offset.size(); ++i)
      for (std::uint64_t k = cells.offset[i] - before; k < cells.offset[i + 1] - before; ++k) {
        file_.count(cells.first + i);
        file_.count(cells.neighbor[k]);
        file_.number(cells.wall[k]);
        for (std::size_t axis = 0; axis < shift_axes_; ++axis)
          file_.number(static_cast<double>(cells.shift[k][axis]));
        file_.end_row();
      }
  }
  void commit() override { file_.commit(); }

 private:
  FieldWriter file_;
  std::size_t shift_axes_;
};

class NpyWalls : public CellWriter {
 public:
  NpyWalls(const std::vector<std::string>& paths, std::uint64_t seeds, std::uint64_t walls, int shift_axes)
      : indptr_(paths[0], npy_type("i8"), seeds + 1),
        indices_(paths[1], npy_type("i4"), walls),
        data_(paths[2], npy_type("f8"), walls),
        shift_axes_(static_cast<std::size_t>(shift_axes)) {
    indptr_.number(std::int64_t{0});
    if (shift_axes > 0) shift_.emplace(paths[3], shift_type(shift_axes), walls);
  }

  void add(const CellBatch& cells) override {
    for (std::size_t i = 1; i < cells.offset.size(); ++i)
      indptr_.number(static_cast<std::int64_t>(before_ + cells.offset[i] - cells.offset[0]));
    before_ += cells.neighbor.size();
    for (const std::uint64_t neighbor : cells.neighbor) indices_.number(static_cast<std::int32_t>(neighbor));
    for (const double wall : cells.wall) data_.number(wall);
    for (const std::array<std::int32_t, 3>& shift : cells.shift)
      for (std::size_t k = 0; k < shift_axes_; ++k) shift_->number(shift[k]);
  }
  void commit() override {
    if (shift_) shift_->commit();
    indptr_.commit();
    indices_.commit();
    data_.commit();
  }

 private:
  NpyWriter indptr_, indices_, data_;
  std::optional<NpyWriter> shift_;
  std::size_t shift_axes_;
  std::uint64_t before_ = 0;  // walls of the cells so far
};

}  // namespace

std::unique_ptr<CellWriter> table_writer(const std::string& path, int dimension, std::uint64_t seeds) {
  if (is_npy(path)) return std::make_unique<NpyTable>(path, dimension, seeds);
  return std::make_unique<CsvTable>(path, dimension);
}

std::vector<std::string> walls_files(const std::string& path, int shift_axes) {
  if (!is_npy(path)) return {path};
  const std::string stem = path.substr(0, path.size() - std::string_view(".npy").size());
  std::vector<std::string> files{stem + ".indptr.npy", stem + ".indices.npy", stem + ".data.npy"};
  if (shift_axes > 0) files.push_back(stem + ".shift.npy");
  return files;
}

std::unique_ptr<CellWriter> walls_writer(const std::string& path, std::uint64_t seeds, std::uint64_t walls,
                                         int shift_axes) {
  if (is_npy(path))
    return std::make_unique<NpyWalls>(walls_files(path, shift_axes), seeds, walls, shift_axes);
  return std::make_unique<CsvWalls>(path, shift_axes);
}

}  // namespace powercell::io
