// Pages (.html), read as their JavaScript reads them.
#include <doctest/doctest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "apps/io/page/page.hpp"
#include "apps/io/read/domain.hpp"
#include "apps/io/tables/read_seeds.hpp"
#include "tests/writers/clip_pieces.hpp"
#include "tests/writers/made_diagram.hpp"
#include "tests/writers/temporary_folder.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++count;
  return count;
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t at = text.find(begin);
  REQUIRE(at != std::string::npos);
  const std::size_t from = at + begin.size(), to = text.find(end, from);
  REQUIRE(to != std::string::npos);
  return text.substr(from, to - from);
}

std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::size_t digit = digits.find(c);
    REQUIRE(digit != std::string::npos);
    group = group << 6 | static_cast<std::uint32_t>(digit);
    if ((bits += 6) >= 8) bytes += static_cast<char>(group >> (bits -= 8) & 255);
  }
  return bytes;
}

std::string inflated(const std::string& packed, std::size_t most) {
  std::string bytes(most, '\0');
  uLongf size = most;
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                     reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK);
  bytes.resize(size);
  return bytes;
}

class PageData {
 public:
  explicit PageData(const io::DiagramOutput& output, const std::string& name = "view.html") {
    TemporaryFolder folder;
    io::write_output(folder.file(name), output);
    text = read_all(folder.file(name));
    diagram = nlohmann::json::parse(
        between(text, "<script type=\"application/json\" id=\"diagram\">", "</script>"));
  }

  bool has(const std::string& name) const { return diagram["arrays"].contains(name); }

