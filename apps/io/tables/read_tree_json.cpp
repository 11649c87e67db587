// Nested objects {name, children, value}, and lists of rows {id, parent, name, value}.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <powercell/error.hpp>
#include <unordered_map>

#include "apps/io/closest.hpp"
#include "apps/io/printable.hpp"
#include "apps/io/read/file.hpp"
#include "apps/io/read/text.hpp"
#include "apps/io/tables/read_tree_rows.hpp"

namespace powercell::io {
namespace {

using nlohmann::json;

json parse(std::string_view text, const std::string& name) {
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    fail_line(name, line_of(text, error.byte > 0 ? error.byte - 1 : 0),
              fmt::format("is not JSON from this line on: {}", error.what()));
  } catch (const json::out_of_range& error) {  // a number beyond doubles
    fail_file(name, fmt::format("holds a number beyond the range of doubles: {}", error.what()));
  }
}

const json* member(const json& object, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    const auto found = object.find(key);
    if (found != object.end() && !found->is_null()) return &*found;
  }
  return nullptr;
}

// A string, or a number as JSON writes it; anything else is refused. `place` returns the place for messages.
template <class Place>
std::string as_text(const json* value, const char* what, const std::string& file, const Place& place) {
  if (!value) return {};
  if (value->is_string()) return value->get<std::string>();
  if (value->is_number()) return value->dump();
  fail_file(file, fmt::format("{}: its {} is neither a string nor a number", place(), what));
}

template <class Place>
double as_value(const json& object, const TreeColumnNames& named, const std::string& file,
                const Place& place) {
  const json* value = named.value.empty() ? member(object, {"value", "size", "weight"})
                                          : member(object, {named.value.c_str()});
  if (!value) return 0;
  if (!value->is_number())
    fail_file(file, fmt::format("{}: its value {} is not a number", place(), value->dump().substr(0, 40)));
  const double number = value->get<double>();
  if (!std::isfinite(number)) fail_file(file, fmt::format("{}: its value is not finite", place()));
  return number;
}

// The member that colours come from, as text; empty if the object has none.
template <class Place>
std::string colour_of(const json& object, const std::string& colours, const std::string& file,
                      const Place& place) {
  const json* value = colours.empty() ? nullptr : member(object, {colours.c_str()});
  if (value && value->is_boolean()) return value->dump();
  return as_text(value, "colour", file, place);
}

const json* id_of_row(const json& object) {
  return member(object, {"id", "nodeId"});
}

// The parent of a row under any name that begins so: parentId, "parent name".
const json* parent_of_row(const json& object) {
  if (const json* parent = member(object, {"parent", "parentId"})) return parent;
  for (const auto& [key, value] : object.items())
    if (lower_case(key).starts_with("parent") && !value.is_null()) return &value;
  return nullptr;
}

// Rows of the columns {labels, parents, values, ids} that plotly has; null if there are none.
json rows_of_columns(const json& object, const TreeColumnNames& named, const std::string& file) {
  const json* parents = member(object, {"parents"});
  const json* labels = member(object, {"labels", "ids"});
  if (!parents || !parents->is_array() || !labels || !labels->is_array()) return nullptr;
  json rows = json::array();
  for (std::size_t k = 0; k < parents->size(); ++k) rows.push_back(json::object());
  const auto take = [&](const char* column, const std::string& key) {
    const json* values = member(object, {column});
    if (!values) return;
    if (!values->is_array() || values->size() != rows.size())
      fail_file(file, fmt::format("'{}' is not a list as long as 'parents'", column));
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k][key] = (*values)[k];
  };
  take("parents", "parent");
  take("labels", "name");
  take("ids", "id");
  take("values", "value");
  for (const std::string& column : {named.value, named.colours})
    if (!column.empty()) take(column.c_str(), column);
  return rows;
}

