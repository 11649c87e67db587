#include <muParser.h>

#include <numbers>
#include <string_view>

#include "lib/applications/density/checked_values.hpp"
#include "lib/applications/density/pointwise.hpp"
#include "lib/base/text.hpp"

namespace powercell {
namespace {

void check_tolerance(double tolerance) {
  if (!(tolerance > 0 && tolerance < 1))
    throw Error(ErrorCode::invalid_argument,
                "the tolerance of a density is " + digits(tolerance) + "; it must be between 0 and 1");
}

/// A parser with its variables, which it refers to, so it cannot move. Not thread-safe. Evaluates points one
/// by one: muparser's bulk mode starts OpenMP threads each time.
class Expression {
 public:
  explicit Expression(const std::string& text) : text_(text) {
    guarded([&] {
      parser_.DefineConst("pi", std::numbers::pi);
      parser_.DefineConst("e", std::numbers::e);
      parser_.DefineVar("x", &x_[0]);
      parser_.DefineVar("y", &x_[1]);
      parser_.DefineVar("z", &x_[2]);
      parser_.SetExpr(text);
    });
    refuse_assignment();
  }
  Expression(const Expression&) = delete;

  /// \throw Error invalid_argument if it has several values: of "1,5 + x" muparser would take the last
  void require_one_value() {
    int count = 0;
    x_ = {0.5, 0.5, 0.5};
    guarded([&] { parser_.Eval(count); });
    if (count != 1)
      refuse("it has " + std::to_string(count) + " values; decimals are written with a point, as in 1.5");
  }

  /// \throw Error invalid_argument if it depends on z, which is 0 everywhere
  void require_planar() {
    guarded([&] {
      if (parser_.GetUsedVar().contains("z")) refuse("z is 0 everywhere in this domain; use x and y");
    });
  }

  void evaluate(std::span<const Point> x, std::span<double> values) {
    guarded([&] {
      for (std::size_t k = 0; k < x.size(); ++k) {
        x_ = x[k];
        values[k] = parser_.Eval();
      }
    });
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorCode::invalid_argument,
                "formula \"" + readable(text_, longest) + "\": " + readable(why, longest));
  }

  /// In muparser '=' assigns to a variable: "x = 0.5 ? 1 : 3" would be 1 everywhere.
  void refuse_assignment() const {
    for (std::size_t k = 0; k < text_.size(); ++k) {
      if (text_[k] != '=') continue;
      if (k + 1 < text_.size() && text_[k + 1] == '=') {
        ++k;  // ==
      } else if (k == 0 || std::string_view("!<>").find(text_[k - 1]) == std::string_view::npos) {
        refuse("'=' assigns; comparisons are written ==");
      }
    }
  }

  template <class Body>
  void guarded(const Body& body) const {
    try {
      body();
    } catch (const mu::Parser::exception_type& error) {
      refuse(why(error));
    }
  }

  std::string why(const mu::Parser::exception_type& error) const {
    if (text_.find("**") != std::string::npos) return "powers are written with ^, as in x^2";
    if (error.GetCode() != mu::ecUNASSIGNABLE_TOKEN) return error.GetMsg();
    std::string functions;
    for (const auto& [name, function] : parser_.GetFunDef())
      if (name.front() != '_') functions += (functions.empty() ? "" : ", ") + name;
    return "'" + error.GetToken() + "' is unknown; there are x, y, in space z, pi, e and the functions " +
           functions;
  }

  static constexpr std::size_t longest = 300;  // bytes of the formula and of a message that are quoted
  std::string text_;
  Point x_{};
  mu::Parser parser_;
};

class FormulaSource : public CheckedSource {
 public:
  FormulaSource(const Domain& domain, const std::string& text) : CheckedSource(domain), expression_(text) {
    if (domain.dimension() == 2) expression_.require_planar();
  }

 private:
  void evaluate_unchecked(std::span<const Point> x, std::span<double> values) override {
    expression_.evaluate(x, values);
  }

  Expression expression_;
};

class Formula : public PointwiseDensity {
 public:
  Formula(std::string_view text, double tolerance) : PointwiseDensity(tolerance), text_(text) {
    check_tolerance(tolerance);
    Expression(text_).require_one_value();
  }

  std::unique_ptr<PointSource> source(const Domain& domain) const override {
    return std::make_unique<FormulaSource>(domain, text_);
  }

 private:
  std::string text_;
};

using Function = std::function<double(const std::array<double, 3>&)>;

class FunctionSource : public CheckedSource {
 public:
  FunctionSource(const Domain& domain, const Function& value) : CheckedSource(domain), value_(value) {}

 private:
  void evaluate_unchecked(std::span<const Point> x, std::span<double> values) override {
    for (std::size_t k = 0; k < x.size(); ++k) values[k] = value_(x[k]);
  }

  const Function& value_;
};

class FunctionDensity : public PointwiseDensity {
 public:
  FunctionDensity(Function value, double tolerance) : PointwiseDensity(tolerance), value_(std::move(value)) {
    check_tolerance(tolerance);
    if (!value_) throw Error(ErrorCode::invalid_argument, "the density's function is empty");
  }

  std::unique_ptr<PointSource> source(const Domain& domain) const override {
    return std::make_unique<FunctionSource>(domain, value_);
  }

 private:
  Function value_;
};

}  // namespace

DensityModelPtr make_formula(std::string_view expression, double tolerance) {
  return std::make_shared<Formula>(expression, tolerance);
}
DensityModelPtr make_function(Function value, double tolerance) {
  return std::make_shared<FunctionDensity>(std::move(value), tolerance);
}

}  // namespace powercell
