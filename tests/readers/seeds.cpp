#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <ctime>
#include <limits>

#include "apps/io/tables/read_seeds.hpp"
#include "tests/readers/fixtures.hpp"

using namespace powercell;
using namespace powercell::io;
using namespace powercell::io::test;

namespace {
const std::vector<double> positions{0.25, 0.5, 1, -2};
}

TEST_CASE("text and CSV in every notation give the same seeds") {
  for (const char* text :
       {"0.25 0.5 3\n1 -2 4\n", "0.25,0.5,3\n1,-2,4", "0.25; 0.5 ;3\r\n1;-2;4\r\n",
        "\t0.25\t0.5\t3\n\n1\t-2\t4\n\n", "# comment\n0.25 0.5 3 # one\n1 -2 +4\n", "2\n0.25 0.5 3\n1 -2 4\n",
        "x,y,weight\n0.25,.5,3e0\n1,-2,4\n", "a b c\n0.25 0.5 3\n1 -2 4\n",
        "\xEF\xBB\xBF"
        "X,Y,W\n0.25,0.5,3\n1,-2,4\n",
        "seed,x,weight,y,status\n0,0.25,3,0.5,ok\n1,1,4,-2,hidden\n",
        "\"w\",\"y\",\"x\"\n3,0.5,0.25\n4,-2,1\n", "weights;LAT;Long\n3;0.5;0.25\n4;-2;1\n",
        "easting\tnorthing\tw\n0.25\t0.5\t3\n1\t-2\t4\n", "lon,lat,y,x,w\n8,9,.5,.25,3\n8,9,-2,1,4\n",
        "City Name,x,y,w\nNew York,0.25,0.5,3\n\"Rome, \"\"old\"\" #2\",1,-2,4\n,,,\n",
        "name\tx\ty\tw\n\t0.25\t0.5\t3\n\t1\t-2\t4\n", "\"two\nlines\",x,y,w\n,0.25,0.5,3\n,1,-2,4\n",
        "x,y,w,\n0.25,0.5,3,\n1,-2,4,\n", "0.25\t0.5\t3\t\n1\t-2\t4\t\n"}) {
    CAPTURE(text);
    const SeedTable seeds = parse_seeds_text(text, 2, "s.txt");
    CHECK(seeds.positions == positions);
    CHECK(seeds.weights == std::vector<double>{3, 4});
  }
}

TEST_CASE("weights are 0 if no row has one") {
  CHECK(parse_seeds_text("0.25 0.5\n1 -2\n", 2, "s.txt").weights == std::vector<double>{0, 0});
  CHECK(parse_seeds_text("1 2 3\n4 5 6\n", 3, "s.txt").weights == std::vector<double>{0, 0});
  CHECK(parse_seeds_text("1 2 3 4\n", 3, "s.txt").weights == std::vector<double>{4});
  CHECK(parse_seeds_text("0\n", 3, "s.txt").count() == 0);
  CHECK(parse_seeds_text("x y\n", 2, "s.txt").count() == 0);
}

TEST_CASE("errors in tables name line and seed") {
  const auto message = [](const std::string& text, int d = 2) {
    return refusal([&] { parse_seeds_text(text, d, "s.csv"); });
  };
  CHECK(says(message("1 2 3\n4 5\n"),
             "invalid_file: s.csv:2: seed 1 (from 0) has 2 columns, the rows before have 3"));
  CHECK(says(message("1 2\n4 5 6\n"), "s.csv:2: seed 1"));
  CHECK(says(message("1 2 3\n4 nan 5\n"),
             "invalid_seed: s.csv:2: seed 1 (from 0), column 2: 'nan' is not a finite number"));
  CHECK(says(message("# c\n1 2 -inf\n"), "invalid_seed: s.csv:2: seed 0 (from 0), column 3"));
  CHECK(says(message("1 2 1e999\n"), "is too large for a double"));
  CHECK(says(message("1 2 3\n4 five 6\n"),
             "invalid_file: s.csv:2: seed 1 (from 0), column 2: 'five' is not a number"));
  CHECK(says(message("1,,3\n"), "column 2: is empty"));
  CHECK(says(message("1,2,\n"), "column 3: is empty"));
  CHECK(says(message("3\n1 2 3\n1 2 3\n"), "s.csv:1: 3 seeds are announced, but the file has 2"));
  CHECK(says(message("1 2 3 4\n"), "s.csv:1: 4 columns"));
  CHECK(says(message("1 2\n", 3), "s.csv:1: 2 columns"));
  CHECK(says(message("x,y\n1,2\n", 3), "s.csv:1: the header names some of x, y, z"));
  CHECK(says(message(std::string("1 2\0 3\n", 7)), "NUL bytes"));
  CHECK(parse_seeds_text("1 2 1e-400\n", 2, "s.csv").weights[0] == 0);
}

