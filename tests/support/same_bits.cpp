#include "tests/support/same_bits.hpp"

#include <cstring>
#include <sstream>

namespace powercell::test {
namespace {

template <class T>
void show(std::ostream& out, const T& value) {
  out << value;
}
void show(std::ostream& out, SeedStatus value) {
  out << static_cast<int>(value);
}
void show(std::ostream& out, const Border& value) {
  out << static_cast<int>(value.kind) << ':' << value.index;
}

class Comparison {
 public:
  Comparison() { text_ << std::hexfloat; }

  template <class T>
  Comparison& of(const char* name, const std::vector<T>& a, const std::vector<T>& b) {
    if (a.size() != b.size()) {
      text_ << name << ": " << a.size() << " and " << b.size() << " entries; ";
      return *this;
    }
    std::size_t differ = 0, first = 0;
    for (std::size_t i = a.size(); i-- > 0;)
      if (std::memcmp(&a[i], &b[i], sizeof(T)) != 0) {
        ++differ;
        first = i;
      }
    if (differ == 0) return *this;
    text_ << name << ": " << differ << " of " << a.size() << " differ, first [" << first << "] ";
    show(text_, a[first]);
    text_ << " and ";
    show(text_, b[first]);
    text_ << "; ";
    return *this;
  }
  template <class T>
  Comparison& of(const char* name, T a, T b) {
    return of(name, std::vector<T>{a}, std::vector<T>{b});
  }
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

}  // namespace

Results results_of(Diagram& diagram) {
  return {diagram.measures(), diagram.adjacency(), diagram.cells(), diagram.dual()};
}

std::string bit_differences(const Measures& a, const Measures& b) {
  return Comparison()
      .of("dimension", a.dimension, b.dimension)
      .of("mass", a.mass, b.mass)
      .of("centroid", a.centroid, b.centroid)
      .of("second_moment", a.second_moment, b.second_moment)
      .of("status", a.status, b.status)
      .of("domain_measure", a.domain_measure, b.domain_measure)
      .text();
}

std::string bit_differences(const Adjacency& a, const Adjacency& b) {
  return Comparison()
      .of("adjacency offset", a.offset, b.offset)
      .of("neighbor", a.neighbor, b.neighbor)
      .of("wall", a.wall, b.wall)
      .of("asymmetry", a.asymmetry, b.asymmetry)
      .of("first of asymmetric", a.asymmetric[0], b.asymmetric[0])
      .of("second of asymmetric", a.asymmetric[1], b.asymmetric[1])
      .text();
}

std::string bit_differences(const Cells& a, const Cells& b) {
  return Comparison()
      .of("cell_offset", a.cell_offset, b.cell_offset)
      .of("region", a.region, b.region)
      .of("vertex_offset", a.vertex_offset, b.vertex_offset)
      .of("vertices", a.vertices, b.vertices)
      .of("face_offset", a.face_offset, b.face_offset)
      .of("border", a.border, b.border)
      .of("loop_offset", a.loop_offset, b.loop_offset)
      .of("loop", a.loop, b.loop)
      .text();
}

std::string bit_differences(const Dual& a, const Dual& b) {
  return Comparison().of("corners", a.corners, b.corners).of("simplices", a.simplices, b.simplices).text();
}

std::string bit_differences(const Results& a, const Results& b) {
  return bit_differences(a.measures, b.measures) + bit_differences(a.adjacency, b.adjacency) +
         bit_differences(a.cells, b.cells) + bit_differences(a.dual, b.dual);
}

}  // namespace powercell::test
