#include "apps/io/write_table.hpp"

#include "apps/io/names.hpp"
#include "apps/io/seed_rows.hpp"

namespace powercell::io {

void write_table(const std::string& path, const SeedsView& seeds, const Measures& measures,
                 const Adjacency& adjacency, const InputView& inputs) {
  SeedRows rows(path, seeds, inputs, {"status", "measure", "centroid", "second_moment", "neighbors"});
  const auto d = static_cast<std::size_t>(seeds.dimension);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    rows.begin(i);
    rows.fields().text(name(measures.status[i]));
    rows.fields().number(measures.mass[i]);
    rows.point(&measures.centroid[i * d]);
    rows.fields().number(measures.second_moment[i]);
    const bool listed = i + 1 < adjacency.offset.size();
    rows.fields().count(listed ? adjacency.offset[i + 1] - adjacency.offset[i] : 0);
    rows.fields().end_row();
  }
  rows.commit();
}

void write_walls(const std::string& path, const Adjacency& adjacency, const InputView& inputs,
                 int shift_axes) {
  const SeedTable* table = inputs.table;
  const bool like_table = table != nullptr && table->text.columns > 0;
  const bool ids = like_table && table->columns.id.has_value();
  FieldWriter file(path, like_table ? table->text.separator : ',', like_table ? table->text.mark : '.');
  for (const char* column : {"seed", "neighbor", "measure"}) file.text(column);
  const auto axes = static_cast<std::size_t>(shift_axes);
  for (std::size_t k = 0; k < axes; ++k) file.text(std::string("s") + "xyz"[k]);
  if (ids)
    for (const char* column : {"id", "neighbor_id"}) file.text(column);
  file.end_row();
  for (std::size_t i = 0; i + 1 < adjacency.offset.size(); ++i) {
    for (std::uint64_t e = adjacency.offset[i]; e < adjacency.offset[i + 1]; ++e) {
      file.count(i);
      file.count(adjacency.neighbor[e]);
      file.number(adjacency.wall[e]);
      for (std::size_t k = 0; k < axes; ++k) file.number(static_cast<double>(adjacency.shift[e][k]));
      if (ids)
        for (const std::size_t seed : {i, std::size_t{adjacency.neighbor[e]}})
          file.text(table->text.field(seed, *table->columns.id));
      file.end_row();
    }
  }
  file.commit();
}

}  // namespace powercell::io
