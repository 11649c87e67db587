#include "apps/io/write_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/io/atomic_file.hpp"
#include "apps/io/names.hpp"

namespace powercell::io {

void write_point_fields(AtomicFile& file, const double* point, std::size_t dimension, const MapPlane* plane) {
  std::array<double, 3> fields{};
  std::copy(point, point + dimension, fields.begin());
  if (plane != nullptr && std::isfinite(point[0])) {
    const MapPoint map = plane->rounded(plane->to_map({point[0], point[1]}));
    std::copy(map.begin(), map.end(), fields.begin());
  }
  for (std::size_t k = 0; k < dimension; ++k) {
    file.write(',');
    if (std::isfinite(fields[k])) file.number(fields[k]);
  }
}

void write_table(const std::string& path, const SeedsView& seeds, const Measures& measures,
                 const Adjacency& adjacency, const InputView& inputs) {
  AtomicFile file(path);
  const double* positions = inputs.positions(seeds);
  const bool space = seeds.dimension == 3;
  file.write(space ? "seed,x,y,z,weight,status,measure,cx,cy,cz,second_moment,neighbors\n"
                   : "seed,x,y,weight,status,measure,cx,cy,second_moment,neighbors\n");
  const auto d = static_cast<std::size_t>(seeds.dimension);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    file.number(std::uint64_t{i});
    write_point_fields(file, positions + i * d, d, nullptr);
    file.write(',');
    file.number(seeds.weights.empty() ? 0.0 : seeds.weights[i]);
    file.write(',');
    file.write(name(measures.status[i]));
    file.write(',');
    file.number(measures.mass[i]);
    write_point_fields(file, &measures.centroid[i * d], d, inputs.plane());
    file.write(',');
    file.number(measures.second_moment[i]);
    file.write(',');
    const bool listed = i + 1 < adjacency.offset.size();
    file.number(listed ? adjacency.offset[i + 1] - adjacency.offset[i] : std::uint64_t{0});
    file.write('\n');
  }
  file.commit();
}

void write_walls(const std::string& path, const Adjacency& adjacency) {
  AtomicFile file(path);
  file.write("seed,neighbor,measure\n");
  for (std::size_t i = 0; i + 1 < adjacency.offset.size(); ++i) {
    for (std::uint64_t e = adjacency.offset[i]; e < adjacency.offset[i + 1]; ++e) {
      file.number(std::uint64_t{i});
      file.write(',');
      file.number(std::uint64_t{adjacency.neighbor[e]});
      file.write(',');
      file.number(adjacency.wall[e]);
      file.write('\n');
    }
  }
  file.commit();
}

}  // namespace powercell::io
