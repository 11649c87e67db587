#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "apps/io/read/domain.hpp"
#include "apps/io/read/svg_path.hpp"
#include "tests/readers/fixtures.hpp"

using namespace powercell;
using namespace powercell::io;
using namespace powercell::io::test;

namespace {

std::string svg(const std::string& body) {
  return "<svg xmlns='http://www.w3.org/2000/svg'>\n" + body + "\n</svg>";
}
std::vector<PolygonPart> draw(const std::string& body) {
  return parse_svg(svg(body), "t.svg");
}

}  // namespace

TEST_CASE("GeoJSON: a polygon with a hole, a multipolygon, features") {
  const char* ring = "[[0,0],[4,0],[4,4],[0,4],[0,0]],[[1,1],[1,2],[2,2],[2,1],[1,1]]";
  const auto one = parse_geojson(std::string(R"({"type":"Polygon","coordinates":[)") + ring + "]}", "t.json");
  CHECK(one.size() == 1);
  CHECK(one[0].holes.size() == 1);
  CHECK(area(one) == doctest::Approx(15));
  const std::string island = "[[[6,0],[7,0],[7,1],[6,0]]]";
  const auto two = parse_geojson(
      R"({"type":"Feature","properties":{},"geometry":{"type":"MultiPolygon","coordinates":[[)" +
          std::string(ring) + "]," + island + "]}}",
      "t.json");
  CHECK(two.size() == 2);
  CHECK(area(two) == doctest::Approx(15.5));
  // Two states with a common border become one part.
  const auto states = parse_geojson(R"({"type":"FeatureCollection","features":[
    {"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,1],[0,0]]]}},
    {"type":"Feature","geometry":null},
    {"type":"Feature","geometry":{"type":"Polygon","coordinates":[]}},
    {"type":"Feature","geometry":{"type":"MultiPolygon","coordinates":[]}},
    {"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[1,0],[2,0],[2,1],[1,1],[1,0]]]}}]})",
                                    "t.json");
  CHECK(states.size() == 1);
  CHECK(area(states) == doctest::Approx(2));
}

TEST_CASE("GeoJSON: errors name the line or the object") {
  const auto message = [](const std::string& text) {
    return refusal([&] { parse_geojson(text, "t.json"); });
  };
  CHECK(says(message("{\n\"type\": \"Polygon\",\n\"coordinates\": [[[0,0],\n"),
             "invalid_file: t.json:4: is not JSON, or truncated"));
  CHECK(says(message(R"({"type":"Point","coordinates":[0,0]})"), "t.json: $ is a Point; only Polygon"));
  CHECK(says(message(R"({"type":"Polygon","coordinates":[[[0,0],[1,0],[1,"a"],[0,0]]]})"),
             "$.coordinates[0][2] is not a point"));
  CHECK(says(message(R"({"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,1]]]})"),
             "$.coordinates[0] is not closed"));
  CHECK(says(message(R"({"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1e999],[0,0]]]})"),
             "invalid_file: t.json: is not JSON"));
  CHECK(says(message(R"({"type":"FeatureCollection","features":[]})"), "holds no polygon"));
  CHECK(says(message(R"({"type":"Polygon","coordinates":[]})"), "holds no polygon"));
  CHECK(says(message("[1, 2]"), "is not a GeoJSON object"));
  const std::string bow = "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[1,1],[1,0],[0,1],[0,0]]]}";
  CHECK(says(message("{\"type\":\"GeometryCollection\",\"geometries\":[" + bow + "," + bow + "]}"),
             "invalid_domain: t.json: polygon 0 (from 0): Self-intersection at (0.5, 0.5)"));
}

TEST_CASE("WKT: polygons, multipolygons, several geometries") {
  CHECK(area(parse_wkt("POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 2 1, 2 2, 1 2, 1 1))", "t.wkt")) ==
        doctest::Approx(15));
  const auto parts = parse_wkt("MULTIPOLYGON (((0 0, 1 0, 1 1, 0 0)), ((5 5, 6 5, 6 6, 5 5)))\n", "t.wkt");
  CHECK(parts.size() == 2);
  CHECK(area(parse_wkt("POLYGON ((0 0, 1 0, 1 1, 0 0));\r\nPOLYGON ((5 5, 6 5, 6 6, 5 5));\r\n", "t.wkt")) ==
        doctest::Approx(1));
}