NamedTree read_list(const json& list, const std::string& name, const TreeColumnNames& named) {
  std::vector<TreeRow> rows;
  const bool has_ids = std::any_of(
      list.begin(), list.end(), [](const json& object) { return object.is_object() && id_of_row(object); });
  rows.reserve(list.size());
  for (std::size_t k = 0; k < list.size(); ++k) {
    const auto place = [&] { return fmt::format("element {}", k + 1); };
    const json& object = list[k];
    if (!object.is_object()) fail_file(name, place() + ": is not an object {id, parent, name, value}");
    TreeRow row;
    row.place = k + 1;
    row.name = as_text(member(object, {"name", "label"}), "name", name, place);
    row.id = has_ids ? as_text(id_of_row(object), "id", name, place) : row.name;
    if (row.id.empty()) fail_file(name, place() + (has_ids ? ": has no id" : ": has no id and no name"));
    row.parent = as_text(parent_of_row(object), "parent", name, place);
    row.value = as_value(object, named, name, place);
    row.colour = colour_of(object, named.colours, name, place);
    rows.push_back(std::move(row));
  }
  return link_rows(std::move(rows), name, false,
                   has_ids ? "" : "names stand for ids here: give each an id too");
}

// Ids are the names from the root to the node, joined by slashes, with "#2" and so on appended to repeated
// ones. Their total size grows with the square of the depth.
constexpr std::size_t most_id_bytes = std::size_t{1} << 28;

class Nested {
 public:
  Nested(const std::string& file, const TreeColumnNames& named) : file_(file), named_(named) {}

  NamedTree read(const json& root) {
    std::vector<std::pair<const json*, std::int64_t>> open = {{&root, -1}};
    while (!open.empty()) {
      const auto [object, parent] = open.back();
      open.pop_back();
      const std::int64_t node = add(*object, parent);
      const json* children = object->is_object() ? member(*object, {"children"}) : nullptr;
      if (!children) continue;
      if (!children->is_array()) refuse(node, "its children are not a list");
      for (std::size_t k = children->size(); k-- > 0;) open.emplace_back(&(*children)[k], node);
    }
    return std::move(tree_);
  }

 private:
  [[noreturn]] void refuse(std::int64_t node, const std::string& what) const {
    fail_file(file_, fmt::format("'{}': {}", tree_.id[static_cast<std::size_t>(node)], what));
  }

  std::int64_t add(const json& object, std::int64_t parent) {
    const auto node = static_cast<std::int64_t>(tree_.size());
    const std::string above = parent < 0 ? "" : tree_.id[static_cast<std::size_t>(parent)] + "/";
    if (!object.is_object())
      fail_file(file_, fmt::format("a child of '{}' is not an object {{name, children, value}}", above));
    std::string name = as_text(member(object, {"name", "label", "id"}), "name", file_,
                               [&] { return "below '" + above + "'"; });
    if (name.empty()) name = parent < 0 ? "root" : fmt::format("child {}", node);
    tree_.id.push_back(free_id(above + name));
    id_bytes_ += tree_.id.back().size();
    if (id_bytes_ > most_id_bytes)
      fail_file(
          file_,
          "is nested so deeply that the paths of its nodes exceed 256 MiB; give a list of rows {id, parent, "
          "name, value}");
    tree_.name.push_back(std::move(name));
    tree_.parent.push_back(parent);
    const auto place = [&] { return "'" + tree_.id[static_cast<std::size_t>(node)] + "'"; };
    tree_.value.push_back(as_value(object, named_, file_, place));
    tree_.colour.push_back(colour_of(object, named_.colours, file_, place));
    return node;
  }

  std::string free_id(const std::string& path) {
    std::string id = path;
    if (const auto known = used_.find(path); known != used_.end()) {
      do id = fmt::format("{}#{}", path, ++known->second);
      while (used_.contains(id));
    }
    used_.emplace(id, 1);
    return id;
  }

  const std::string& file_;
  const TreeColumnNames& named_;
  NamedTree tree_;
  std::unordered_map<std::string, int> used_;  // ids, and the number of nodes with that path
  std::size_t id_bytes_ = 0;
};

void add_polygon(const json& element, EarlierLayout& layout, std::size_t place, const std::string& name) {
  const json* polygon = element.is_object() ? member(element, {"polygon"}) : nullptr;
  const auto refuse = [&](const char* what) {
    fail_file(
        name,
        fmt::format("element {}: {}; an earlier layout is a file written by 'powercell treemap -o FILE.json'",
                    place, what));
  };
  if (!polygon || !polygon->is_array()) refuse("has no polygon");
  for (const json& point : *polygon) {
    if (!point.is_array() || point.size() != 2 || !point[0].is_number() || !point[1].is_number())
      refuse("its polygon has a corner that is not [x, y]");
    layout.vertices.push_back(point[0].get<double>());
    layout.vertices.push_back(point[1].get<double>());
  }
}

