/// \file
/// Transport with an entropy between seeds and points of the domain.
#pragma once

#include <cstddef>
#include <vector>

namespace powercell {

/// Places with masses and weights.
struct Weighted {
  std::vector<double> positions;  ///< n x d
  std::vector<double> mass;       ///< n, positive
  std::vector<double> weights;    ///< n
  std::size_t size() const { return mass.size(); }
};

/// (31e): sets the weights of `to` from those of `from`, at the temperature `heat`, a length squared.
/// \param cut  terms below exp(-cut) of the largest are left out
/// \return the mean entropy of the shares of `from` in a place of `to`
double soften(const Weighted& from, Weighted& to, std::size_t d, double heat, int threads, double cut);

}  // namespace powercell
