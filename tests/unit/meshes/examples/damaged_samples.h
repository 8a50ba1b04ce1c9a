/// A part as STEP file and as meshes, and damage to them by chance, for tests of imports.
#pragma once

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <random>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace damaged {

/// The files that write_samples leaves, in the order that they are damaged in.
inline const std::array<std::string, 4> samples = {"sound.step", "sound.msh", "sound.step", "sound_2.msh"};

/// A block of 30 x 30 x 20 mm with a hole of 10 along z in its middle, in millimetres, as CAD and as meshes
/// of two versions. Starts and ends gmsh.
inline void write_samples(const std::filesystem::path& directory) {
  namespace occ = gmsh::model::occ;
  gmsh::initialize();
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::vectorpair parts;
  std::vector<gmsh::vectorpair> map;
  occ::cut({{3, occ::addBox(0, 0, 0, 30, 30, 20)}}, {{3, occ::addCylinder(15, 15, -1, 0, 0, 22, 5)}}, parts,
           map);
  occ::synchronize();
  gmsh::write((directory / "sound.step").string());
  gmsh::option::setNumber("Mesh.MeshSizeMax", 12);
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 6);
  gmsh::model::mesh::generate(3);
  for (const double version : {4.1, 2.2}) {
    gmsh::option::setNumber("Mesh.MshFileVersion", version);
    gmsh::write((directory / (version > 4 ? "sound.msh" : "sound_2.msh")).string());
  }
  gmsh::finalize();
}

class Mutator {
public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  /// One damage, of a kind that editors, disks, mail and exporters do; its name stands in `what`.
  std::string damage(std::string text, bool is_step, std::string& what) {
    auto lines = lines_of(text);
    const std::size_t a = below(lines.size()), b = below(lines.size());
    switch (below(is_step ? 12 : 8)) {
      case 0:
        what = "line missing";
        lines.erase(lines.begin() + long(a));
        break;
      case 1:
        what = "lines swapped";
        std::swap(lines[a], lines[b]);
        break;
      case 2:
        what = "line twice";
        lines.insert(lines.begin() + long(b), lines[a]);
        break;
      case 3:
        what = "cut off";
        return text.substr(0, below(text.size()));
      case 4:
        what = "byte flipped";
        text[below(text.size())] ^= char(1 << below(8));
        return text;
      case 5:
      case 6:
      case 7: {
        what = "number changed";
        static const std::array<const char*, 9> odd = {
            "-1", "0", "2147483648", "-2147483649", "1e308", "1e-300", "nan", "9", "99999999999999999999"};
        return change_number(text, R"([-+]?[0-9][0-9.eE+-]*)", odd[below(odd.size())]);
      }
      default:
        what = "reference changed";
        return change_number(text, "#[0-9]+(?=[,)])", "#" + std::to_string(1 + below(lines.size())));
    }
    std::string joined;
    for (const auto& line : lines) joined += line + "\n";
    return joined;
  }

private:
  std::size_t below(std::size_t n) { return std::size_t(random_() % std::max<std::size_t>(1, n)); }

  static std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }

  std::string change_number(const std::string& text, const std::string& pattern, const std::string& to) {
    const std::regex number(pattern);
    const std::vector<std::smatch> found(std::sregex_iterator(text.begin(), text.end(), number), {});
    const auto& chosen = found[below(found.size())];
    return std::string(text.begin(), chosen[0].first) + to + std::string(chosen[0].second, text.end());
  }

  std::mt19937 random_;
};

/// How many are drawn: as the environment's MILLSTRESS_MUTANTS says.
inline int n_mutants(int usual) {
  const char* const wanted = std::getenv("MILLSTRESS_MUTANTS");
  return wanted == nullptr ? usual : std::atoi(wanted);
}

/// "exit 2 40; hung apart 1"
inline std::string told(const std::map<std::string, int>& count) {
  std::ostringstream text;
  for (const auto& [outcome, n] : count) text << outcome << ' ' << n << "; ";
  return text.str();
}

}  // namespace damaged