/// -1 if missing, as in files of earlier versions.
/// \param key  "hue" or "shade"
std::int64_t number_of(const json& element, const char* key) {
  constexpr std::int64_t most = 1'000'000'000;  // more branches have no colours of their own
  const json* hue = member(element, {key});
  if (!hue || !hue->is_number_integer()) return -1;
  const auto number = hue->get<std::int64_t>();
  return number >= 0 && number <= most ? number : -1;
}

// The members of the first object, and of the first child in that.
std::vector<std::string> members_of(const json& document) {
  std::vector<std::string> names;
  const json* object = document.is_array() && !document.empty() ? &document.front() : &document;
  while (object->is_object()) {
    for (const auto& [name, value] : object->items()) names.push_back(name);
    const json* children = member(*object, {"children"});
    if (!children || !children->is_array() || children->empty()) break;
    object = &children->front();
  }
  return names;
}

}  // namespace

NamedTree parse_tree_json(std::string_view text, const std::string& name, const TreeColumnNames& named) {
  const json document = parse(text, name);
  if (!document.is_array() && !document.is_object())
    fail_file(name,
              "is neither an object {name, children, value} nor a list of rows {id, parent, name, value}");
  const json columns = document.is_object() ? rows_of_columns(document, named, name) : json();
  NamedTree tree = columns.is_array()    ? read_list(columns, name, named)
                   : document.is_array() ? read_list(document, name, named)
                                         : Nested(name, named).read(document);
  const auto refuse = [&](const char* option, const std::string& wanted) {
    throw Error(
        ErrorCode::invalid_argument,
        fmt::format("{} {}: no node of {} has a value in a member of that name{}", option, readable(wanted),
                    readable(name), did_you_mean(closest(wanted, members_of(document)))));
  };
  const auto& given = tree.colour;
  if (!named.colours.empty() &&
      std::all_of(given.begin(), given.end(), [](const auto& c) { return c.empty(); }))
    refuse("--color-by", named.colours);
  if (!named.value.empty() && std::ranges::all_of(tree.value, [](double value) { return value == 0; }))
    refuse("--value-column", named.value);
  return tree;
}

EarlierLayout parse_earlier_layout(std::string_view bytes, const NamedTree& tree, const std::string& name) {
  const json document = parse(bytes, name);
  if (!document.is_array()) fail_file(name, "is not a list of nodes with polygons");
  std::unordered_map<std::string, std::size_t> at;
  const auto id_of = [&](const json& element, const char* key) {
    const json* id = element.is_object() ? member(element, {key}) : nullptr;
    return id && id->is_string() ? id->get<std::string>() : std::string();
  };
  for (std::size_t k = 0; k < document.size(); ++k) at.emplace(id_of(document[k], "id"), k);
  EarlierLayout layout;
  layout.vertex_offset.assign(1, 0);
  layout.seeds.assign(2 * tree.size(), std::nan(""));
  layout.hue.assign(tree.size(), -1);
  layout.shade.assign(tree.size(), -1);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    std::int64_t parent = tree.parent[i];
    const auto found = at.find(tree.id[i]);
    if (found != at.end()) {
      const json& element = document[found->second];
      add_polygon(element, layout, found->second + 1, name);
      ++layout.known;
      if (parent >= 0 && id_of(element, "parent") != tree.id[static_cast<std::size_t>(parent)]) parent = -1;
      layout.hue[i] = number_of(element, "hue");
      layout.shade[i] = number_of(element, "shade");
      const json* seed = member(element, {"seed"});
      if (seed && seed->is_array() && seed->size() == 2 && (*seed)[0].is_number() && (*seed)[1].is_number()) {
        layout.seeds[2 * i] = (*seed)[0].get<double>();
        layout.seeds[2 * i + 1] = (*seed)[1].get<double>();
      }
    }
    layout.parent.push_back(parent);
    layout.vertex_offset.push_back(layout.vertices.size() / 2);
  }
  return layout;
}

EarlierLayout read_earlier_layout(const std::string& path, const NamedTree& tree) {
  return parse_earlier_layout(read_file(path), tree, path);
}

}  // namespace powercell::io