TEST_CASE("ambiguous tables are refused") {
  const auto message = [](const std::string& text, int d = 2) {
    return refusal([&] { parse_seeds_text(text, d, "s.csv"); });
  };
  for (const char* header :
       {"w,lon", "id,a,b", "fid,a,b", "Name,a,b", "seed,a,b", "a,b,weight", ",a,b", "w,lon", "x,lat"}) {
    CAPTURE(header);
    CHECK(says(message(std::string(header) + "\n1,2,3\n"), "invalid_file: s.csv:1: the header names "));
    CHECK(says(message(std::string(header) + "\n1,2,3\n"), "x, y, weight"));
  }
  CHECK(says(message("x,x,y\n1,2,3\n"), "s.csv:1: the header has columns 'x' and 'x'"));
  CHECK(says(message("lon,lat,easting\n1,2,3\n"), "has columns 'lon' and 'easting', which mean the same"));
  CHECK(says(message("x,y,w,weight\n1,2,3,3\n"), "has columns 'w' and 'weight'"));
  CHECK(says(message("x,y,Radius\n1,2,3\n"),
             "s.csv:1: the header has a column 'Radius' and no column of weights"));
  CHECK(parse_seeds_text("x,y,r,w\n1,2,3,9\n", 2, "s.csv").weights == std::vector<double>{9});
  for (const char* text : {"\"0,5\",1\n", "\"0,5\" 1\n"}) {
    CAPTURE(text);
    CHECK(says(message(text), "'0,5' is not a number: decimal commas are not read"));
  }
  CHECK(
      says(message("x,y,n1,n2\n1 5,0.2,0.3\n"), "s.csv:2: seed 0 (from 0) has 3 columns, the header has 4"));
  CHECK(says(message("x y\n0.1,0.2\n"), "(columns are separated by blanks in this file)"));
  CHECK(says(message("1 500\t2\t3\n", 3), "column 1: '1 500' is not a number"));
  CHECK(says(message("a,b\n1,2\n\"1,2\n"), "s.csv:3: a quote is opened and never closed"));
  CHECK(says(message("a,b\n\"1\"0,2\n"), "s.csv:2: there is text after a closing quote"));
  CHECK(says(message("name,x,y\n\"two\nlines\",1,2\nb,1,z\n"), "s.csv:4: seed 1"));
  CHECK(says(message(std::string(20000, ',')), "more than 16384 columns"));
}

TEST_CASE("the columns used are reported if the header leaves a doubt") {
  const auto note = [](const std::string& text) { return parse_seeds_text(text, 2, "s.csv").columns.note; };
  CHECK(note("1 2 3\n") == "");
  CHECK(note("x,y,w\n1,2,3\n") == "");
  CHECK(note("x,y\n1,2\n") == "seeds: x from 'x', y from 'y', no weights");
  CHECK(note("lon,lat,w\n1,2,3\n") == "seeds: x from 'lon', y from 'lat', weight from 'w'");
  CHECK(note("lat,lon,w,City\n1,2,3,a\n") ==
        "seeds: x from 'lon', y from 'lat', weight from 'w'; kept: 'City'");
  CHECK(note("a,b,c\n1,2,3\n") == "seeds: x from 'a', y from 'b', weight from 'c' (by their order)");
  CHECK(note("x,y,w,a,b,c,d,e,f,g\n1,2,3,4,5,6,7,8,9,10\n") ==
        "seeds: x from 'x', y from 'y', weight from 'w'; kept: 'a', 'b', 'c', 'd', 'e' and 2 more");
}