TEST_CASE("WKT: geometries after empty ones are read") {
  const std::string one = "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))", two = "POLYGON ((2 0, 4 0, 4 1, 2 1, 2 0))";
  const auto read = [](const std::string& text) { return area(parse_wkt(text, "t.wkt")); };
  CHECK(read(one + "\nPOLYGON EMPTY\n" + two) == doctest::Approx(3));
  CHECK(read("polygon empty\n" + one) == doctest::Approx(1));
  CHECK(read("MULTIPOLYGON Z EMPTY;" + one + "MULTIPOLYGON EMPTY " + two + "\nPOLYGON EMPTY") ==
        doctest::Approx(3));
  CHECK(read("GEOMETRYCOLLECTION (POLYGON EMPTY, " + one + ", MULTIPOLYGON EMPTY)\n" + two) ==
        doctest::Approx(3));
  CHECK(read("MULTIPOLYGON (EMPTY, ((0 0, 1 0, 1 1, 0 1, 0 0)))\n" + two) == doctest::Approx(3));
}

TEST_CASE("WKT: the number of a reference system before a geometry is ignored") {
  const std::string one = "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))", two = "POLYGON ((2 0, 4 0, 4 1, 2 1, 2 0))";
  CHECK(area(parse_wkt("SRID=4326;" + one + "\nsrid=4326; " + two, "t.wkt")) == doctest::Approx(3));
  const auto message = [](const std::string& text) { return refusal([&] { parse_wkt(text, "t.wkt"); }); };
  CHECK(says(message("SRID=4326;" + one + "\nSRID=3857;" + two),
             "t.wkt:2: SRID 3857 after a geometry with SRID 4326; transform all to one system"));
  CHECK(says(message("SRID=4326" + one), "t.wkt:1: SRID= needs a number and a ';'"));
  CHECK(says(message("SRID=;" + one), "t.wkt:1: SRID= needs a number and a ';'"));
}

TEST_CASE("WKT: errors name the line") {
  const auto message = [](const std::string& text) { return refusal([&] { parse_wkt(text, "t.wkt"); }); };
  CHECK(says(message("\n\nPOLYGON ((0 0, 1 0, 1 x, 0 0))"), "invalid_file: t.wkt:3: is not well-known text"));
  CHECK(says(message("POLYGON ((0 0, 1 0, 1 1"), "t.wkt:1: a geometry whose parentheses do not close"));
  CHECK(says(message("LINESTRING (0 0, 1 0)"), "only POLYGON and MULTIPOLYGON"));
  CHECK(says(message("POLYGON ((0 0, 1 0, nan 1, 0 0))"), "t.wkt:1"));
  CHECK(says(message("  \n"), "holds no polygon"));
  CHECK(says(message("POLYGON EMPTY\nPOLYGON EMPTY\n"), "holds no polygon"));
  CHECK(says(message("POLYGON EMPTY\nPOLYGON\n"),
             "t.wkt:2: is not well-known text: 'POLYGON' is followed by neither parentheses nor EMPTY"));
  CHECK(says(message("POLYGON EMPTY ((0 0, 1 0, 1 1, 0 0))"), "t.wkt:1: is not well-known text"));
  CHECK(says(message("LINESTRING EMPTY"), "only POLYGON and MULTIPOLYGON"));
  CHECK(says(message(std::string(1000, '(')), "nested too deeply"));
}

TEST_CASE("SVG: shapes, y upwards") {
  const auto box = draw("<rect x='1' y='2' width='3' height='4'/>");
  REQUIRE(box.size() == 1);
  CHECK(area(box) == doctest::Approx(12));
  for (const auto& p : box[0].outer) {
    CHECK(p[1] <= -2);
    CHECK(p[1] >= -6);
  }
  const double pi = std::numbers::pi;
  CHECK(area(draw("<circle cx='5' cy='5' r='2'/>")) == doctest::Approx(4 * pi).epsilon(1e-3));
  CHECK(area(draw("<ellipse rx='2' ry='3'/>")) == doctest::Approx(6 * pi).epsilon(1e-3));
  CHECK(area(draw("<rect width='4' height='4' rx='1'/>")) == doctest::Approx(12 + pi).epsilon(1e-3));
  CHECK(area(draw("<polygon points='0,0 4,0 4,4'/>")) == doctest::Approx(8));
  CHECK(area(draw("<polygon points='0,0 4,0 4,4'/><rect x='2' y='0' width='2' height='2'/>")) ==
        doctest::Approx(8));
  CHECK(draw("<rect width='1' height='1'/><defs><rect x='9' width='1' height='1'/></defs>"
             "<g style='fill: red; display : none'><rect x='5' width='1' height='1'/></g>")
            .size() == 1);
}

