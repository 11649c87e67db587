#include "apps/number_checks.hpp"

#include <fmt/format.h>

#include "apps/io/read/text.hpp"

namespace powercell::app {
namespace {

/// \param wanted  completes the message "... is not ..."
NumberCheck check(std::function<bool(double)> holds, std::string wanted) {
  return [holds = std::move(holds), wanted = std::move(wanted)](const std::string& word) {
    double value = 0;
    if (const io::Parsed parsed = io::parse_number(word, value); parsed != io::Parsed::ok)
      return io::why_not(word, parsed);
    return holds(value) ? std::string() : fmt::format("{} is not {}", word, wanted);
  };
}

}  // namespace

NumberCheck above_zero() {
  return check([](double value) { return value > 0; }, "above 0");
}

NumberCheck not_below_zero() {
  return check([](double value) { return value >= 0; }, "0 or above");
}

NumberCheck between(double low, double high) {
  return check([=](double value) { return value >= low && value <= high; },
               fmt::format("from {} to {}", low, high));
}

}  // namespace powercell::app
