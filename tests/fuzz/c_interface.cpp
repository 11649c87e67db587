// powercell.h in any order of calls, with null pointers, short arrays and counts of any size.
#include <powercell.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "tests/fuzz/input.hpp"

namespace powercell::fuzz {
namespace {

constexpr std::size_t kHuge = std::numeric_limits<std::size_t>::max() / 3 + 2;  // times 3 it is 3 again

/// \param may_fail  whether a certificate may say that a result is none
void check(pc_status status, bool may_fail = false) {
  require(status >= PC_OK && status <= PC_OUT_OF_MEMORY, "a status that is none");
  if (status == PC_OK) return;
  if (status != PC_DEVICE_NOT_FOUND) require_readable(pc_last_error());  // that one lists the devices
  require(status == PC_INVALID_ARGUMENT || status == PC_INVALID_SEED || status == PC_INVALID_DOMAIN ||
              status == PC_DEVICE_NOT_FOUND || status == PC_UNSUPPORTED || status == PC_INTERRUPTED ||
              (may_fail && status == PC_INTERNAL &&
               std::strstr(pc_last_error(), "the certificate of the diagram")),
          std::string(pc_status_name(status)) + ": " + pc_last_error());
}

pc_device* shared() {
  static pc_device* const device = [] {
    pc_device* made = nullptr;
    const pc_status status = pc_device_create(nullptr, &made);
    if (status != PC_OK) throw std::runtime_error(pc_last_error());
    return made;
  }();
  return device;
}

/// Seeds and their cells out of core. The call is stopped once there are no calls left.
struct OutOfCore {
  std::vector<double> positions, weights;
  std::size_t dimension;
  int calls_left;
  std::vector<std::uint8_t> status{};
  std::vector<std::uint64_t> offset{0}, neighbor{};

  static int read(std::uint64_t first, std::size_t count, double* positions, double* weights, void* user) {
    auto& self = *static_cast<OutOfCore*>(user);
    const std::size_t d = self.dimension, begin = static_cast<std::size_t>(first);
    require(begin + count <= self.weights.size(), "seeds are read that there are none of");
    std::copy_n(&self.positions[begin * d], count * d, positions);
    std::copy_n(&self.weights[begin], count, weights);
    return --self.calls_left > 0;
  }
  static int take(const pc_cell_rows* rows, void* user) {
    auto& self = *static_cast<OutOfCore*>(user);
    const std::size_t n = rows->measures->count;
    require(rows->first == self.status.size(), "rows that are not the next ones");
    self.status.insert(self.status.end(), rows->measures->status, rows->measures->status + n);
    self.neighbor.insert(self.neighbor.end(), rows->neighbor, rows->neighbor + rows->offset[n]);
    for (std::size_t k = 0; k < n; ++k)
      self.offset.push_back(self.offset.back() + rows->offset[k + 1] - rows->offset[k]);
    return --self.calls_left > 0;
  }
};

/// The handles of one input; freed at the end.
class CSession {
 public:
  explicit CSession(Input& input) : input_(input) {}
  CSession(const CSession&) = delete;
  CSession& operator=(const CSession&) = delete;
  ~CSession() {
    pc_diagram_destroy(diagram_);
    pc_domain_destroy(domain_);
  }

  void make_domain() {
    pc_domain_destroy(domain_);
    domain_ = nullptr;
    const DomainInput from = input_.below(4) == 3 ? any_domain(input_) : good_domain(input_);
    pc_domain** out = input_.below(32) == 31 ? nullptr : &domain_;
    const double* vertices = input_.below(32) == 31 ? nullptr : from.vertices.data();
    const bool huge = input_.below(32) == 31;
    switch (from.kind) {
      case DomainInput::Kind::polygon:
        make_polygon(from, out);
        break;
      case DomainInput::Kind::surface:
        check(pc_domain_surface(vertices, huge ? kHuge : from.vertices.size() / 3, from.elements.data(),
                                from.elements.size() / 3, out));
        break;
      case DomainInput::Kind::volume:
        check(pc_domain_volume(vertices, from.vertices.size() / 3, from.elements.data(),
                               huge ? (std::size_t{1} << 62) + 1 : from.elements.size() / 4, out));
        break;
      default: {
        const std::size_t d = from.vertices.size() / 2;
        // Any other dimension must be refused before an array is read.
        const int said = (d == 2 || d == 3) ? static_cast<int>(d) : static_cast<int>(input_.byte()) + 4;
        check(pc_domain_box(vertices, vertices ? vertices + d : nullptr, said, out));
      }
    }
    require(out || !domain_, "a domain without a place to put it");
  }