TEST_CASE("SVG: path commands, absolute and relative, without blanks") {
  const double expected = 12;
  for (const char* d : {"M0 0 L4 0 L4 3 L0 3 Z", "m0,0 4,0 0,3-4,0z", "M0 0H4V3H0z", "m0 0h4v3h-4z",
                        "M0,0 4,0 4,3 0,3", "M0 0C1 0 2 0 4 0L4 3 0 3", "M.0.0L4,.0 4e0 3 0 30e-1z"}) {
    CAPTURE(d);
    CHECK(area(draw(std::string("<path d='") + d + "'/>")) == doctest::Approx(expected).epsilon(1e-9));
  }
  const double pi = std::numbers::pi;
  CHECK(area(draw("<path d='M-1 0 A1 1 0 0 1 1 0 A1 1 0 0 1 -1 0Z'/>")) == doctest::Approx(pi).epsilon(1e-3));
  CHECK(area(draw("<path d='M-1 0a1 1 0 102 0 1 1 0 10-2 0z'/>")) == doctest::Approx(pi).epsilon(1e-3));
  CHECK(area(draw("<path d='M1 0A1 1 0 1 1 0-1L0 0z'/>")) == doctest::Approx(0.75 * pi).epsilon(1e-3));
  CHECK(area(draw("<path d='M1 0A1 1 0 0 0 0-1L0 0z'/>")) == doctest::Approx(0.25 * pi).epsilon(1e-3));
  CHECK(area(draw("<path d='M0 0Q1 2 2 0z'/>")) == doctest::Approx(2.0 / 3 * 2).epsilon(1e-3));
  CHECK(area(draw("<path d='M0 0Q1 2 2 0T4 0z'/>")) == doctest::Approx(2.0 / 3 * 4).epsilon(1e-3));
  CHECK(area(draw("<path d='M0 0C0 1 2 1 2 0S4-1 4 0z'/>")) == doctest::Approx(2 * 1.2).epsilon(1e-3));
}

TEST_CASE("SVG: curves stay within the tolerance") {
  const auto parts = draw("<circle r='7'/>");
  const double tolerance = svg_tolerance * 7 * 2 * std::numbers::sqrt2;
  REQUIRE(parts.size() == 1);
  const Ring& ring = parts[0].outer;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto &a = ring[k], &b = ring[(k + 1) % ring.size()];
    CHECK(std::abs(std::hypot((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) - 7) <= tolerance);
  }
  CHECK(ring.size() < 400);
}

TEST_CASE("SVG: transforms of groups and elements") {
  CHECK(area(draw("<g transform='scale(2)'><g transform='translate(5 6) rotate(30)'><rect width='1' "
                  "height='1'/></g></g>")) == doctest::Approx(4));
  const auto moved =
      draw("<g transform='matrix(1 0 0 1 10 20), rotate(90, 1, 1)'><rect width='2' height='2'/></g>");
  REQUIRE(moved.size() == 1);
  for (const auto& p : moved[0].outer) {
    CHECK(p[0] >= 10 - 1e-12);
    CHECK(p[0] <= 12 + 1e-12);
    CHECK(p[1] <= -20 + 1e-12);
    CHECK(p[1] >= -22 - 1e-12);
  }
  CHECK(area(draw("<rect width='2' height='2' transform='skewX(45)'/>")) == doctest::Approx(4));
}

TEST_CASE("SVG: the two fill rules") {
  const std::string same = "M0 0H4V4H0zM1 1H3V3H1z", opposite = "M0 0H4V4H0zM1 1V3H3V1z";
  CHECK(area(draw("<path d='" + same + "'/>")) == doctest::Approx(16));
  CHECK(area(draw("<path d='" + opposite + "'/>")) == doctest::Approx(12));
  CHECK(area(draw("<path fill-rule='evenodd' d='" + same + "'/>")) == doctest::Approx(12));
  CHECK(area(draw("<g style='fill-rule:evenodd'><path d='" + same + "'/></g>")) == doctest::Approx(12));
  // A pentagram: the middle is filled only by the nonzero rule.
  const std::string star = "points='0,-10 5.878,8.09 -9.511,-3.09 9.511,-3.09 -5.878,8.09'";
  CHECK(area(draw("<polygon " + star + "/>")) >
        area(draw("<polygon fill-rule='evenodd' " + star + "/>")) + 30);
}

