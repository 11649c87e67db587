#include "tests/fuzz/densities.hpp"

#include <cmath>
#include <string>

namespace powercell::fuzz {
namespace {

std::string any_formula(Input& input) {
  constexpr const char* kGood[] = {"1+x*x",       "exp(-x*x-y*y)", "x>0?1:3",  "abs(x)+z",
                                   "1/(x*x+y*y)", "sqrt(abs(y))",  "max(0,x)", "2"};
  const std::size_t choice = input.below(12);
  if (choice < 8) return kGood[choice];
  constexpr std::string_view kAlphabet = "xyz0123456789.+-*/^()<>=!&|?:, eE_\"sincoexpabminmax";
  std::string formula;
  for (std::size_t k = input.below(40); k > 0; --k)
    formula += choice < 11 ? kAlphabet[input.below(kAlphabet.size())] : static_cast<char>(input.byte());
  return formula;
}

}  // namespace

Density any_density(Input& input, const Domain& domain) {
  switch (input.below(8)) {
    case 0:
      return Density::constant(input.number());
    case 1:
      // Sanitizers slow integrals down.
      return Density::formula(any_formula(input), 0.03);
    case 2: {
      ImageView image;
      image.width = input.below(5);
      image.height = input.below(5);
      std::vector<double> values =
          input.numbers(image.width * image.height + (input.below(32) == 31 ? 1 : 0));
      if (input.below(8) != 7)
        for (double& value : values) value = std::fabs(value);
      image.values = values;
      if (input.flag()) {
        image.low = {domain.low()[0], domain.low()[1]};
        image.high = {domain.high()[0], domain.high()[1]};
      } else {
        for (double& x : image.low) x = input.number();
        for (double& x : image.high) x = input.number();
      }
      return Density::image(image);
    }
    case 3: {
      constexpr std::size_t kVertices[] = {5, 6, 0, 1};  // of the good domains, and of none
      std::vector<double> values = input.numbers(kVertices[input.below(4)]);
      if (input.below(8) != 7)
        for (double& value : values) value = std::fabs(value);
      return Density::nodal(values);
    }
    default:
      return Density::constant(1);
  }
}

}  // namespace powercell::fuzz