  void make_diagram() {
    pc_diagram_destroy(diagram_);
    diagram_ = nullptr;
    pc_options options;
    pc_options_init(&options, sizeof options);
    const std::size_t choice = input_.below(12), rare = input_.below(32);
    options.precision = static_cast<pc_precision>(choice % 3);
    options.certify = choice / 3 % 2 == 1;
    options.decisions = choice / 6 == 1 ? PC_DECISIONS_FAST : PC_DECISIONS_EXACT;
    options.threads = 1;
    if (rare % 16 == 15) options.threads = static_cast<int>(input_.byte()) - 100;
    if (rare == 31) {
      options.neighbors = static_cast<pc_neighbors>(input_.below(5));
      options.decisions = static_cast<pc_decisions>(input_.below(4));
      options.initial_neighbors = static_cast<int>(input_.byte()) - 100;
      options.chunk_pairs = input_.below(40);
    }
    certified_ = options.certify != 0;
    if (input_.below(16) == 15) options.precision = static_cast<pc_precision>(3 + input_.below(4));
    if (input_.below(8) == 7) {
      options.progress = [](double, void* user) { return static_cast<int>(--*static_cast<int*>(user) > 0); };
      calls_left_ = static_cast<int>(input_.below(16));
      options.progress_user = &calls_left_;
    }
    check(pc_diagram_create(input_.below(32) == 31 ? nullptr : shared(), domain_,
                            input_.flag() ? &options : nullptr,
                            input_.below(32) == 31 ? nullptr : &diagram_));
  }

  /// Any seeds in pieces of a few, stopped now and then, must have the cells that a diagram gives them.
  void compute_out_of_core() {
    if (!domain_) return;
    const pc_domain_info* info = nullptr;
    check(pc_domain_info_view(domain_, &info));
    const std::size_t n = input_.below(40), d = static_cast<std::size_t>(info->dimension);
    OutOfCore seeds{input_.numbers(d * n), input_.numbers(n), d, static_cast<int>(input_.below(8)) + 1};
    const std::string folder =
        (std::filesystem::temp_directory_path() / ("fuzz_out_of_core." + std::to_string(getpid()))).string();
    pc_seed_source source;
    pc_seed_source_init(&source, sizeof source);
    source.count = n;
    source.dimension = info->dimension;
    source.name = "the seeds of one input";
    source.read = OutOfCore::read;
    source.user = &seeds;
    pc_options diagram;
    pc_options_init(&diagram, sizeof diagram);
    diagram.threads = 1;
    pc_out_of_core_options options;
    pc_out_of_core_options_init(&options, sizeof options);
    options.diagram = &diagram;
    options.folder = folder.c_str();
    options.walls = 1;
    options.piece_seeds = 1 + input_.below(16);
    if (input_.below(16) == 15) options.memory = std::uint64_t{1} << input_.below(40);
    pc_status status = PC_INTERRUPTED;
    for (int tries = 0; status == PC_INTERRUPTED && tries < 2; ++tries) {
      const pc_out_of_core_report* report = nullptr;
      seeds.status.clear();
      seeds.offset = {0};
      seeds.neighbor.clear();
      status = pc_compute_out_of_core(shared(), domain_, &source, OutOfCore::take, &seeds, &options, &report);
      check(status);
      require((status == PC_OK) == (report != nullptr), "a failed call wrote its result");
      pc_out_of_core_report_destroy(report);
      seeds.calls_left = std::numeric_limits<int>::max();
    }
    std::filesystem::remove_all(folder);
    if (status == PC_OK) compare_with_diagram(seeds, diagram);
  }