TEST_CASE("SVG: style sheets fill and hide") {
  const std::string frame = "d='M0 0h10v10h-10zM2 2h4v4h-4z'/>";
  for (const char* css :
       {"<style>.a{fill:#fff;fill-rule:evenodd;clip-rule:evenodd}</style><path class='b a' ",
        "<style type='text/css'><![CDATA[ .z, path { FILL-RULE : EvenOdd } ]]></style><path ",
        "<defs><style>/* .a{} */ #a { fill-rule : evenodd }</style></defs><path id='a' ",
        "<style>*{fill-rule:evenodd}</style><path fill-rule='nonzero' ",
        "<style>#a{fill-rule:evenodd} .b{fill-rule:nonzero}</style><path id='a' class='b' ",
        "<style>.a{fill-rule:evenodd!important}</style><path class='a' style='fill-rule:nonzero' ",
        "<style>.a{fill-rule:nonzero}.b{fill-rule:evenodd}</style><path class='b a' ",
        "<style>g{fill-rule:evenodd}</style><g><path fill-rule='inherit' ",
        "<style>@charset 'a'; @font-face{src:url(\"a{;\")} @media print{.a{fill:red}}"
        " path:hover{fill:red} .a{fill-rule:evenodd}</style><path class='a' ",
        "<path style=\"background:url('a;b');fill-rule:evenodd\" fill-rule='nonzero' "}) {
    CAPTURE(css);
    const std::string text = css + frame;
    CHECK(area(draw(says(text, "<g>") ? text + "</g>" : text)) == doctest::Approx(84));
  }
  CHECK(area(draw("<style>.a{fill-rule:evenodd}</style><path class='a' style='fill-rule:nonzero' " +
                  frame)) == doctest::Approx(100));
  const std::string square = "<rect width='1' height='1'/>";
  for (const char* hidden : {"<style>.h{display:none;}</style><g class='h'>",
                             "<g style='display:none !important'>", "<g display=' none'>"}) {
    CAPTURE(hidden);
    CHECK(area(draw(hidden + std::string("<rect x='5' width='1' height='1'/></g>") + square)) ==
          doctest::Approx(1));
  }
}

TEST_CASE("SVG: only what is drawn counts") {
  const std::string far = "<rect x='5' width='1' height='1'/>", square = "<rect width='1' height='1'/>";
  CHECK(area(draw("<switch>" + square + far + "</switch>")) == doctest::Approx(1));
  CHECK(area(draw("<switch><foreignObject requiredExtensions='a'/>" + square + far + "</switch>")) ==
        doctest::Approx(1));
  CHECK(area(draw("<foreignObject><svg>" + far + "</svg></foreignObject>" + square)) == doctest::Approx(1));
  CHECK(area(draw("<i:rect x='5' width='1' height='1'/><i:g xmlns:i='a'>" + far + "</i:g>" + square)) ==
        doctest::Approx(1));
  CHECK(area(draw("<s:rect xmlns:s='http://www.w3.org/2000/svg' width='2' height='1'/>")) ==
        doctest::Approx(2));
  CHECK(area(parse_svg("<s:svg>"
                       "<s:rect width='2' height='1'/></s:svg>",
                       "t.svg")) == doctest::Approx(2));
  CHECK(area(draw("<g clip-path='none' style='mask:none'><rect style='transform:none' transform='scale(3)' "
                  "width='2' height='1'/></g>")) == doctest::Approx(2));
}

TEST_CASE("SVG: use draws copies of elements") {
  const std::string a = "<rect id='a' width='1' height='1'/>";
  const auto width = [](const std::vector<PolygonPart>& parts) {
    double low = 1e300, high = -1e300;
    for (const PolygonPart& part : parts) {
      for (const auto& p : part.outer) low = std::min(low, p[0]), high = std::max(high, p[0]);
    }
    return high - low;
  };
  CHECK(area(draw("<defs>" + a + "</defs><use href='#a' x='3'/>")) == doctest::Approx(1));
  CHECK(width(draw(a + "<use href='#a' x='3'/>")) == doctest::Approx(4));
  // The attribute transform is applied after x and y; what is used may follow, and may be a group or a
  // symbol.
  CHECK(width(draw("<use xlink:href='#g' x='3' transform='scale(2)'/><g id='g' transform='scale(.5)'>" + a +
                   "</g>")) == doctest::Approx(7));
  CHECK(area(draw("<symbol id='s'>" + a + "<rect x='5' width='2' height='1'/></symbol><use href='#s'/>")) ==
        doctest::Approx(3));
  CHECK(area(draw("<g display='none'>" + a + "</g><use href='#a'/>")) == doctest::Approx(1));
  CHECK(area(draw("<style>#u{display:none}</style>" + a + "<use id='u' href='#a' x='5'/>")) ==
        doctest::Approx(1));
  // fill-rule is inherited from the element that uses, not from where the shape is written.
  const std::string twice = "<path id='p' d='M0 0H3V3H0zM1 1H2V2H1z'/>";
  CHECK(area(draw("<defs fill-rule='evenodd'>" + twice + "</defs><use href='#p'/>")) == doctest::Approx(9));
  CHECK(area(draw("<defs>" + twice + "</defs><use href='#p' fill-rule='evenodd'/>")) == doctest::Approx(8));

  const auto message = [](const std::string& body) { return refusal([&] { draw("\n" + body); }); };
  CHECK(says(message("<use href='#a'/>"), "t.svg:3: <use>: no element has the id 'a'"));
  CHECK(says(message("<use href='b.svg#a'/>"), "only elements of the same file"));
  CHECK(says(message("<use/>"), "names no element"));
  CHECK(says(message("<g id='a'><use href='#a'/></g>"), "nested too deeply"));
  CHECK(says(message("<symbol id='a' viewBox='0 0 1 1'/><use href='#a'/>"), "a symbol with a viewBox"));
  std::string doubled = "<defs>" + a;
  for (int k = 0; k < 30; ++k)
    doubled += fmt::format("<g id='a{1}'><use href='#{0}'/><use href='#{0}'/></g>",
                           k == 0 ? "a" : fmt::format("a{}", k - 1), k);
  CHECK(says(message(doubled + "</defs><use href='#a29'/>"), "draws more than"));
}