TEST_CASE("columns are chosen by name or number") {
  const auto read = [](const std::string& text, const ColumnChoice& choice, int d = 2) {
    const SeedTable seeds = parse_seeds_text(text, d, "s.csv", choice);
    CHECK(seeds.positions == (d == 2 ? positions : std::vector<double>{0.25, 0.5, 1, -2, 3, 4}));
    return seeds;
  };
  const std::string stations = "no,lon,lat,X_m,Y_m,Sales,r\n7,8,9,0.25,0.5,3,2\n8,8,9,1,-2,4,3\n";
  const SeedTable named = read(stations, {{"X_m", "y_M", ""}, "sales", "", "no"});
  CHECK(named.weights == std::vector<double>{3, 4});
  CHECK(named.columns.taken == "x from 'X_m', y from 'Y_m', weight from 'Sales'");
  CHECK(!named.columns.degrees);
  CHECK(named.columns.id == 0);
  CHECK(named.text.rows() == 2);
  CHECK(named.text.field(1, 5) == "4");
  CHECK(read(stations, {{"4", "5", ""}, "", "r", ""}).weights == std::vector<double>{4, 9});
  CHECK(read(stations, {{"4", "5", ""}, "", "r", ""}).columns.taken ==
        "x from 'X_m', y from 'Y_m', weight from 'r' squared");
  CHECK(read("0.5 0.25 3\n-2 1 4\n", {{"2", "1", ""}, "3", "", ""}).weights == std::vector<double>{3, 4});
  CHECK(read("0.5 0.25 3\n-2 1 4\n", {{"2", "1", ""}, "", "", ""}).weights == std::vector<double>{0, 0});
  CHECK(read("1 0.25 0.5 1 2\n2 -2 3 4 3\n", {{"2", "3", "4"}, "", "5", ""}, 3).weights ==
        std::vector<double>{4, 9});
  CHECK(parse_seeds_text("lng,lat\n1,2\n", 2, "s.csv").columns.degrees);
  CHECK(!parse_seeds_text("easting,northing\n1,2\n", 2, "s.csv").columns.degrees);
}

TEST_CASE("names like those of coordinates are taken and reported") {
  for (const char* header : {"x_coord,y_coord,w", "Xcoord,Ycoord,w", "POINT_X,POINT_Y,w", "x (mm),y (mm),w",
                             "\"pos x [m]\",\"pos y [m]\",w", "centroid.x,centroid.y,w"}) {
    CAPTURE(header);
    const SeedTable seeds = parse_seeds_text(std::string(header) + "\n0.25,0.5,3\n1,-2,4\n", 2, "s.csv");
    CHECK(seeds.positions == positions);
    CHECK(seeds.columns.named);
    CHECK(says(seeds.columns.note, "seeds: x from '"));
  }
  for (const char* header : {"max,may,w", "taxi,y_coord,w", "x_old,y_old,w", "x1,x2,w"}) {
    CAPTURE(header);
    CHECK(says(refusal([&] { parse_seeds_text(std::string(header) + "\n1,2,3\n", 2, "s.csv"); }),
               "the header names"));
  }
  CHECK(says(refusal([] { parse_seeds_text("x_m,x_coord,y_m\n1,2,3\n", 2, "s.csv"); }),
             "'x_m' and 'x_coord', which mean"));
}

TEST_CASE("ids must differ") {
  const ColumnChoice choice{{}, "", "", "Code"};
  CHECK(parse_seeds_text("code,x,y\na,1,2\nb,1,3\n", 2, "s.csv", choice).columns.id == 0);
  CHECK(says(refusal([&] { parse_seeds_text("code,x,y\na,1,2\nb,1,3\na,1,4\n", 2, "s.csv", choice); }),
             "s.csv: seeds 0 and 2 (from 0) have the same id 'a'"));
}

TEST_CASE("chosen columns that do not fit are refused") {
  const auto message = [](const std::string& text, const ColumnChoice& choice) {
    return refusal([&] { parse_seeds_text(text, 2, "s.csv", choice); });
  };
  CHECK(says(message("x,y\n1,2\n", {{}, "sales", "", ""}),
             "s.csv:1: no column 'sales'; the header has 'x', 'y'"));
  CHECK(says(message("1,2\n", {{"x", "y", ""}, "", "", ""}),
             "no column 'x': the table has no header; give a number from 1 to 2"));
  CHECK(says(message("1,2\n", {{"3", "1", ""}, "", "", ""}), "no column '3'"));
  CHECK(says(message("1,2\n", {{"2", "", ""}, "", "", ""}), "give --x-column and --y-column together"));
  CHECK(says(message("1,2,3\n", {{"1", "2", "3"}, "", "", ""}), "--z-column is given"));
  CHECK(says(message("1,2,3\n", {{}, "3", "3", ""}), "are both given"));
  CHECK(says(message("1,2,3\n", {{}, "1", "", ""}), "the first 2 columns are the coordinates"));
  CHECK(says(message("1,2,3\n", {{}, "", "", "1"}), "the first 2 columns are the coordinates"));
  CHECK(says(message("1,2,-3\n", {{}, "", "3", ""}), "column 3: the radius is -3"));
  CHECK(says(message("a,A,x,y\n1,2,3,4\n", {{}, "", "", "\tA"}), "several columns are named"));
}

