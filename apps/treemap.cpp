// powercell treemap: hierarchical data as nested cells of exact areas.
#include "apps/io/write/treemap.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/common.hpp"
#include "apps/interrupt.hpp"
#include "apps/io/picture/picture.hpp"
#include "apps/io/tables/read_tree.hpp"
#include "apps/number_checks.hpp"
#include "apps/option_words.hpp"
#include "apps/outputs.hpp"
#include "apps/progress.hpp"
#include "apps/report.hpp"
#include "apps/treemap_shape.hpp"

namespace powercell::app {
namespace {

struct TreemapArguments : CommonOptions {
  std::string tree, shape = "16:10", previous, color_by, value_column;
  std::vector<std::string> outputs;
  int rounds = TreemapOptions{}.rounds;
  std::uint64_t random_seed = 1;
  double tolerance = TreemapOptions{}.tolerance;
  double size = io::TreemapStyle{}.long_side;
  bool no_labels = false, no_legend = false;
};

constexpr const char* laying_out = "laying out";

std::vector<std::string> dropped_ids(const io::NamedTree& tree, const Treemap& map) {
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < tree.size(); ++i)
    if (map.kind[i] == TreeNode::dropped) ids.push_back(tree.id[i]);
  return ids;
}

/// The numbers that choose the hues of the branches and the shades of the groups below them.
struct Tints {
  std::vector<std::int64_t> hue, shade;
};

/// \param tints  output
Treemap lay_out(const TreemapArguments& arguments, const io::NamedTree& tree, const Ring& outline,
                Tints& tints, Progress& progress) {
  TreemapOptions options;
  options.tolerance = arguments.tolerance;
  options.rounds = arguments.rounds;
  options.random_seed = arguments.random_seed;
  options.threads = arguments.threads;
  options.name = [&tree](std::size_t node) { return tree.called(node); };
  std::vector<double> start;
  if (!arguments.previous.empty()) {
    const io::EarlierLayout earlier = io::read_earlier_layout(arguments.previous, tree);
    start = relative_positions(earlier.parent, earlier.seeds, earlier.vertex_offset, earlier.vertices);
    options.start = start;
    tints = {earlier.hue, earlier.shade};
  }
  // A device is opened only if there is a large group.
  std::vector<std::size_t> children(tree.size());
  for (const std::int64_t parent : tree.parent)
    if (parent >= 0) ++children[static_cast<std::size_t>(parent)];
  if (*std::max_element(children.begin(), children.end()) > options.large_group) {
    progress.begin(stage::opening);
    options.device = open_device(arguments);
  }
  progress.begin(laying_out);
  progress.count(static_cast<double>(tree.size()), "nodes");
  options.progress = progress.callback();
  Treemap map;
  compute([&] { map = treemap({tree.parent, tree.value}, outline, options); });
  tints.hue = io::number_branches(map, tints.hue);
  tints.shade = io::number_groups(map, tree.parent, tints.shade);
  return map;
}

void print_json(const io::NamedTree& tree, const Treemap& map, const std::vector<std::string>& files,
                const Progress& progress) {
  std::vector<std::string> unsolved;
  for (const std::size_t i : map.not_converged) unsolved.push_back(tree.id[i]);
  const nlohmann::json report = {{"nodes", tree.size()},
                                 {"leaves", map.leaves},
                                 {"levels", *std::max_element(map.depth.begin(), map.depth.end()) + 1},
                                 {"dropped", dropped_ids(tree, map)},
                                 {"worst_leaf_error", map.worst_error},
                                 {"worst_leaf", tree.id[map.worst_leaf]},
                                 {"mean_aspect", map.mean_aspect},
                                 {"not_converged", unsolved},
                                 {"diagrams", map.diagrams},
                                 {"newton_steps", map.newton_steps},
                                 {"notes", tree.notes},
                                 {"version", version()},
                                 {"files", files},
                                 {"seconds",
                                  {{"read", progress.seconds(stage::reading)},
                                   {"open", progress.seconds(stage::opening)},
                                   {"layout", progress.seconds(laying_out)},
                                   {"build", progress.build()},
                                   {"write", progress.seconds(stage::writing)},
                                   {"run", progress.run()}}}};
  fmt::print("{}\n", json_text(report));
}

void print(const io::NamedTree& tree, const Treemap& map, const std::vector<std::string>& files,
           const Progress& progress) {
  for (const std::string& note : tree.notes) fmt::print("{}\n", note);
  const std::vector<std::string> dropped = dropped_ids(tree, map);
  if (!dropped.empty()) {
    std::string some;
    for (std::size_t k = 0; k < std::min<std::size_t>(dropped.size(), 5); ++k)
      some += (k ? ", " : "") + dropped[k];
    fmt::print("dropped {} nodes without a value above 0: {}{}\n", with_commas(dropped.size()), some,
               dropped.size() > 5 ? ", ..." : "");
  }
  for (const std::string& path : files) fmt::print("wrote {}\n", path);
  fmt::print("{} nodes, {} leaves; worst area off by {:.2g} % ('{}'), mean aspect {:.3f}; {:.2f} s{}\n",
             with_commas(tree.size() - dropped.size()), with_commas(map.leaves), 100 * map.worst_error,
             tree.id[map.worst_leaf], map.mean_aspect, progress.seconds(laying_out),
             building_note(progress.build()));
}

/// \throw WrongUsage for options that would have no effect, or leave no room
void check_colours(const TreemapArguments& arguments) {
  constexpr double least_with_legend = 200;
  if (arguments.color_by.empty() && arguments.no_legend)
    throw WrongUsage("--no-legend leaves out the legend of --color-by, which is not given");
  if (arguments.color_by.empty()) return;
  if (std::none_of(arguments.outputs.begin(), arguments.outputs.end(), io::is_picture))
    throw WrongUsage("--color-by is for pictures; name one, such as -o map.svg");
  if (!arguments.no_legend && arguments.size < least_with_legend)
    throw WrongUsage(fmt::format(
        "--size {}: below {} there is no room for the legend of --color-by; leave it out with --no-legend",
        arguments.size, least_with_legend));
}

int run(const TreemapArguments& arguments) {
  check_colours(arguments);
  check_writable(arguments.outputs, {}, arguments.json);
  Progress progress({{stage::reading, 3}, {stage::opening, 2}, {laying_out, 85}, {stage::writing, 10}},
                    arguments.silent());
  std::vector<std::string> notes;
  const Ring outline = treemap_shape(arguments.shape, notes);
  io::NamedTree tree = io::read_tree(arguments.tree, {arguments.color_by, arguments.value_column});
  io::check_tree_colours(tree);
  tree.notes.insert(tree.notes.end(), notes.begin(), notes.end());
  Tints tints;
  const Treemap map = lay_out(arguments, tree, outline, tints, progress);
  progress.begin(stage::writing);
  for (const std::string& path : arguments.outputs)
    io::write_treemap(path, {tree, map, tints.hue, tints.shade},
                      {arguments.size, !arguments.no_labels, !arguments.no_legend});
  progress.finish();
  if (arguments.json)
    print_json(tree, map, arguments.outputs, progress);
  else if (!arguments.quiet)
    print(tree, map, arguments.outputs, progress);
  if (!map.not_converged.empty())
    throw Error(
        ErrorCode::not_converged,
        fmt::format(
            "the children of '{}'{} have areas that are off by more than the tolerance, at worst {:.2g} %; "
            "the files hold the best layout found",
            tree.id[map.not_converged.front()],
            map.not_converged.size() == 1 ? "" : fmt::format(" and of {} more", map.not_converged.size() - 1),
            100 * map.worst_error));
  return 0;
}

constexpr const char* treemap_examples =
    "Examples:\n"
    "  powercell treemap sales.csv -o sales.svg\n"
    "  powercell treemap flare.json --shape circle -o flare.png -o flare-layout.json\n"
    "  powercell treemap ~/project -o project.svg                    sizes of the files in a folder\n"
    "  powercell treemap new.csv --previous old-layout.json -o new.svg -o new-layout.json\n"
    "A table has rows id, parent, name, value; JSON is nested {name, children, value} or a list of such "
    "rows.\n"
    "Tables without parents: name, value; id, value with paths a/b/c; levels from the top, value.\n"
    "Areas are exact; nodes without a value above 0 are dropped and listed.";

}  // namespace

