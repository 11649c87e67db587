#include "apps/io/write/table.hpp"

#include "apps/io/names.hpp"
#include "apps/io/tables/seed_rows.hpp"

namespace powercell::io {

SeedRows begin_table(const std::string& path, const SeedsView& seeds, const InputView& inputs) {
  return {path, seeds, inputs, {"status", "measure", "centroid", "second_moment", "neighbors"}};
}

void write_row(SeedRows& rows, std::size_t seed, const Measures& measures, std::size_t row,
               std::uint64_t neighbors) {
  rows.begin(seed);
  rows.fields().text(name(measures.status[row]));
  rows.fields().number(measures.mass[row]);
  rows.point(&measures.centroid[row * static_cast<std::size_t>(measures.dimension)]);
  rows.fields().number(measures.second_moment[row]);
  rows.fields().count(neighbors);
  rows.fields().end_row();
}

void write_table(const std::string& path, const SeedsView& seeds, const Measures& measures,
                 const Adjacency& adjacency, const InputView& inputs, std::span<const std::uint32_t> only) {
  SeedRows rows = begin_table(path, seeds, inputs);
  for (std::size_t i = 0; i < measures.mass.size(); ++i) {
    const bool listed = i + 1 < adjacency.offset.size();
    write_row(rows, only.empty() ? i : only[i], measures, i,
              listed ? adjacency.offset[i + 1] - adjacency.offset[i] : 0);
  }
  rows.commit();
}

namespace {

class WallTable {
 public:
  WallTable(const std::string& path, const InputView& inputs, const WallColumns& columns)
      : columns_(columns),
        table_(inputs.table != nullptr && inputs.table->text.columns > 0 ? inputs.table : nullptr),
        ids_(table_ != nullptr && table_->columns.id.has_value()),
        file_(path, table_ ? table_->text.separator : ',', table_ ? table_->text.mark : '.') {
    for (const char* column : {"seed", "neighbor", "measure"}) file_.text(column);
    for (int k = 0; k < columns.shift_axes; ++k) file_.text(std::string("s") + "xyz"[k]);
    if (columns.facets) file_.text("facet");
    if (ids_)
      for (const char* column : {"id", "neighbor_id"}) file_.text(column);
    file_.end_row();
  }

  void wall(std::size_t row, const Adjacency& adjacency, std::uint64_t e) {
    const std::uint32_t neighbor = adjacency.neighbor[e];
    file_.count(seed(row));
    file_.count(neighbor);
    file_.number(adjacency.wall[e]);
    for (int k = 0; k < columns_.shift_axes; ++k)
      file_.number(static_cast<double>(adjacency.shift[e][static_cast<std::size_t>(k)]));
    if (columns_.facets) file_.empty();
    id(seed(row));
    id(neighbor);
    file_.end_row();
  }

  void facet(std::size_t row, std::uint64_t k) {
    file_.count(seed(row));
    file_.empty();
    file_.number(columns_.facets->measure[k]);
    for (int axis = 0; axis < columns_.shift_axes; ++axis) file_.empty();
    file_.count(columns_.facets->facet[k]);
    id(seed(row));
    if (ids_) file_.empty();
    file_.end_row();
  }

  void commit() { file_.commit(); }

 private:
  std::size_t seed(std::size_t row) const { return columns_.only.empty() ? row : columns_.only[row]; }
  void id(std::size_t seed) {
    if (ids_) file_.text(table_->text.field(seed, *table_->columns.id));
  }

  const WallColumns& columns_;
  const SeedTable* table_;  // with a header, or null
  bool ids_;
  FieldWriter file_;
};

}  // namespace

void write_walls(const std::string& path, const Adjacency& adjacency, const InputView& inputs,
                 const WallColumns& columns) {
  WallTable table(path, inputs, columns);
  for (std::size_t row = 0; row + 1 < adjacency.offset.size(); ++row) {
    for (std::uint64_t e = adjacency.offset[row]; e < adjacency.offset[row + 1]; ++e)
      table.wall(row, adjacency, e);
    if (columns.facets)
      for (std::uint64_t k = columns.facets->offset[row]; k < columns.facets->offset[row + 1]; ++k)
        table.facet(row, k);
  }
  table.commit();
}

}  // namespace powercell::io