  void step() {
    switch (input_.below(8)) {
      case 0:
        make_domain();
        break;
      case 1:
        make_diagram();
        break;
      case 2:
        set_seeds();
        break;
      case 3:
        set_weights();
        break;
      case 4:
        read_measures();
        break;
      case 5:
        read_adjacency();
        break;
      case 6:
        read_dual();
        break;
      default: {
        double measure = -1;
        const pc_status status = pc_domain_measure(domain_, input_.below(8) == 7 ? nullptr : &measure);
        check(status);
        require(status == PC_OK || measure == -1, "a failed call wrote its result");
        if (input_.flag()) read_selected();
        read_views();
      }
    }
  }

 private:
  void make_polygon(const DomainInput& from, pc_domain** out) {
    std::vector<double> points;
    std::vector<std::size_t> rings{0}, parts{0};
    const auto add = [&](const Ring& ring) {
      for (const auto& point : ring) points.insert(points.end(), point.begin(), point.end());
      rings.push_back(points.size() / 2);
    };
    for (const PolygonPart& part : from.parts) {
      add(part.outer);
      for (const Ring& hole : part.holes) add(hole);
      parts.push_back(rings.size() - 1);
    }
    if (input_.below(16) == 15 && rings.size() > 2) std::swap(rings[1], rings[2]);
    if (input_.below(16) == 15) parts.back() = 0;
    check(pc_domain_polygon(points.data(), rings.data(), parts.data(), parts.size() - 1, out));
  }

  void compare_with_diagram(const OutOfCore& cells, const pc_options& options) {
    const std::size_t n = cells.weights.size();
    pc_diagram_destroy(diagram_);
    diagram_ = nullptr;
    certified_ = false;
    check(pc_diagram_create(shared(), domain_, &options, &diagram_));
    check(pc_diagram_set_seeds(diagram_, cells.positions.data(), cells.weights.data(), n));
    const pc_measures* measures = nullptr;
    const pc_adjacency* walls = nullptr;
    check(pc_diagram_measures_view(diagram_, &measures));
    check(pc_diagram_adjacency_view(diagram_, &walls));
    require(measures && walls, "cells out of core where a diagram has none");
    require(std::equal(cells.status.begin(), cells.status.end(), measures->status, measures->status + n),
            "the status of a seed differs from that in a diagram");
    require(std::equal(cells.neighbor.begin(), cells.neighbor.end(), walls->neighbor,
                       walls->neighbor + walls->entry_count),
            "the neighbours differ from those in a diagram");
  }

  std::size_t size() {
    std::size_t n = 0;
    check(pc_diagram_size(diagram_, &n));
    return n;
  }

  void set_seeds() {
    const std::size_t n = input_.below(16);
    const std::vector<double> positions = input_.numbers(3 * n), weights = input_.numbers(n);
    const bool huge = input_.below(32) == 31;
    check(pc_diagram_set_seeds(diagram_, input_.below(32) == 31 ? nullptr : positions.data(),
                               input_.flag() ? nullptr : weights.data(), huge ? kHuge : n));
  }

  void set_weights() {
    const std::size_t n = input_.below(4) == 3 ? input_.below(16) : size();
    const std::vector<double> weights = input_.numbers(n);
    check(pc_diagram_set_weights(diagram_, input_.below(16) == 15 ? nullptr : weights.data(), n));
  }

  void read_measures() {
    const std::size_t n = size();
    std::vector<double> mass(n), centroid(3 * n), moment(n);
    std::vector<std::uint8_t> status(n);
    check(pc_diagram_measures(
              diagram_, input_.flag() ? mass.data() : nullptr, input_.flag() ? centroid.data() : nullptr,
              input_.flag() ? moment.data() : nullptr, input_.flag() ? status.data() : nullptr),
          certified_);
  }