  template <class T>
  std::vector<T> array(const std::string& name) const {
    const std::size_t count = diagram["arrays"][name]["count"];
    std::vector<T> values(count);
    const std::string bytes = content(name, count * sizeof(T));
    REQUIRE(bytes.size() == count * sizeof(T));
    if (count > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

  std::vector<std::int64_t> integers(const std::string& name) const {
    REQUIRE(diagram["arrays"][name]["type"] == "integers");
    const std::size_t count = diagram["arrays"][name]["count"];
    std::vector<std::int64_t> values;
    std::uint64_t code = 0;
    int shift = 0;
    for (const char c : content(name, 5 * count)) {
      code |= static_cast<std::uint64_t>(c & 127) << shift;
      shift += 7;
      if ((c & 128) != 0) continue;
      const auto half = static_cast<std::int64_t>(code >> 1);
      values.push_back((values.empty() ? 0 : values.back()) + ((code & 1) != 0 ? -half - 1 : half));
      code = shift = 0;
    }
    CHECK(values.size() == count);
    return values;
  }

  std::string text;
  nlohmann::json diagram;

 private:
  std::string content(const std::string& name, std::size_t most) const {
    return inflated(from_base64(between(text, "id=\"array-" + name + "\">", "</script>")), most + 64);
  }
};

/// The faces of a page, with the area of each cell and the volume inside its faces.
struct Faces {
  std::vector<std::vector<Point>> polygon;
  std::vector<std::int64_t> inner, outer;
  std::map<std::int64_t, double> area, volume;

  explicit Faces(const PageData& page) : inner(page.integers("inner")) {
    const auto d = page.diagram["dimension"].get<std::size_t>();
    const double scale = page.diagram["frame"]["scale"];
    const auto points = page.array<float>("points");
    const auto corners = page.integers("corners"), sizes = page.integers("sizes");
    outer = page.has("outer") ? page.integers("outer") : std::vector<std::int64_t>(inner.size(), -1);
    std::size_t at = 0;
    for (std::size_t f = 0; f < sizes.size(); ++f) {
      auto& face = polygon.emplace_back();
      for (std::int64_t k = 0; k < sizes[f]; ++k, ++at) {
        Point& point = face.emplace_back();
        for (std::size_t c = 0; c < d; ++c)
          point[c] = scale * static_cast<double>(points.at(static_cast<std::size_t>(corners.at(at)) * d + c));
      }
      area[inner[f]] += test::area(face);
      double inside = 0;
      for (std::size_t k = 1; k + 1 < face.size(); ++k)
        inside += dot(face[0], cross(face[k], face[k + 1])) / 6;
      volume[inner[f]] += inside;
      if (outer[f] >= 0) volume[outer[f]] -= inside;
    }
    CHECK(at == corners.size());
  }
};

/// Rounding moves each point by 2^-24 of the domain's half diagonal.
constexpr double rounding = 1e-6;

void check_measures(const PageData& page, const MadeDiagram& made) {
  const Faces faces(page);
  auto found = made.domain.cell_dimension() == 3 ? faces.volume : faces.area;
  for (std::size_t i = 0; i < made.weights.size(); ++i) {
    CAPTURE(i);
    CHECK(std::abs(found[static_cast<std::int64_t>(i)] - made.measures.mass[i]) <
          rounding * made.domain.measure());
  }
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

io::DiagramOutput with_table(const MadeDiagram& made, const io::SeedTable& table) {
  io::DiagramOutput output = made.output();
  output.inputs.table = &table;
  return output;
}

}  // namespace

TEST_CASE("the faces of a page are the cells of the diagram") {
  for (const MadeDiagram& made : {polygon_diagram(60), surface_diagram(20), volume_diagram(30)}) {
    const PageData page(made.output());
    check_measures(page, made);
    CHECK(page.diagram["seeds"] == made.weights.size());
    CHECK(page.diagram["check"]["cells"] == made.measures.count(SeedStatus::ok));
    CHECK(page.diagram["check"]["measure"] == made.measures.total());
    CHECK(page.diagram["check"]["domain_measure"] == made.measures.domain_measure);
    CHECK(page.has("normals") == (made.domain.kind() == DomainKind::surface));
  }
}

TEST_CASE("the results of a page have the bits of the diagram") {
  for (const MadeDiagram& made : {polygon_diagram(60), volume_diagram(30)}) {
    const PageData page(made.output());
    CHECK(same_bits(page.array<double>("position"), made.positions));
    CHECK(same_bits(page.array<double>("weight"), made.weights));
    CHECK(same_bits(page.array<double>("measure"), made.measures.mass));
    CHECK(same_bits(page.array<double>("centroid"), made.measures.centroid));
    CHECK(same_bits(page.array<double>("second_moment"), made.measures.second_moment));
    const auto status = page.array<std::uint8_t>("status");
    const auto neighbors = page.integers("neighbors");
    REQUIRE(status.size() == made.weights.size());
    REQUIRE(neighbors.size() == made.weights.size());
    for (std::size_t i = 0; i < status.size(); ++i) {
      CHECK(status[i] == static_cast<int>(made.measures.status[i]));
      CHECK(neighbors[i] ==
            static_cast<std::int64_t>(made.adjacency.offset[i + 1] - made.adjacency.offset[i]));
    }
  }
}

TEST_CASE("a wall in a volume is in a page once") {
  const MadeDiagram made = volume_diagram(30);
  const Faces faces{PageData(made.output())};
  std::set<std::pair<std::int64_t, std::int64_t>> walls;
  std::size_t count = 0;
  for (std::size_t f = 0; f < faces.inner.size(); ++f) {
    if (faces.outer[f] < 0) continue;
    CHECK(faces.inner[f] < faces.outer[f]);
    walls.insert({faces.inner[f], faces.outer[f]});
    ++count;
  }
  CHECK(walls.size() == made.adjacency.neighbor.size() / 2);
  std::size_t in_cells = 0;
  for (const Border& border : made.joined.face_border)
    in_cells += border.kind == Border::Kind::wall ? 1u : 0u;
  CHECK(count == in_cells / 2);
}

TEST_CASE("a wall that only the cell of higher number has is kept") {
  MadeDiagram made = volume_diagram(30);
  // The cells of lower number forget their walls with the last cell.
  const auto last = static_cast<std::uint32_t>(made.weights.size() - 1);
  REQUIRE(made.measures.status[last] == SeedStatus::ok);
  const std::uint64_t own = made.joined.face_offset[last];
  for (std::uint64_t f = 0; f < own; ++f) {
    Border& border = made.joined.face_border[f];
    if (border.kind == Border::Kind::wall && border.index == last) border = {Border::Kind::interior, 0};
  }
  const PageData page(made.output());
  Faces faces(page);
  CHECK(std::abs(faces.volume[last] - made.measures.mass[last]) < rounding);
}

TEST_CASE("in a periodic domain a wall with an image belongs to each cell alone") {
  MadeDiagram made = volume_diagram(30);
  made.joined.shift.assign(made.joined.face_border.size(), {});
  const Faces in_place{PageData(made.output())};
  // All walls of seed 3 are with images.
  std::size_t moved = 0;
  for (std::size_t i = 0; i + 1 < made.joined.face_offset.size(); ++i)
    for (std::uint64_t f = made.joined.face_offset[i]; f < made.joined.face_offset[i + 1]; ++f) {
      const Border& border = made.joined.face_border[f];
      if (border.kind != Border::Kind::wall || (i != 3 && border.index != 3)) continue;
      made.joined.shift[f] = {i == 3 ? 1 : -1, 0, 0};
      ++moved;
    }
  REQUIRE(moved > 0);
  const PageData page(made.output());
  const Faces faces(page);
  CHECK(faces.inner.size() == in_place.inner.size() + moved / 2);
  for (std::size_t f = 0; f < faces.inner.size(); ++f) {
    CHECK(faces.outer[f] != 3);
    if (faces.inner[f] == 3) CHECK(faces.outer[f] == -1);
  }
  check_measures(page, made);
}

TEST_CASE("a page keeps the digits of large coordinates") {
  const double low[] = {3e9, -5e9}, high[] = {3e9 + 1, -5e9 + 1};
  const MadeDiagram made =
      make_diagram(Domain::box(low, high), {3e9 + 0.25, -5e9 + 0.5, 3e9 + 0.75, -5e9 + 0.5}, {0.1, 0});
  const PageData page(made.output());
  check_measures(page, made);
  CHECK(page.diagram["frame"]["offset"][0] == 3e9 + 0.5);
  for (const float value : page.array<float>("points")) CHECK(std::abs(value) <= 1);
}

TEST_CASE("columns of the seeds' table are in a page, whatever they are named and hold") {
  MadeDiagram made = polygon_diagram(4);
  const std::string evil = "</script><script>alert(1)</script><!-- \" ' & \\u003c \xff";
  std::string text = "x,y,w,\"</ScRiPt>\"\"\",people,town\n";
  const std::vector<std::string> towns = {evil, "Ulm", "", "Ulm"};
  for (std::size_t i = 0; i < 4; ++i) {
    text += std::to_string(made.positions[2 * i]) + "," + std::to_string(made.positions[2 * i + 1]) + "," +
            std::to_string(made.weights[i]) + ",7,";
    text += (i == 1 ? "" : std::to_string(i) + ".5") + ",\"";
    for (const char c : towns[i]) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    text += "\"\n";
  }
  const io::SeedTable table = io::parse_seeds_text(text, 2, "seeds.csv");
  made.weights = table.weights;
  const PageData page(with_table(made, table), "<b>&\"view.html");
  const auto& columns = page.diagram["columns"];
  REQUIRE(columns.size() == 3);  // coordinates and weights are there anyway
  CHECK(columns[0]["name"] == "</ScRiPt>\"");
  CHECK(page.array<double>("column0") == std::vector<double>(4, 7.0));
  CHECK(columns[1]["name"] == "people");
  const auto people = page.array<double>("column1");
  CHECK(people[0] == 0.5);
  CHECK(std::isnan(people[1]));
  CHECK(people[3] == 3.5);
  CHECK(columns[2]["type"] == "text");
  const auto classes = page.integers("column2");
  CHECK(classes == std::vector<std::int64_t>{0, 1, 2, 1});
  CHECK(columns[2]["values"] ==
        nlohmann::json({evil.substr(0, evil.size() - 1) + "\xef\xbf\xbd", "Ulm", ""}));
  // Nothing of it is an element of the page.
  CHECK(count_of(page.text, "<script") == page.diagram["arrays"].size() + 2);
  CHECK(count_of(page.text, "</script") == count_of(page.text, "<script"));
  CHECK(count_of(page.text, "alert(1)") == 1);
  CHECK(page.text.find("<!--") == std::string::npos);
  CHECK(between(page.text, "<title>", "</title>") == "&lt;b&gt;&amp;&quot;view: power diagram of 4 seeds");
}

TEST_CASE("a page without seeds or cells is whole") {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  const PageData page(make_diagram(Domain::box(std::span(low, 2), std::span(high, 2)), {}, {}).output());
  CHECK(page.diagram["seeds"] == 0);
  CHECK(Faces(page).polygon.empty());
}

TEST_CASE("more seeds than browsers turn are refused before anything is computed") {
  for (const auto& [name, most] :
       {std::pair("square", 1'000'000u), std::pair("sphere:4", 1'000'000u), std::pair("cube", 250'000u)}) {
    const Domain domain = io::read_domain(name).domain;
    CHECK_NOTHROW(io::check_output("a.html", domain, most));
    CHECK_NOTHROW(io::check_output("a.vtu", domain, most + 1));
    std::string message;
    try {
      io::check_output("a.html", domain, most + 1);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::unsupported);
      message = error.what();
    }
    CHECK(message.find("a.html") != std::string::npos);
    CHECK(message.find(".vtu") != std::string::npos);
  }
}

TEST_CASE("a page needs nothing from elsewhere, and its modules fit together") {
  const PageData page(polygon_diagram(10).output());
  for (const char* outside : {"http:", "https:", " src=", "@import", "url(", "fetch(", "XMLHttpRequest"})
    CHECK(page.text.find(outside) == std::string::npos);
  CHECK(page.text.find("@TITLE@") == std::string::npos);
  std::set<std::string> names;
  const std::string script = io::view_script();
  const std::regex declared("(^|\n)(async )?(const|let|class|function) ([A-Za-z_]+)");
  for (std::sregex_iterator at(script.begin(), script.end(), declared), end; at != end; ++at)
    CHECK_MESSAGE(names.insert((*at)[4]).second, (*at)[4].str() << " is declared twice");
  CHECK(names.size() > 50);
  CHECK(std::regex_search(script, std::regex("(^|\n)(import|export) ")) == false);
  // Each imported name is exported by the module that it is imported from.
  for (const auto& entry : io::view_files()) {
    const std::string file(entry.first), module(entry.second);
    const std::regex imported("(^|\n)import \\{ ([^}]*) \\} from \"\\./([a-z]+\\.js)\";");
    std::size_t lines = 0;
    for (std::sregex_iterator at(module.begin(), module.end(), imported), end; at != end; ++at, ++lines)
      for (const std::string& name : split((*at)[2], ',')) {
        const std::string bare = name.substr(name.find_first_not_of(' '));
        const std::regex exported("(^|\n)export (async )?(const|class|function) " + bare + "\\b");
        CHECK_MESSAGE(std::regex_search(std::string(io::view_file((*at)[3].str())), exported), file, ": ",
                      bare);
      }
    CHECK(lines == count_of("\n" + module, "\nimport "));
  }
}
