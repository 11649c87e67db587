#include "apps/io/tables/column_units.hpp"

#include <doctest/doctest.h>

#include "apps/io/tables/read_seeds.hpp"
#include "tests/readers/fixtures.hpp"

using namespace powercell;
using namespace powercell::io;
using namespace powercell::io::test;

namespace {

SeedTable read(const std::string& header, const ColumnChoice& choice = {}) {
  return parse_seeds_text(header + "\n0.25,0.5,3\n1,-2,4\n", 2, "s.csv", choice);
}

std::string message(const std::string& header, const ColumnChoice& choice = {}) {
  return refusal([&] { read(header, choice); });
}

}  // namespace

TEST_CASE("headings are split into name and unit") {
  using Unit = ColumnHeading::Unit;
  const auto is = [](const char* field, const char* name, Unit kind, const char* unit) {
    CAPTURE(field);
    const ColumnHeading heading = column_heading(field);
    CHECK(heading.name == name);
    CHECK(heading.kind == kind);
    CHECK(heading.unit == unit);
  };
  for (const char* field :
       {"radius (mm)", "Radius[mm]", "radius_mm", "radius mm", "radius/mm", " Radius (Millimetres) ",
        "radius, mm", "radius in mm", "radius {mm}", "radius-mm"})
    is(field, "radius", Unit::length, "mm");
  for (const char* field : {"w_mm2", "w (mm^2)", "w [mm\xC2\xB2]", "w [sq mm]", "w sq mm", "w (mm**2)",
                            "w mm^2", "w (square millimetres)", "w_mm_squared", "w [mm 2]", "w [mm\xB2]"})
    is(field, "w", Unit::area, "mm");
  for (const char* field : {"r (\xC2\xB5m)", "r (\xCE\xBCm)", "r_um", "r [\xB5m]", "r (microns)"})
    is(field, "r", Unit::length, "um");
  is("r (\xC3\x85)", "r", Unit::length, "angstrom");
  is("lon (\xC2\xB0)", "lon", Unit::degree, "deg");
  is("lat_deg", "lat", Unit::degree, "deg");
  is("weight (kg)", "weight", Unit::other, "kg");
  is("r_in", "r_in", Unit::none, "");
  is("r (in)", "r", Unit::length, "inch");
  for (const char* field : {"m", "(mm)", "_m", "", "radius", "norm", "x_coord", "()"})
    is(field, field, Unit::none, "");
}

TEST_CASE("weights with units are taken as those without are") {
  for (const char* header : {"x (mm),y (mm),weight (mm2)", "x_mm,y_mm,weight_mm2", "X [m],Y [m],Weight [m^2]",
                             "x,y,w (m\xC2\xB2)", "x[mm],y[mm],weights [sq mm]", "x,y,w_mm2",
                             "lon (deg),lat (deg),weight (m2)", "easting_m,northing_m,w_m2"}) {
    CAPTURE(header);
    const SeedTable seeds = read(header);
    CHECK(seeds.positions == std::vector<double>{0.25, 0.5, 1, -2});
    CHECK(seeds.weights == std::vector<double>{3, 4});
    CHECK(seeds.columns.named);
  }
  CHECK(parse_seeds_text("x,y,weight (mm2),weight\n1,2,3,4\n", 2, "s.csv").weights == std::vector<double>{4});
  CHECK(read("lon (deg),lat [\xC2\xB0],w").columns.degrees);
  CHECK(!read("lon (m),lat (m),w").columns.degrees);
  CHECK(says(message("weight_m2,a,b"), "the header names no coordinates"));
}

TEST_CASE("radii and diameters with units are refused with a way out, as those without are") {
  for (const char* header :
       {"x (mm),y (mm),radius (mm)", "x_m,y_m,r_m", "x,y,Radius [px]", "x,y,radii_um", "a,b,radius"}) {
    CAPTURE(header);
    CHECK(says(message(header), "and no column of weights"));
    CHECK(says(message(header), "--radius-column "));
  }
  CHECK(says(message("x,y,radius (mm)"), "--radius-column 'radius (mm)'"));
  CHECK(read("x (mm),y (mm),radius (mm)", {{}, "", "radius (mm)", ""}).weights == std::vector<double>{9, 16});
  for (const char* header : {"x,y,diameter", "x (mm),y (mm),Diameter (mm)", "x_m,y_m,diameter_m"}) {
    CAPTURE(header);
    CHECK(says(message(header), "half the diameters"));
  }
}

TEST_CASE("a weight whose unit is no length squared is taken only if it is chosen") {
  CHECK(
      says(message("x,y,weight (kg)"), "give --weight-column 'weight (kg)' to take its numbers as they are"));
  CHECK(read("x,y,weight (kg)", {{}, "weight (kg)", "", ""}).weights == std::vector<double>{3, 4});
  CHECK(says(message("x,y,weight_mm"), "or --radius-column weight_mm to use their squares"));
  CHECK(read("x,y,weight_mm", {{}, "", "weight_mm", ""}).weights == std::vector<double>{9, 16});
  CHECK(read("x,y,weight_mm", {{}, "weight_mm", "", ""}).weights == std::vector<double>{3, 4});
}

TEST_CASE("columns whose units contradict each other are refused") {
  const ColumnChoice radius{{}, "", "3", ""};
  CHECK(says(message("x (m),y (mm),w"), "'x (m)' and 'y (mm)' have different units"));
  CHECK(says(message("x (m),y (m),weight (mm2)"), "'x (m)' and 'weight (mm2)' have different units"));
  CHECK(says(message("x_m,y_m,radius_mm", radius), "'x_m' and 'radius_mm' have different units"));
  CHECK(says(message("lon,lat,radius (km)", radius), "projected to a plane in metres"));
  CHECK(says(message("x_m,y_m,area_m2", radius), "--weight-column area_m2"));
  CHECK(read("x (metres),y_m,radius [m]", radius).weights == std::vector<double>{9, 16});
  CHECK(read("lon,lat,radius (m)", radius).weights == std::vector<double>{9, 16});
}
