/// The contents of a .msh 4.1 file in text form, as far as a body needs them. Internal to fem.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace fem {

struct MshFile {
  /// Elements of one entity and type, as gmsh numbers types: 4 and 11 are tetrahedra of 4 and 10 nodes, 5 the
  /// hexahedron of 8, 2 and 9 triangles of 3 and 6.
  struct Elements {
    int dimension = 0, entity = 0, type = 0;
    int nodes_per_element = 0;
    std::vector<std::int64_t> nodes;  ///< tags, element after element
  };
  std::map<std::int64_t, std::size_t> place_of_node;  ///< by tag
  std::vector<double> xyz_m;                          ///< place x 3
  std::map<std::pair<int, int>, int> group;           ///< physical group by dimension and entity
  std::vector<Elements> elements;
};

/// @param text  of the file
/// @param name  of the file, for messages
/// @throws MeshUnusable if the text is cut off, binary, of another version, or does not fit together
MshFile parse_msh(const std::string& text, const std::string& name);

/// Types of the elements in the text, as far as it can be read; none if it is no .msh 4.1 text.
std::vector<int> element_types(const std::string& text);

}  // namespace fem
