// The command line as people type it: short forms, and slips with what they may have meant.
#include <gtest/gtest.h>

#include <fstream>

#include "pipelines/command/options/command_line.h"
#include "tests/unit/pipelines/examples/results_directory.h"

namespace {

using namespace pipelines;
using Words = std::vector<std::string>;

const std::vector<CommandNames> commands{
    {"run", {"--help", "-h", "--tolerance", "--method", "-o", "--output"}},
    {"check", {"--help", "-h", "--thorough"}},
    {"sweep", {"--help", "-h", "--vary", "--tolerance"}}};

TEST(CommandLines, HelpIsACommand) {
  EXPECT_EQ(with_command({"help"}, commands), Words{"--help"});
  EXPECT_EQ(with_command({"help", "run"}, commands), (Words{"run", "--help"}));
  EXPECT_EQ(with_command({"help", "--json"}, commands), Words{"--help"});
  EXPECT_EQ(with_command({"help", "rnu"}, commands), Words{"rnu"});
  EXPECT_EQ(with_command({"run", "help"}, commands), (Words{"run", "help"}));
  EXPECT_EQ(with_command({}, commands), Words{});
}

TEST(CommandLines, ASceneMeansRun) {
  const results_test::Directory directory;
  const auto file = (directory / "scene.txt").string();
  EXPECT_EQ(with_command({file}, commands), Words{file});
  std::ofstream(file) << "a = 1\n";
  EXPECT_EQ(with_command({file, "-q"}, commands), (Words{"run", file, "-q"}));
  EXPECT_EQ(with_command({"missing.toml", "--tolerance", "2 %"}, commands),
            (Words{"run", "missing.toml", "--tolerance", "2 %"}));
  EXPECT_EQ(with_command({"--version"}, commands), Words{"--version"});
  EXPECT_EQ(with_command({"-o.toml"}, commands), Words{"-o.toml"});
  EXPECT_EQ(with_command({""}, commands), Words{""});
}

TEST(CommandLines, MisspeltNamesAreToldWithTheNearest) {
  const std::vector<std::pair<Words, std::string>> cases{
      {{"rnu", "mill.toml"}, "millstress: rnu: is no command; did you mean \"run\"?; --help lists them"},
      {{"hlep"}, "millstress: hlep: is no command; did you mean \"help\"?; --help lists them"},
      {{"walk"}, "millstress: walk: is no command; --help lists them"},
      {{"run", "mill.toml", "--tolernce", "2 %"},
       "millstress: --tolernce: is no option of run; did you mean \"--tolerance\"?; run --help lists them"},
      {{"run", "--methd=solid", "mill.toml"},
       "millstress: --methd: is no option of run; did you mean \"--method\"?; run --help lists them"},
      {{"run", "mill.toml", "-tolerance", "2 %"},
       "millstress: -tolerance: is no option of run; did you mean \"--tolerance\"?; run --help lists them"},
      {{"run", "mill.toml", "-x"}, "millstress: -x: is no option of run; run --help lists them"},
      {{"check", "mill.toml", "--tolerance", "2 %"},
       "millstress: --tolerance: is no option of check, but of run, sweep; check --help lists them"}};
  for (const auto& [arguments, told] : cases) EXPECT_EQ(unknown_name(arguments, commands), told);
}

// What the parser refuses for another reason is its own to tell.
TEST(CommandLines, NamesThatAreThereAreNotToldAsUnknown) {
  for (const Words& arguments :
       {Words{"run", "mill.toml", "-oout", "--tolerance=2 %"}, Words{"run", "-3", "--", "--tolernce"},
        Words{"run"}, Words{"--tolernce"}, Words{}, Words{""}, Words{"run", "-", "--help"}})
    EXPECT_EQ(unknown_name(arguments, commands), "") << testing::PrintToString(arguments);
}

}  // namespace