  void read_adjacency() {
    std::size_t count = 0;
    const pc_status first = pc_diagram_adjacency(diagram_, nullptr, nullptr, nullptr, &count);
    check(first, certified_);
    if (first != PC_OK) return;
    const std::size_t room = input_.below(4) == 3 ? input_.below(4) : count;
    std::vector<std::uint64_t> offset(size() + 1);
    std::vector<std::uint32_t> neighbor(room + 1);
    std::vector<double> wall(room);
    std::size_t given = room;
    const pc_status second = pc_diagram_adjacency(diagram_, offset.data(), neighbor.data(),
                                                  input_.flag() ? wall.data() : nullptr, &given);
    check(second, certified_);
    require(given == count, "the count of neighbours changed");
    require((second == PC_OK) == (room >= count), "an array too short was taken, or a long one not");
    if (second == PC_OK) require(offset.back() == count, "the last offset is not the count");
  }

  void read_dual() {
    std::size_t count = 0;
    int corners = 0;
    const pc_status first = pc_diagram_dual(diagram_, &corners, nullptr, &count);
    check(first, certified_);
    if (first != PC_OK) return;
    const std::size_t room = input_.below(4) == 3 ? input_.below(4) : count;
    std::vector<std::uint32_t> simplices(room * 4 + 1);
    std::size_t given = room;
    const pc_status second = pc_diagram_dual(diagram_, &corners, simplices.data(), &given);
    check(second, certified_);
    require((second == PC_OK) == (room >= count), "an array too short was taken, or a long one not");
  }

  /// Any seeds, selected for the views of one step.
  void read_selected() {
    std::vector<std::uint32_t> seeds(input_.below(6));
    for (std::uint32_t& seed : seeds) seed = static_cast<std::uint32_t>(input_.below(16));
    const pc_status status = pc_diagram_select(diagram_, seeds.data(), seeds.size());
    check(status);
    if (status != PC_OK) return;
    const pc_measures* measures = nullptr;
    const pc_status viewed = pc_diagram_measures_view(diagram_, &measures);
    check(viewed, certified_);
    if (viewed == PC_OK) require(measures->count == seeds.size(), "a row for each selected seed");
    check(pc_diagram_select_all(diagram_));
  }

  void read_views() {
    const pc_measures* measures = nullptr;
    const pc_adjacency* adjacency = nullptr;
    const pc_cells* cells = nullptr;
    const pc_joined_cells* joined = nullptr;
    const std::size_t n = diagram_ ? size() : 0;
    const pc_status status = pc_diagram_measures_view(diagram_, &measures);
    check(status, certified_);
    if (status == PC_OK) require(measures->count == n, "a row for each seed");
    const pc_status adjacent = pc_diagram_adjacency_view(diagram_, &adjacency);
    check(adjacent, certified_);
    if (adjacent == PC_OK)
      require(adjacency->count == n && (n == 0 || adjacency->offset[n] == adjacency->entry_count),
              "the last offset is not the count");
    const pc_status cut = pc_diagram_cells_view(diagram_, &cells);
    check(cut, certified_);
    if (cut == PC_OK)
      require(cells->count == n && (n == 0 || cells->cell_offset[n] == cells->piece_count),
              "the last offset is not the count of pieces");
    const pc_status whole = pc_diagram_joined_view(diagram_, &joined);
    check(whole, certified_);
    if (whole == PC_OK)
      require(joined->count == n && (n == 0 || joined->face_offset[n] == joined->face_count),
              "the last offset is not the count of faces");
    require((status == PC_OK) == (measures != nullptr) && (cut == PC_OK) == (cells != nullptr),
            "a failed call wrote its result");
  }

  Input& input_;
  pc_domain* domain_ = nullptr;
  pc_diagram* diagram_ = nullptr;
  int calls_left_ = 0;
  bool certified_ = false;  // diagram_, if the options were given
};

}  // namespace

void c_interface(Bytes bytes) {
  Input input(bytes);
  if (input.below(64) == 63) {  // a selector of any bytes
    std::string selector;
    for (std::size_t k = input.below(20); k > 0; --k) selector += static_cast<char>(input.byte());
    pc_device* device = nullptr;
    check(pc_device_create(selector.c_str(), &device));
    pc_device_destroy(device);
  }
  CSession session(input);
  session.make_domain();
  session.make_diagram();
  for (int steps = 0; steps < 8 && !input.at_end(); ++steps) session.step();
  if (input.below(4) == 3) session.compute_out_of_core();
}

}  // namespace powercell::fuzz
