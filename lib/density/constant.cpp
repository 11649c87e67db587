#include "lib/density/constant.hpp"

namespace powercell {

double ConstantDensity::total(const Domain& domain, int) const {
  return value_ * domain.measure();
}

DensityIntegrals ConstantDensity::integrate(Diagram& diagram, bool walls, int) const {
  diagram.compute(walls, false);
  const Measures& measures = diagram.measures();
  DensityIntegrals result;
  result.dimension = measures.dimension;
  result.mass = measures.mass;
  result.centroid = measures.centroid;
  result.second_moment = measures.second_moment;
  result.status = measures.status;
  if (walls) result.walls = diagram.adjacency();
  if (value_ != 1) {
    for (double& m : result.mass) m *= value_;
    for (double& s : result.second_moment) s *= value_;
    for (double& a : result.walls.wall) a *= value_;
    result.walls.asymmetry *= value_;
  }
  return result;
}

}  // namespace powercell
