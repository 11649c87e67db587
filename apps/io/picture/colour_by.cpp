// What the colours of the cells of a diagram show.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <powercell/error.hpp>

#include "apps/io/closest.hpp"
#include "apps/io/picture/colouring.hpp"
#include "apps/io/picture/colours.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read/text.hpp"
#include "apps/io/tables/fields.hpp"
#include "apps/io/write/output.hpp"

namespace powercell::io {
namespace {

using What = ColourBy::What;

std::vector<std::string_view> texts_of(const TableText& text, const KeptColumn& column) {
  std::vector<std::string_view> values;
  values.reserve(text.rows());
  for (std::size_t row = 0; row < text.rows(); ++row) values.push_back(text.field(row, column.index));
  return values;
}

std::string meant_column(const KeptColumns& kept, const std::string& name) {
  std::vector<std::string> names = {"measure", "weight", "neighbors"};
  for (const KeptColumn& column : kept.columns()) names.push_back(readable(column.name));
  return did_you_mean(closest(name, names));
}

std::string known_columns(const KeptColumns& kept) {
  constexpr std::size_t most = 12;
  if (kept.empty()) return "the seeds have no table with a header; known are measure, weight and neighbors";
  std::string names;
  for (std::size_t k = 0; k < std::min(most, kept.columns().size()); ++k)
    names += (k > 0 ? ", " : "") + readable(kept.columns()[k].name);
  if (kept.columns().size() > most) names += fmt::format(" and {} more", kept.columns().size() - most);
  return "the seeds' table has the columns " + names +
         "; beside them there are measure, weight and neighbors";
}

std::vector<double> numbers_of(const DiagramOutput& output) {
  const std::size_t n = output.measures.mass.size();
  std::vector<double> values(n, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < n; ++i) switch (output.style.colours.what) {
      case What::measure:
        values[i] = output.measures.mass[i];
        break;
      case What::weight:
        values[i] = output.seeds.weights.empty() ? 0 : output.seeds.weights[i];
        break;
      case What::neighbors:
        values[i] = static_cast<double>(output.adjacency.offset[i + 1] - output.adjacency.offset[i]);
        break;
      case What::column: {
        const TableText& text = output.inputs.table->text;
        double value = 0;
        if (parse_number(text.field(i, output.style.colours.column.index), text.mark, value) == Parsed::ok)
          values[i] = value;
        break;
      }
      case What::hues:
        break;
    }
  return values;
}

void name_legend(Legend& legend, const DiagramOutput& output) {
  const bool metres = output.inputs.plane() != nullptr;
  switch (output.style.colours.what) {
    case What::measure:
      legend.title = output.domain.cell_dimension() == 3 ? "volume" : "area";
      legend.unit = metres ? "m²" : "";
      break;
    case What::weight:
      legend.title = "weight";
      legend.unit = metres ? "m²" : "";
      break;
    case What::neighbors:
      legend.title = "neighbours";
      break;
    case What::column:
      legend.title = printable(output.style.colours.column.name);
      break;
    case What::hues:
      break;
  }
}

// Seeds without cells: flat pictures mark them.
void add_seeds_without_cells(Legend& legend, const DiagramOutput& output) {
  const bool marked = output.domain.kind() == DomainKind::polygon && output.seeds.size() <= most_discs;
  const auto add = [&](SeedStatus status, Legend::Mark mark, const char* name) {
    const std::size_t count = output.measures.count(status);
    if (count == 0) return;
    legend.entries.push_back({marked ? mark : Legend::Mark::none, ink,
                              marked ? fmt::format("{} ({})", name, with_commas(count))
                                     : fmt::format("{}: {}", name, with_commas(count))});
  };
  add(SeedStatus::hidden, Legend::Mark::hidden, "hidden");
  add(SeedStatus::duplicate, Legend::Mark::duplicate, "duplicate");
}

}  // namespace

ColourBy colour_by(const std::string& name, const InputView& inputs, const SeedsView& seeds) {
  if (name == "measure") return {What::measure, {}};
  if (name == "weight") return {What::weight, {}};
  if (name == "neighbors") return {What::neighbors, {}};
  const KeptColumns kept(inputs, seeds, {"measure", "neighbors"});
  const auto find = [&](const auto& is_it) {
    return std::find_if(kept.columns().begin(), kept.columns().end(), is_it);
  };
  auto found = find([&](const KeptColumn& column) { return column.name == name; });
  if (found == kept.columns().end())
    found = find([&](const KeptColumn& column) { return column_name(column.name) == column_name(name); });
  if (found == kept.columns().end() && (name == "area" || name == "volume")) return {What::measure, {}};
  if (found == kept.columns().end())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("--color-by {}: there is no such column{}; {}", readable(name),
                            meant_column(kept, name), known_columns(kept)));
  if (found->type == KeptColumn::Type::text) check_classes(texts_of(inputs.table->text, *found), found->name);
  return {What::column, *found};
}

Colouring colouring_of(const DiagramOutput& output) {
  const std::size_t n = output.measures.mass.size();
  const ColourBy& by = output.style.colours;
  if (by.what == What::hues) return {cell_colours(output.adjacency, n), {}, {}};
  std::vector<char> shown(n);
  for (std::size_t i = 0; i < n; ++i) shown[i] = output.measures.status[i] == SeedStatus::ok ? 1 : 0;
  const bool text = by.what == What::column && by.column.type == KeptColumn::Type::text;
  const bool whole =
      by.what == What::neighbors || (by.what == What::column && by.column.type == KeptColumn::Type::whole);
  Colouring colouring = text ? colours_of_texts(texts_of(output.inputs.table->text, by.column), shown)
                             : colours_of_numbers(numbers_of(output), shown, whole);
  name_legend(colouring.legend, output);
  if (output.domain.kind() != DomainKind::polygon)  // whose cells are shaded instead of striped
    for (Legend::Entry& entry : colouring.legend.entries)
      if (entry.mark == Legend::Mark::no_value) entry.mark = Legend::Mark::colour;
  add_seeds_without_cells(colouring.legend, output);
  if (!output.style.legend) colouring.legend = {};
  return colouring;
}

}  // namespace powercell::io