TEST_CASE("NumPy arrays") {
  const auto load = [](const char* file, int d) { return parse_seeds_npy(data_bytes(file), d, file); };
  const SeedTable c = load("seeds_c.npy", 3), fortran = load("seeds_fortran.npy", 3),
                  big = load("seeds_float.npy", 3);
  CHECK(c.positions == std::vector<double>{0.25, 0.5, 0.75, 0.1, 0.2, 0.3, 1, 2, 3});
  CHECK(c.weights == std::vector<double>{0.125, -4, 0});
  CHECK(fortran.positions == c.positions);
  CHECK(fortran.weights == c.weights);
  CHECK(big.positions[3] == static_cast<double>(0.1f));
  CHECK(big.weights == c.weights);
  CHECK(load("seeds_int.npy", 3).positions == std::vector<double>{1, 2, 3, 4, 5, 6});
  CHECK(load("seeds_int.npy", 2).weights == std::vector<double>{3, 6});
}

TEST_CASE("malformed NumPy arrays are refused") {
  const auto message = [](std::string bytes, int d = 3) {
    return refusal([&] { parse_seeds_npy(bytes, d, "s.npy"); });
  };
  const std::string good = data_bytes("seeds_c.npy");
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string bytes = good;
    const auto at = bytes.find(from);
    REQUIRE(at != std::string::npos);
    return bytes.replace(at, from.size(), to);
  };
  CHECK(says(message(good.substr(0, good.size() - 1)), "the file ends in the array"));
  CHECK(says(message(replaced("(3, 4), }      ", "(3000000000,4),")), "the file ends in the array"));
  CHECK(says(message(replaced("<f8", "|O8")), "numbers of type '|O8' are not read"));
  CHECK(says(message(replaced("(3, 4)", "(3, 9)")), "has 9 columns"));
  CHECK(says(message(replaced("(3, 4)", "(12, )")), "is an array of 1 dimensions"));
  CHECK(says(message(replaced("NUMPY", "NUMPI")), "does not begin as a .npy file"));
  CHECK(says(message(good, 2), "has 4 columns; seeds of this domain have 2 coordinates"));
  std::string nan = good;
  const double value = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(nan.data() + nan.size() - 8 * 5, &value, 8);
  CHECK(says(message(nan), "invalid_seed: s.npy: seed 1 (row from 0), column 3"));
  for (std::size_t cut = 0; cut < good.size(); ++cut) CHECK(message(good.substr(0, cut)) != "nothing");
}

TEST_CASE("the time that seeds are read in grows with their number") {
  const auto seconds = [](int count) {
    std::string text;
    for (int k = 0; k < count; ++k) text += "0.12345678901234567 0.98765432109876543 0.5 1e-3\n";
    const std::clock_t begin = std::clock();  // processor time: the machine may be busy
    CHECK(parse_seeds_text(text, 3, "s.txt").count() == static_cast<std::size_t>(count));
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  };
  seconds(1000);
  // Eight times, or a little more where the seeds leave the cache; if it grew with the square, 64 times.
  CHECK(seconds(400000) < 24 * seconds(50000));
}

TEST_CASE("the specification of random seeds") {
  const RandomSeeds what = parse_random_spec("random:100:-1:2.5:9");
  CHECK(what.count == 100);
  CHECK(what.low == -1);
  CHECK(what.high == 2.5);
  CHECK(what.seed == 9);
  CHECK(parse_random_spec("random:0").count == 0);
  for (const char* spec : {"random:", "random:x", "random:5:1", "random:5:2:1", "random:5:0:1:z", "random:-5",
                           "random:5:nan:1", "random:99999999999"}) {
    CAPTURE(spec);
    CHECK(says(refusal([&] { parse_random_spec(spec); }), std::string("invalid_argument: seeds '") + spec));
  }
}
