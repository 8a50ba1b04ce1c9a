// The tutorial of pipelines/README.md: its commands print what the page says.
#include "tests/cases/program/program.h"

#include <cmath>
#include <fstream>
#include <sstream>

using namespace cases;

namespace {

struct Question {
  std::string command;
  std::vector<std::string> printed;
};

/// The indented blocks of the section that begin with a command.
std::vector<Question> questions() {
  std::ifstream page(fs::path(SOURCE_DIR) / "pipelines/README.md");
  std::vector<Question> all;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("#", 0) == 0) inside = line == "### Five questions";
    if (!inside || line.rfind("    ", 0) != 0) continue;
    const auto text = line.substr(4);
    if (text.rfind("build/millstress ", 0) == 0)
      all.push_back({text.substr(std::string("build/millstress ").size()), {}});
    else if (!all.empty() && !all.back().command.empty() && all.back().command.back() == '\\')
      all.back().command = all.back().command.substr(0, all.back().command.size() - 1) + text;
    else
      all.back().printed.push_back(text);
  }
  return all;
}

std::vector<std::string> words(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), {}};
}

/// Word by word; numbers to 1e-4, since another instruction set rounds the six digits otherwise.
void expect_same_line(const std::string& found, const std::string& wanted) {
  const auto a = words(found), b = words(wanted);
  ASSERT_EQ(a.size(), b.size()) << found;
  for (std::size_t i = 0; i < a.size(); ++i) {
    char *end_a = nullptr, *end_b = nullptr;
    const double x = std::strtod(a[i].c_str(), &end_a), y = std::strtod(b[i].c_str(), &end_b);
    if (*end_a == 0 && *end_b == 0)
      EXPECT_NEAR(x, y, 1e-4 * std::abs(y)) << found;
    else
      EXPECT_EQ(a[i], b[i]) << found;
  }
}

}  // namespace

TEST(Tutorial, PrintsWhatThePageSays) {
  const auto all = questions();
  ASSERT_EQ(all.size(), 5u);
  const results_test::Directory directory;
  fs::create_directories(directory / "pipelines");
  fs::copy(fs::path(SOURCE_DIR) / "pipelines/scenes", directory / "pipelines/scenes",
           fs::copy_options::recursive);
  for (const auto& question : all) {
    const auto outcome = as_a_user(directory.path, question.command + " -q --threads 2");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::istringstream out(outcome.out);
    std::vector<std::string> lines;
    for (std::string line; std::getline(out, line);)
      if (!line.empty()) lines.push_back(line);
    ASSERT_GE(lines.size(), question.printed.size());
    for (std::size_t i = 0; i < question.printed.size(); ++i) expect_same_line(lines[i], question.printed[i]);
  }
}
