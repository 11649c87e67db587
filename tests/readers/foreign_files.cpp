#include "apps/io/read/foreign_files.hpp"

#include <doctest/doctest.h>

#include "apps/io/tables/read_seeds.hpp"
#include "tests/readers/fixtures.hpp"

using namespace powercell;
using namespace powercell::io;
using namespace powercell::io::test;

TEST_CASE("files of other programs are refused with what converts them") {
  const auto seeds = [](const char* text) { return refusal([&] { parse_seeds_text(text, 3, "a.txt"); }); };
  CHECK(says(seeds("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\n"), "a.txt: is a dump of LAMMPS"));
  CHECK(says(seeds("2\nwater\nO 0 0 0\nH 1 0 0\n"), "awk 'NR > 2 {print $2, $3, $4}' a.txt"));
  CHECK(says(seeds("Si\n1.0\n1 0 0\n0 1 0\n0 0 1\nSi\n1\nDirect\n0 0 0\n"),
             "ase.io.read('a.txt', format='vasp')"));
  CHECK(says(seeds("<?xml version=\"1.0\"?>\n<kml/>\n"), "ogr2ogr -f GeoJSON points.geojson a.txt"));
  CHECK(says(seeds("# made by hand\n3 2 0 1\n1 0 0 1\n2 1 0 1\n3 0 1 0\n"),
             "a.txt: has the nodes of TetGen or Triangle"));
  CHECK(says(seeds("2 3 0 0\n0 0 0 0\n1 1 0 0\n"), "has the nodes of TetGen"));
  CHECK(seeds("4 3 0 0\n1 0 0 0\n7 1 0 0\n") == "nothing");  // a table
  CHECK(seeds("1 3 0 0\n1 2 3 4\n") == "nothing");
  CHECK(!says(seeds("offset,x,y,z\n1,0,0,0\n"), "meshio"));
  CHECK(says(seeds("# cloud\nv 0 0 0\nv 1 0 0\n"), "meshio.read('a.txt').points"));
  CHECK(says(seeds("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), "meshio.read('a.txt').points"));
  CHECK(says(refusal([&] { refuse_foreign_mesh(".ele", "m.ele"); }), "meshio convert m.ele mesh.vtu"));
  for (const char* extension : {".kml", ".shp", ".gml", ".dxf", ".topojson"})
    CHECK(says(refusal([&] { refuse_foreign_map(extension, "m"); }), "ogr2ogr -f GeoJSON map.geojson m"));
  CHECK(refusal([] { refuse_foreign_map(".txt", "m"); }) == "nothing");
}

TEST_CASE("a title before points is told from a table") {
  const auto seeds = [](const char* text) { return refusal([&] { parse_seeds_text(text, 2, "a.txt"); }); };
  CHECK(says(seeds("My points here\n1 2\n3 4\n"), "if the first line is a title, begin it with #"));
  CHECK(seeds("# My points here\n1 2\n3 4\n") == "nothing");
}
