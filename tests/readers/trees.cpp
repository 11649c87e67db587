// Trees from tables and JSON as people have them.
#include <doctest/doctest.h>

#include <map>

#include "apps/io/read/text.hpp"
#include "apps/io/tables/read_tree.hpp"
#include "tests/readers/fixtures.hpp"

using namespace powercell;
using namespace powercell::io;
using namespace powercell::io::test;

namespace {

NamedTree tree_of(const std::string& text, const std::string& value = "", const char* extension = ".csv") {
  return parse_tree(text, extension, "t.csv", {"", value});
}

/// Names of the nodes and of their parents.
std::map<std::string, std::string> parents(const NamedTree& tree) {
  std::map<std::string, std::string> found;
  for (std::size_t k = 0; k < tree.size(); ++k)
    found[tree.name[k]] = tree.parent[k] < 0 ? "" : tree.name[static_cast<std::size_t>(tree.parent[k])];
  return found;
}

std::string tree_refusal(const std::string& text, const std::string& value = "",
                         const char* extension = ".csv") {
  return refusal([&] { tree_of(text, value, extension); });
}

const std::map<std::string, std::string> family{
    {"Eve", ""}, {"Cain", "Eve"}, {"Seth", "Eve"}, {"Enos", "Seth"}, {"Noam", "Seth"}};
const std::string family_rows = "\nEve,,10\nCain,Eve,14\nSeth,Eve,12\nEnos,Seth,10\nNoam,Seth,2\n";

}  // namespace

TEST_CASE("parents of a table are taken under the names that other programs use") {
  for (const char* header :
       {"labels,parents,values", "name,parent,size", "id,parents,value", "ids,parents,values",
        "label,parent,value", "id,Parent Node,value", "node_id,parent_id,value", "names,parents,values"}) {
    CAPTURE(header);
    const NamedTree tree = tree_of(header + family_rows);
    CHECK(parents(tree) == family);
    CHECK(tree.value[4] == 2);
  }
  CHECK(parents(tree_of("name,parent,staff" + family_rows, "staff")) == family);
  CHECK(parents(tree_of("labels,parents,values" + family_rows, "values")) == family);
  const NamedTree both = tree_of("ids,labels,parents,values\n1,a,,\n2,b,1,3\n3,b,1,4\n");
  CHECK(both.name == std::vector<std::string>{"a", "b", "b"});
  CHECK(both.parent == std::vector<std::int64_t>{-1, 0, 0});
}

TEST_CASE("links from parents to children need no row of the root") {
  for (const char* header : {"from,to,value", "source,target,value", "parent,child,value"}) {
    CAPTURE(header);
    const NamedTree tree =
        tree_of(std::string(header) + "\nEve,Cain,14\nEve,Seth,\nSeth,Enos,10\nSeth,Noam,2\n");
    CHECK(parents(tree) == family);
  }
  const std::string two_parents = "\na,x,1\nb,x,2\n";
  CHECK(says(tree_refusal("from,to,value" + two_parents), "t.csv:3: the id 'x' is also that of line 2"));
  CHECK(says(tree_refusal("from,to,value" + two_parents), "name the columns level 1 and level 2"));
  CHECK(tree_of("level 1,level 2,value" + two_parents).size() == 5);
}

TEST_CASE("advice about tables of trees leads out") {
  CHECK(says(tree_refusal("city,parent,value" + family_rows),
             "t.csv:1: the column parent has parents, but no column is "
             "called id or name"));
  CHECK(parents(tree_of("id,parent,value" + family_rows)) == family);
  CHECK(says(tree_refusal("name,parent,value\na,,\nb,a,1\nb,a,2\n"),
             "t.csv:4: the id 'b' is also that of line 3; names "
             "stand for ids here: give a column id too"));
  CHECK(says(tree_refusal("who,boss,team,pay\nann,,,3\n"), "choose it with --value-column"));
  CHECK(
      says(tree_refusal("name,parent,value\na,b,1\n"), "'a' has the parent 'b', which has no row; add one"));
}

TEST_CASE("parents of JSON are taken under the names that other programs use") {
  const char* rows =
      R"([{"name":"Eve"},{"name":"Cain","parent":"Eve","value":14},{"name":"Seth","Parent name":"Eve"},
          {"name":"Enos","parents":"Seth","value":10},{"name":"Noam","parent_id":"Seth","value":2}])";
  CHECK(parents(tree_of(rows, "", ".json")) == family);
  const char* columns =
      R"({"labels":["Eve","Cain","Seth","Enos","Noam"],"parents":["","Eve","Eve","Seth","Seth"],
                            "values":[10,14,12,10,2]})";
  const NamedTree tree = tree_of(columns, "", ".json");
  CHECK(parents(tree) == family);
  CHECK(tree.value == std::vector<double>{10, 14, 12, 10, 2});
  CHECK(says(tree_refusal(R"({"labels":["a"],"parents":["",""]})", "", ".json"),
             "'labels' is not a list as long as"));
}

TEST_CASE("the advice about a number does not change the number") {
  const auto why = [](const char* word) { return why_not(word, Parsed::not_a_number); };
  CHECK(says(why("1,200"), "write 1200 if it separates thousands, 1.200 if decimals"));
  CHECK(says(why("-12,345"), "write -12345 if"));
  CHECK(says(why("1,200,300"), "write 1200300"));
  CHECK(says(why("1,200.5"), "write 1200.5"));
  CHECK(says(why("1 200"), "write 1200"));
  CHECK(says(why("1'200"), "write 1200"));
  CHECK(says(why("1\xC2\xA0"
                 "200"),
             "write 1200"));
  for (const char* decimal : {"0,5", "1,20", "1,2000", "0,500", "1234,567", ",5"}) {
    CAPTURE(decimal);
    CHECK(says(why(decimal), "decimal commas are not read, write a point"));
  }
  for (const char* other : {"1,2,3", "1,,200", "1,200,30", "a,200", ",200,300", "$40"}) {
    CAPTURE(other);
    CHECK(why(other) == "'" + std::string(other) + "' is not a number");
  }
  CHECK(says(tree_refusal("name,value\na,\"1,200\"\n"), "write 1200 if it separates thousands"));
}