TEST_CASE("SVG: unsupported features that would change the area are refused") {
  const auto message = [](const std::string& body) { return refusal([&] { draw("\n" + body); }); };
  const auto sheet = [&](const std::string& css) { return message("<style>" + css + "</style>"); };
  CHECK(says(message("<rect clip-path='url(#c)'/>"), "t.svg:3: <rect>: clip-path is not read"));
  CHECK(says(message("<style>.a{mask:url(#m)}</style><g class='a'/>"), "t.svg:3: <g>: mask is not read"));
  CHECK(says(message("<g style='transform:scale(2)'/>"), "<g>: transform in CSS is not read"));
  CHECK(says(message("<g style='scale:2'/>"), "<g>: scale in CSS is not read"));
  CHECK(says(message("<g transform='rotate(9)' transform-origin='5 5'/>"), "transform-origin is not read"));
  CHECK(says(message("<rect style='width:5px'/>"), "<rect>: width in CSS is not read"));
  CHECK(says(message("<g systemLanguage='de'/>"), "depends on the reader's language"));
  CHECK(says(message("<path fill-rule='odd'/>"), "fill-rule 'odd' is neither"));
  CHECK(says(sheet("g .a{display:none}"),
             "t.svg:3: <style>: its rule for 'g .a' sets display, but only rules"));
  CHECK(says(sheet("@media screen{.a{display:none}}"), "display in '@media screen' depends on where"));
  CHECK(says(sheet("@import 'a.css';"), "@import is not read"));
  CHECK(says(sheet(".a{display:none"), "braces do not close"));
  CHECK(says(sheet(".a"), "ends with '.a'"));
  CHECK(says(sheet(".a{.b{display:none}}"), "rules inside rules"));
  CHECK(says(refusal([] { parse_svg("<?xml-stylesheet href='a.css'?><svg/>", "t.svg"); }),
             "t.svg:1: <xml-stylesheet>: external style sheets"));
}

TEST_CASE("SVG: errors name the line and the element") {
  const auto message = [](const std::string& text) { return refusal([&] { parse_svg(text, "t.svg"); }); };
  CHECK(says(message("<svg>\n<path d='M0 0'>\n"), "t.svg:"));
  CHECK(says(message("<svg>\n<path d='M0 0'>\n"), "is not well-formed XML"));
  CHECK(
      says(message(svg("<path d='L0 0'/>")), "invalid_file: t.svg:2: <path>: path data do not begin with M"));
  CHECK(says(message(svg("<path d='M0 0 L1'/>")), "t.svg:2: <path>: a number is expected"));
  CHECK(says(message(svg("<path d='M0 0 L1 nan'/>")), "a number is expected"));
  CHECK(says(message(svg("<path d='M0 0 X1 1'/>")), "is not a command"));
  CHECK(says(message(svg("<path d='M0 0 A1 1 0 2 1 5 5'/>")), "a flag (0 or 1)"));
  CHECK(says(message(svg("<rect width='10mm' height='1'/>")), "width='10mm' is not a number of user units"));
  CHECK(says(message(svg("<g transform='turn(3)'/>")), "'turn' with 1 numbers is not a transform"));
  CHECK(says(message(svg("")), "holds no path"));
  CHECK(says(message(svg("<path d='M0 0L1 1z'/>")), "have no area"));
  CHECK(says(message("<html/>"), "not <svg>"));
}
