#include "lib/exchange/translations.hpp"

#include <cmath>

namespace powercell::exchange {

std::vector<Point> translations(const Period* period) {
  std::vector<Point> all(1);
  if (period == nullptr) return all;
  // (39c)
  Shift most{}, shift;
  for (int k = 0; k < period->count(); ++k)
    most[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(std::ceil(period->reach(k)));
  const Point origin{};
  for (shift[0] = -most[0]; shift[0] <= most[0]; ++shift[0])
    for (shift[1] = -most[1]; shift[1] <= most[1]; ++shift[1])
      for (shift[2] = -most[2]; shift[2] <= most[2]; ++shift[2])
        if (shift != Shift{}) all.push_back(period->moved(origin.data(), shift));
  return all;
}

}  // namespace powercell::exchange
