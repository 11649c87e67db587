/// \file
/// Transport with an entropy between seeds and points of the domain. Internal.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace powercell {

/// Places with masses and weights.
struct Weighted {
  std::vector<double> positions;  ///< n x d
  std::vector<double> mass;       ///< n, positive
  std::vector<double> weights;    ///< n
  std::size_t size() const { return mass.size(); }
};

/// Called with the index of a place, that of another with which it shares mass, and its share.
using ShareVisitor = std::function<void(std::size_t, std::uint32_t, double)>;

/// (31g): sets the weights of `to` from those of `from`, with the temperature `heat`.
/// \return the mean entropy of the shares of `from` in a place of `to`
double soften(const Weighted& from, Weighted& to, std::size_t d, double heat, const ShareVisitor& each = {});

}  // namespace powercell
