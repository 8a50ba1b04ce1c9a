#include "tests/verification/calculix/calculix_results.h"

#include <cstdlib>
#include <fstream>
#include <string>

#include "pipelines/base/common/errors.h"

namespace pipelines {
namespace {

/// Reads blocks of values: a line " -4  NAME", one per component " -5", per node " -1", number in ten columns
/// and values in twelve each, which may touch; " -3" ends the block.
class FrdReader {
public:
  explicit FrdReader(const std::filesystem::path& file) : file_(file), in_(file) {
    if (!in_) fail("cannot be opened: did CalculiX run?");
  }

  /// Whether there is another line.
  bool next() {
    constexpr std::streamsize longest = 1000;  // lines of CalculiX have 85 characters
    char line[longest];
    if (!in_.getline(line, longest)) {
      if (in_.gcount() == longest - 1) fail("the line after is too long; write the .frd as text");
      return false;
    }
    line_ = line;
    ++n_lines_;
    return true;
  }
  bool begins(const std::string& text) const { return line_.rfind(text, 0) == 0; }

  /// The rest of a block, appended to `values` as n_nodes x width.
  void block(std::size_t n_nodes, std::size_t width, std::vector<double>& values) {
    const std::size_t at = values.size();
    values.resize(at + n_nodes * width, 0.0);
    while (next()) {
      if (begins(" -3")) return;
      if (begins(" -5")) continue;
      if (!begins(" -1") || line_.size() < 13 + 12 * width) fail("no row of a node; write the .frd as text");
      const long node = std::strtol(line_.substr(3, 10).c_str(), nullptr, 10);
      if (node < 1 || std::size_t(node) > n_nodes)
        fail("node " + std::to_string(node) + " is none of the mesh");
      for (std::size_t c = 0; c < width; ++c) {
        const std::string field = line_.substr(13 + 12 * c, 12);
        char* end = nullptr;
        values[at + (std::size_t(node) - 1) * width + c] = std::strtod(field.c_str(), &end);
        if (end == field.c_str()) fail("no number: " + field);
      }
    }
    fail("breaks off: did CalculiX come to its end?");
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw FileError(file_.string() + ":" + std::to_string(n_lines_) + ": " + what);
  }

private:
  std::filesystem::path file_;
  std::ifstream in_;
  std::string line_;
  std::size_t n_lines_ = 0;
};

}  // namespace

CalculixResults read_calculix_results(const std::filesystem::path& frd, std::size_t n_nodes) {
  CalculixResults results;
  FrdReader file(frd);
  std::size_t n_displacements = 0, n_stresses = 0;
  while (file.next()) {
    if (file.begins(" -4  DISP")) {
      ++n_displacements;
      file.block(n_nodes, 3, results.displacement_m);
    } else if (file.begins(" -4  STRESS")) {
      ++n_stresses;
      file.block(n_nodes, 6, results.stress_Pa);
    }
  }
  if (n_displacements != n_stresses || n_displacements == 0)
    file.fail(std::to_string(n_displacements) + " steps with displacements, " + std::to_string(n_stresses) +
              " with stresses: every step has to have both");
  results.n_steps = n_displacements;
  return results;
}

}  // namespace pipelines
