// Damage that a file's own text shows is told with its line, before gmsh sees it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "meshes/imported/file_checks.h"
#include "tests/unit/meshes/examples/tetrahedra_file.h"

namespace {

const std::string step = R"(ISO-10303-21;
HEADER;
FILE_NAME('it''s #9; here','');
ENDSEC;
DATA;
#1=CARTESIAN_POINT('',(0.,0.,0.)); /* not #7
   nor ; this */
#2=VERTEX_POINT('#8',#1);
#3=(A(#1)
  B(#2));
ENDSEC;
END-ISO-10303-21;
)";

const std::string msh_41 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 0 1
1 0 0 0 1 1 1 1 5 0
$EndEntities
$Nodes
1 4 1 4
3 1 0 4
1
2
3
4
0 0 0
1 0 0
0 1 0
0 0 1
$EndNodes
$Elements
1 1 1 1
3 1 4 1
1 1 2 3 4
$EndElements
)";

const std::string msh_22 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
4
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
$EndNodes
$Elements
1
1 4 2 5 1 1 2 3 4
$EndElements
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no " + from);
  return text.replace(at, from.size(), to);
}

using Damage = std::pair<std::string, std::vector<std::string>>;  // text, words of the refusal

void expect_all_refused(void (*check)(const std::string&), const std::vector<Damage>& all) {
  for (const auto& damage : all) expect_words(refusal_of([&] { check(damage.first); }), damage.second);
}

TEST(DamagedFiles, SoundTextsPass) {
  EXPECT_NO_THROW(meshes::check_step_text(step));
  EXPECT_NO_THROW(meshes::check_msh_text(msh_41));
  EXPECT_NO_THROW(meshes::check_msh_text(msh_22));
  EXPECT_NO_THROW(meshes::check_msh_text("$MeshFormat\n4 0 8\n$EndMeshFormat\nof another version"));
}

// OpenCASCADE reads all of these; the check of the text refused some of them as cut off.
TEST(DamagedFiles, StepTextsThatReadersTakeAreNone) {
  const std::string last = "END-ISO-10303-21;\n";
  std::string small = step, old_mac = step;
  for (char& c : small) c = char(std::tolower(c));
  std::replace(old_mac.begin(), old_mac.end(), '\n', '\r');
  for (const auto& text :
       {with(step, last, "End-ISO-10303-21;"), small, old_mac, "\xEF\xBB\xBF" + step,
        step + std::string(9, '\0'), step + "\x1a", step + "  \n\t\n", step + "what is this? '#77",
        with(step, last, "END-ISO-10303-21 ;"), with(step, last, "END-ISO-10303-21 /* the end; */ ;"),
        "/* by hand */\n" + step, with(step, "ENDSEC;\nDATA;", "FILE_SCHEMA(('A','B'));\nENDSEC;\nDATA;")})
    EXPECT_EQ(refusal_of([&] { meshes::check_step_text(text); }), "accepted") << text;
  expect_words(refusal_of([&] { meshes::check_step_text(with(old_mac, "#1=CART", "#4=CART")); }), {"line 8"});
}

TEST(DamagedFiles, OfStepAreToldWithLineAndEntity) {
  expect_all_refused(meshes::check_step_text,
                     {{with(step, "#1=CART", "#4=CART"), {"line 8", "#2 refers to #1", "export"}},
                      {with(step, "B(#2)", "B(#77)"), {"line 10", "#3 refers to #77"}},
                      {with(step, "#2=VERT", "#1=VERT"), {"line 8", "#1 is defined a second time", "line 6"}},
                      {with(step, "B(#2));\nENDSEC;\nEND-ISO-10303-21;\n", "B("), {"line 9", "does not end"}},
                      {with(step, "\nEND-ISO-10303-21;", ""), {"END-ISO-10303-21", "cut off"}},
                      {with(step, "'#8'", "'#8"), {"line 8", "a text that begins here does not end"}},
                      {with(step, "this */", "this"), {"line 6", "a comment that begins here does not end"}},
                      {"something else", {"no STEP file"}}});
}

TEST(DamagedFiles, OfMsh41AreToldWithTheLine) {
  expect_all_refused(
      meshes::check_msh_text,
      {{with(msh_41, "\n3\n4\n", "\n-1\n4\n"), {"line 13", "the number of a node is -1"}},
       {with(msh_41, "\n3\n4\n", "\n2147483648\n4\n"), {"line 13", "2147483648"}},
       {with(msh_41, "\n3\n4\n", "\n2\n4\n"), {"line 13", "node 2 is there twice"}},
       {with(msh_41, "1 4 1 4", "1 4 1 2147483648"), {"line 9", "largest number of nodes"}},
       {with(msh_41, "1 4 1 4", "1 400000 1 4"), {"line 9", "the number of nodes is 400000"}},
       {with(msh_41, "1 4 1 4", "1 5 1 4"), {"4 nodes", "says 5"}},
       {with(msh_41, "1 0 0\n", "nan 0 0\n"), {"line 16", "not finite"}},
       {with(msh_41, "1 0 0\n", "1e999 0 0\n"), {"line 16", "not finite"}},
       {with(msh_41, "1 0 0\n", "one 0 0\n"), {"a number is missing", "coordinate"}},
       {with(msh_41, "1 1 2 3 4", "1 1 2 3 9"), {"line 23", "the node 9, which the file does not have"}},
       {with(msh_41, "1 1 2 3 4", "1 1 2 3 -4"), {"line 23", "the node -4"}},
       {with(msh_41, "1 1 2 3 4", "1 1 2 3"), {"a number is missing"}},
       {with(msh_41, "1 1 2 3 4", "1 1 2 3 4 5"), {"more than its counts say"}},
       {with(msh_41, "3 1 4 1\n", "3 1 99 1\n"), {"line 22", "type 99"}},
       {with(msh_41, "3 1 4 1\n", "2 1 4 1\n"), {"line 22", "dimension 3"}},
       {with(msh_41, "$EndElements\n", ""), {"no $EndElements", "cut off"}},
       {with(msh_41, "1 1 1 1 5 0", "1 1 1 9 5 0"), {"number of groups"}},
       {with(msh_41, "$MeshFormat\n", ""), {"no section $MeshFormat"}}});
}

TEST(DamagedFiles, OfMsh22AreToldWithTheLine) {
  expect_all_refused(meshes::check_msh_text,
                     {{with(msh_22, "\n3 0 1 0", "\n-1 0 1 0"), {"line 8", "-1"}},
                      {with(msh_22, "\n3 0 1 0", "\n2 0 1 0"), {"line 8", "node 2 is there twice"}},
                      {with(msh_22, "\n3 0 1 0", "\n3 0 inf 0"), {"line 8", "not finite"}},
                      {with(msh_22, "\n4\n", "\n5\n"), {"a number is missing"}},
                      {with(msh_22, "1 4 2 5 1 1 2 3 4", "1 4 2 5 1 1 2 3 5"), {"line 13", "the node 5"}},
                      {with(msh_22, "1 4 2 5 1 1 2 3 4", "1 44 2 5 1 1 2 3 4"), {"line 13", "type 44"}},
                      {with(msh_22, "1 4 2 5", "1 4 2000000 5"), {"line 13", "number of tags"}}});
}

}  // namespace
