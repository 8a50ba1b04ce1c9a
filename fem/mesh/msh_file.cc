#include "fem/mesh/msh_file.h"

#include <cmath>
#include <cstdlib>

#include "fem/values/errors.h"

namespace fem {

namespace {

int nodes_of_type(int type) {
  switch (type) {
    case 15:
      return 1;
    case 1:
      return 2;
    case 2:
    case 8:
      return 3;
    case 3:
    case 4:
      return 4;
    case 5:
    case 10:
      return type == 5 ? 8 : 9;
    case 6:
    case 9:
      return 6;
    case 7:
      return 5;
    case 11:
      return 10;
    case 12:
      return 27;
    case 16:
      return 8;
    case 17:
      return 20;
    default:
      return 0;
  }
}

/// Numbers of one section, one after the other.
class Section {
public:
  Section(const std::string& text, const std::string& name, const std::string& file)
      : name_(name), file_(file) {
    const auto begin = text.find("$" + name), end = text.find("$End" + name);
    if (begin == std::string::npos) throw MeshUnusable("the mesh file " + file + " has no section $" + name);
    if (end == std::string::npos || end < begin)
      throw MeshUnusable("the mesh file " + file + " is cut off: it has no $End" + name);
    at_ = text.c_str() + begin + name.size() + 1;
    end_ = text.c_str() + end;
  }
  double number() {
    char* after = nullptr;
    const double value = std::strtod(at_, &after);
    check(after);
    return value;
  }
  double finite() {
    const double value = number();
    if (!std::isfinite(value)) fail();
    return value;
  }
  std::int64_t integer() {
    char* after = nullptr;
    const long long value = std::strtoll(at_, &after, 10);
    check(after);
    return value;
  }
  /// A count of things that take at least a byte each.
  std::size_t count() {
    const auto value = integer();
    if (value < 0 || value > end_ - at_) fail();
    return static_cast<std::size_t>(value);
  }
  /// Bytes that are not read yet.
  std::size_t n_left() const { return std::size_t(end_ - at_); }
  void skip(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) number();
  }
  [[noreturn]] void fail() const {
    throw MeshUnusable("the mesh file " + file_ + ": the section $" + name_ +
                       " is damaged: write the mesh again");
  }

private:
  void check(const char* after) {
    if (after == at_ || after > end_) fail();
    at_ = after;
  }
  const char *at_ = nullptr, *end_ = nullptr;
  std::string name_, file_;
};

void refuse_other_versions(const std::string& text, const std::string& name) {
  Section format(text, "MeshFormat", name);
  const double version = format.number();
  const auto binary = format.integer();
  if (version != 4.1 || binary != 0)
    throw MeshUnusable("the mesh file " + name +
                       " must be .msh of version 4.1 in text form; convert it with gmsh -save "
                       "-format msh41");
}

void read_groups(const std::string& text, const std::string& name, MshFile& mesh) {
  Section in(text, "Entities", name);
  std::size_t counts[4];
  for (auto& count : counts) count = in.count();
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::size_t i = 0; i < counts[dimension]; ++i) {
      const auto entity = static_cast<int>(in.integer());
      in.skip(dimension == 0 ? 3 : 6);
      const std::size_t n_groups = in.count();
      for (std::size_t g = 0; g < n_groups; ++g) {
        const auto group = static_cast<int>(std::llabs(in.integer()));
        if (!mesh.group.emplace(std::pair(dimension, entity), group).second && dimension >= 2)
          throw MeshUnusable("the mesh file " + name + ": " + (dimension == 2 ? "surface " : "volume ") +
                             std::to_string(entity) + " is in several physical groups; give it one");
      }
      if (dimension > 0) in.skip(in.count());
    }
}

void read_nodes(const std::string& text, const std::string& name, MshFile& mesh) {
  Section in(text, "Nodes", name);
  const std::size_t n_blocks = in.count(), n_nodes = in.count();
  in.skip(2);
  mesh.xyz_m.reserve(3 * n_nodes);
  for (std::size_t b = 0; b < n_blocks; ++b) {
    const auto dimension = in.integer();
    in.integer();
    const bool parametric = in.integer() != 0;
    const std::size_t n = in.count();
    const std::size_t first = mesh.xyz_m.size() / 3;
    for (std::size_t i = 0; i < n; ++i) mesh.place_of_node.emplace(in.integer(), first + i);
    for (std::size_t i = 0; i < n; ++i) {
      for (int d = 0; d < 3; ++d) mesh.xyz_m.push_back(in.finite());
      if (parametric) in.skip(static_cast<std::size_t>(dimension));
    }
  }
  if (mesh.place_of_node.size() != n_nodes || mesh.xyz_m.size() != 3 * n_nodes) in.fail();
}

MshFile::Elements read_block(Section& in, const std::string& name) {
  MshFile::Elements block;
  block.dimension = static_cast<int>(in.integer());
  block.entity = static_cast<int>(in.integer());
  block.type = static_cast<int>(in.integer());
  block.nodes_per_element = nodes_of_type(block.type);
  if (block.nodes_per_element == 0)
    throw MeshUnusable("the mesh file " + name + " has elements of gmsh's type " +
                       std::to_string(block.type) +
                       ": linear hexahedra or tetrahedra of 10 nodes are expected");
  const std::size_t n = in.count();
  if (n > in.n_left() / std::size_t(block.nodes_per_element)) in.fail();
  block.nodes.reserve(n * block.nodes_per_element);
  for (std::size_t e = 0; e < n; ++e) {
    in.integer();
    for (int i = 0; i < block.nodes_per_element; ++i) block.nodes.push_back(in.integer());
  }
  return block;
}

}  // namespace

MshFile parse_msh(const std::string& text, const std::string& name) {
  refuse_other_versions(text, name);
  MshFile mesh;
  read_groups(text, name, mesh);
  read_nodes(text, name, mesh);
  Section in(text, "Elements", name);
  const std::size_t n_blocks = in.count();
  in.skip(3);
  for (std::size_t b = 0; b < n_blocks; ++b) mesh.elements.push_back(read_block(in, name));
  for (const auto& block : mesh.elements)
    for (const auto node : block.nodes)
      if (mesh.place_of_node.count(node) == 0)
        throw MeshUnusable("the mesh file " + name + ": an element has the node " + std::to_string(node) +
                           ", which the file does not have");
  return mesh;
}

std::vector<int> element_types(const std::string& text) {
  std::vector<int> types;
  try {
    refuse_other_versions(text, "");
    Section in(text, "Elements", "");
    const std::size_t n_blocks = in.count();
    in.skip(3);
    for (std::size_t b = 0; b < n_blocks; ++b) types.push_back(read_block(in, "").type);
  } catch (const MeshUnusable&) {  // whoever reads the file will say what is wrong
  }
  return types;
}

}  // namespace fem
