// Gmsh's mesh file, version 4.1, in text.
#include <algorithm>
#include <array>

#include "apps/io/atomic_file.hpp"
#include "apps/io/write/formats.hpp"
#include "apps/io/write/gmsh_model.hpp"

namespace powercell::io {
namespace {

/// Of the elements of each dimension: Gmsh's number of the kind, and points of one.
constexpr std::array<std::uint64_t, 4> element_kind = {15, 1, 2, 4}, element_points = {1, 2, 3, 4};

class GmshWriter {
 public:
  GmshWriter(const std::string& path, const GmshModel& model) : file_(path), model_(model) {}

  void write() {
    file_.write("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    write_names();
    write_entities();
    write_nodes();
    write_elements();
    file_.commit();
  }

 private:
  void numbers(std::initializer_list<std::uint64_t> row) {
    for (const std::uint64_t* x = row.begin(); x != row.end(); ++x) {
      if (x != row.begin()) file_.write(' ');
      file_.number(*x);
    }
    file_.write('\n');
  }
  void coordinate(double x) {
    file_.number(x + 0.0);  // not -0
    file_.write(' ');
  }
  void write_names();
  void write_entities();
  void write_entity(std::size_t dimension, const GmshEntity& entity);
  void write_box(const GmshEntity& entity);
  void write_nodes();
  void write_elements();

  AtomicFile file_;
  const GmshModel& model_;
};

void GmshWriter::write_names() {
  std::size_t count = 0;
  for (const auto& groups : model_.groups) count += groups.size();
  file_.write("$PhysicalNames\n");
  numbers({count});
  for (std::size_t dimension = 0; dimension < 4; ++dimension)
    for (const auto& [tag, name] : model_.groups[dimension])
      file_.write(std::to_string(dimension) + " " + std::to_string(tag) + " \"" + name + "\"\n");
  file_.write("$EndPhysicalNames\n");
}

/// The box around the elements or, without any, around those of the surfaces of a volume.
void GmshWriter::write_box(const GmshEntity& entity) {
  std::array<double, 6> box{};
  bool any = false;
  const auto add = [&](const GmshEntity& of) {
    for (const std::uint32_t p : of.elements)
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = model_.points[3 * std::size_t{p} + k];
        box[k] = any ? std::min(box[k], x) : x;
        box[k + 3] = any ? std::max(box[k + 3], x) : x;
        if (k == 2) any = true;
      }
  };
  add(entity);
  if (!any)
    for (const std::int64_t surface : entity.bounds)
      add(model_.entities[2][static_cast<std::size_t>(surface < 0 ? -surface : surface) - 1]);
  for (const double x : box) coordinate(x);
}

void GmshWriter::write_entity(std::size_t dimension, const GmshEntity& entity) {
  file_.number(entity.tag);
  file_.write(' ');
  if (dimension == 0) {
    for (std::size_t k = 0; k < 3; ++k) coordinate(model_.points[3 * std::size_t{entity.nodes[0]} + k]);
  } else {
    write_box(entity);
  }
  file_.write(entity.group == 0 ? "0" : "1 " + std::to_string(entity.group));
  if (dimension > 0) file_.write(" " + std::to_string(entity.bounds.size()));
  for (const std::int64_t tag : entity.bounds) file_.write(" " + std::to_string(tag));
  file_.write('\n');
}

void GmshWriter::write_entities() {
  const auto& entities = model_.entities;
  file_.write("$Entities\n");
  numbers({entities[0].size(), entities[1].size(), entities[2].size(), entities[3].size()});
  for (std::size_t dimension = 0; dimension < 4; ++dimension)
    for (const GmshEntity& entity : entities[dimension]) write_entity(dimension, entity);
  file_.write("$EndEntities\n");
}

void GmshWriter::write_nodes() {
  std::uint64_t blocks = 0, count = 0, least = ~std::uint64_t{0}, most = 0;
  for (const auto& of_dimension : model_.entities)
    for (const GmshEntity& entity : of_dimension) {
      blocks += entity.nodes.empty() ? 0 : 1;
      count += entity.nodes.size();
      for (const std::uint32_t p : entity.nodes) {
        least = std::min(least, std::uint64_t{p} + 1);
        most = std::max(most, std::uint64_t{p} + 1);
      }
    }
  file_.write("$Nodes\n");
  numbers({blocks, count, count > 0 ? least : 0, most});
  for (std::size_t dimension = 0; dimension < 4; ++dimension)
    for (const GmshEntity& entity : model_.entities[dimension]) {
      if (entity.nodes.empty()) continue;
      numbers({dimension, entity.tag, 0, entity.nodes.size()});
      for (const std::uint32_t p : entity.nodes) numbers({std::uint64_t{p} + 1});
      for (const std::uint32_t p : entity.nodes) {
        for (std::size_t k = 0; k < 3; ++k) coordinate(model_.points[3 * std::size_t{p} + k]);
        file_.write('\n');
      }
    }
  file_.write("$EndNodes\n");
}

void GmshWriter::write_elements() {
  std::uint64_t blocks = 0, count = 0;
  for (std::size_t dimension = 1; dimension < 4; ++dimension)
    for (const GmshEntity& entity : model_.entities[dimension]) {
      blocks += entity.elements.empty() ? 0 : 1;
      count += entity.elements.size() / element_points[dimension];
    }
  file_.write("$Elements\n");
  numbers({blocks, count, count > 0 ? 1U : 0U, count});
  std::uint64_t tag = 0;
  for (std::size_t dimension = 1; dimension < 4; ++dimension)
    for (const GmshEntity& entity : model_.entities[dimension]) {
      if (entity.elements.empty()) continue;
      const std::size_t corners = element_points[dimension];
      numbers({dimension, entity.tag, element_kind[dimension], entity.elements.size() / corners});
      for (std::size_t k = 0; k < entity.elements.size(); k += corners) {
        file_.number(++tag);
        for (std::size_t c = 0; c < corners; ++c) {
          file_.write(' ');
          file_.number(std::uint64_t{entity.elements[k + c]} + 1);
        }
        file_.write('\n');
      }
    }
  file_.write("$EndElements\n");
}

}  // namespace

void write_gmsh(const std::string& path, const DiagramOutput& output) {
  const GmshModel model = gmsh_model(path, output);
  GmshWriter(path, model).write();
}

}  // namespace powercell::io
