// Invalid densities: each is refused with a message that names the fault and the place.
#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "tests/applications/density/cases.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The message of the error that `body` must throw.
template <class Body>
std::string message(ErrorCode code, const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    CHECK(error.code() == code);
    return error.what();
  }
  FAIL("nothing was thrown");
  return {};
}

bool has(const std::string& text, const std::string& part) {
  INFO(text);
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("an invalid formula is refused when it is made") {
  for (const char* text : {"", "1 +", "foo(x)", "x y", "(1", "a"})
    CHECK(has(message(ErrorCode::invalid_argument, [&] { Density::formula(text); }), "formula"));
  for (const char* text : {"1,5+x", "x=0.5?1:3", "=1", "x+=1", "x==1=2"})
    CHECK(has(message(ErrorCode::invalid_argument, [&] { Density::formula(text); }), "formula"));
  for (const char* text : {"x==0.5?1:3", "x!=0.5", "x<=0.5?1:2", "min(x,y)+(y>=0.25)"})
    Density::formula(text);
  for (const double tolerance : {0.0, -1.0, 1.0, std::nan("")})
    CHECK(has(message(ErrorCode::invalid_argument, [&] { Density::formula("1", tolerance); }), "tolerance"));
}

TEST_CASE("a formula's error says what could be written instead") {
  const auto said = [](const char* text) {
    return message(ErrorCode::invalid_argument, [&] { (void)Density::formula(text).total(unit_box(2)); });
  };
  CHECK(has(said("x**2"), "powers are written with ^, as in x^2"));
  CHECK(has(said("1 + q"), "'q' is unknown; there are x, y, in space z, pi, e"));
  CHECK(has(said("np.exp(x)"), "'np' is unknown"));
  CHECK(has(said("1 + z"), "z is 0 everywhere in this domain; use x and y"));
  CHECK(Density::formula("1 + z").total(unit_box(3)) == doctest::Approx(1.5));
}

TEST_CASE("a message about a formula is one short printable line, whatever the formula") {
  for (const std::string& text : {std::string("8\x1b[31m\n}"), std::string(100000, 'a')}) {
    const std::string said = message(ErrorCode::invalid_argument, [&] { Density::formula(text); });
    INFO(said);
    CHECK(said.size() < 1000);
    CHECK(std::ranges::none_of(said, [](char c) { return std::iscntrl(static_cast<unsigned char>(c)); }));
  }
}

TEST_CASE("a formula with an invalid value is refused with the point") {
  const Domain domain = unit_box(2);
  for (const char* text : {"x - 0.5", "1/(x-x)", "log(-1-x)"})
    CHECK(has(message(ErrorCode::invalid_argument, [&] { (void)Density::formula(text).total(domain); }),
              "x ="));
  CHECK(has(message(ErrorCode::invalid_argument, [&] { (void)Density::formula("0*x").total(domain); }),
            "positive somewhere"));
}

TEST_CASE("a density or an integral above its limit is refused") {
  const double low[] = {0, 0, 0}, high[] = {1e67, 1e67, 1e67};
  const Domain wide = Domain::box(low, high);
  CHECK(Density::constant(1e98).total(wide) == doctest::Approx(1e299));
  for (const Density& density : {Density::constant(1e100), Density::formula("1e100")})
    CHECK(has(message(ErrorCode::invalid_argument, [&] { (void)density.total(wide); }), "1e+300"));
  CHECK(
      has(message(ErrorCode::invalid_argument, [&] { (void)Density::formula("1e160*x").total(unit_box(2)); }),
          "x ="));
}

TEST_CASE("an image must have pixels, a rectangle and a positive value") {
  const auto refused = [](const ImageView& image) {
    return message(ErrorCode::invalid_argument, [&] { Density::image(image); });
  };
  const std::vector<double> blank(6, 0.0), negative{1, 1, -1, 1, 1, 1}, good(6, 1.0);
  const std::vector<double> vast{1, 1, 1, 1, 2e100, 1};
  CHECK(has(refused({3, 2, blank}), "blank"));
  CHECK(has(refused({3, 2, negative}), "pixel 2, 0"));
  CHECK(has(refused({3, 2, vast}), "2e+100 at pixel 1, 1"));
  CHECK(has(refused({3, 3, good}), "values"));
  CHECK(has(refused({0, 3, {}}), "no density"));
  CHECK(has(refused({3, 2, good, {0, 0}, {0, 1}}), "rectangle"));
  CHECK(has(message(ErrorCode::unsupported,
                    [&] {
                      (void)Density::image({3, 2, good}).total(unit_box(3));
                    }),
            "polygon"));
}

TEST_CASE("values at vertices must match the mesh") {
  Random shape(7);
  const std::vector<double> three{1, 2, 3}, blank(3, 0.0), bad{1, std::nan(""), 1};
  const Domain mesh = volume_of(cube_tetrahedra(2, 0.15, shape));
  CHECK(has(message(ErrorCode::invalid_argument, [&] { (void)Density::nodal(three).total(mesh); }),
            "3 values"));
  CHECK(
      has(message(ErrorCode::unsupported, [&] { (void)Density::nodal(three).total(unit_box(2)); }), "mesh"));
  CHECK(has(message(ErrorCode::invalid_argument, [&] { Density::nodal(blank); }), "0 everywhere"));
  CHECK(has(message(ErrorCode::invalid_argument, [&] { Density::nodal(bad); }), "vertex 1"));
}