Command add_treemap(CLI::App& app) {
  auto arguments = std::make_shared<TreemapArguments>();
  CLI::App* command = app.add_subcommand("treemap", "Draw hierarchical data as nested cells of exact areas");
  command->add_option("tree", arguments->tree, "A table (.csv .txt .tsv), .json, or a folder")
      ->required()
      ->type_name("FILE|FOLDER");
  add_output_files(*command, arguments->outputs, std::string(io::treemap_outputs), io::check_treemap_output);
  command
      ->add_option("--shape", arguments->shape,
                   "W:H, circle, circle:N (N corners), hexagon, or a file with one convex polygon")
      ->type_name("FILE|SHAPE")
      ->check(known_words({"circle", "hexagon", "16:10"}))
      ->capture_default_str();
  command
      ->add_option("--previous", arguments->previous,
                   "An earlier layout (.json) whose positions and colours are kept as far as possible, by id")
      ->type_name("FILE.json")
      ->default_str("none");
  command
      ->add_option("--rounds", arguments->rounds,
                   "Largest number of rounds of moving cells; more give rounder cells")
      ->check(not_below_zero())
      ->capture_default_str();
  command->add_option("--tolerance", arguments->tolerance, "Largest relative error of an area")
      ->check(above_zero())
      ->capture_default_str();
  command->add_option("--seed", arguments->random_seed, "Random seed of the initial positions")
      ->capture_default_str();
  command->add_option("--size", arguments->size, "Long side of the picture in pixels")
      ->check(between(64, 20000))
      ->capture_default_str();
  command
      ->add_option("--value-column", arguments->value_column,
                   "The column of the values in a table, or the member of JSON objects")
      ->type_name("COLUMN")
      ->default_str("value, weight, size or area");
  command
      ->add_option(
          "--color-by", arguments->color_by,
          "Colour the leaves by a column of the table, or a member of the JSON objects: numbers on a scale, "
          "colours such as #3a6b9c, or a colour for each text; leaves without one take that of their group")
      ->type_name("COLUMN")
      ->default_str("a colour for each group");
  command->add_flag("--no-legend", arguments->no_legend, "No legend for --color-by");
  command->add_flag("--no-labels", arguments->no_labels, "No names in the picture");
  add_device_option(*command, *arguments, "For groups of thousands of nodes: ");
  add_threads_option(*command, *arguments);
  add_output_options(*command, *arguments);
  command->footer(treemap_examples);
  return [arguments] { return run(*arguments); };
}

}  // namespace powercell::app
