#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

// Goes red when kinetics reaches for a mesh, a solver, a file format or another folder: headers of those
// compile from any target here, so only reading the sources shows it.
TEST(Kinetics, IncludesOnlyItselfEigenAndStd) {
  const std::regex include(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  const std::regex allowed(R"(kinetics/.*|Eigen/.*|[a-z_]+)");
  int n_files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SOURCE_DIR "/kinetics")) {
    const auto extension = entry.path().extension();
    if (extension != ".h" && extension != ".cc") continue;
    ++n_files;
    std::ifstream file(entry.path());
    std::smatch match;
    for (std::string line; std::getline(file, line);)
      if (std::regex_search(line, match, include)) {
        EXPECT_TRUE(std::regex_match(match[2].str(), allowed)) << entry.path() << ": " << line;
        EXPECT_NE(match[2].str(), "fstream") << entry.path() << " meets a file";
      }
  }
  EXPECT_GT(n_files, 10) << "the folder was not found";
}
