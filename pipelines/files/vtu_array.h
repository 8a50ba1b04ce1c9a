/// Arrays as the appended data of a VTK XML file holds them: encoded once, they serve any number of files,
/// and from any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pipelines {

enum class VtuCompression { none, zlib };

/// How arrays are encoded. The bytes are the same for any number of threads.
struct VtuEncoding {
  VtuCompression compression = VtuCompression::zlib;
  int n_threads = 1;  ///< that compress
};

struct VtuArray {
  std::string element;  ///< of XML, but for its offset: <DataArray type="Float32" Name="f" format="appended"
  std::string data;     ///< with its header
};

/// @param component_names  none, or one each
VtuArray vtu_array(const std::string& name, const std::vector<float>& values, const VtuEncoding& encoding,
                   int n_components = 1, const std::vector<std::string>& component_names = {});
VtuArray vtu_array(const std::string& name, const std::vector<double>& values, const VtuEncoding& encoding,
                   int n_components = 1, const std::vector<std::string>& component_names = {});
VtuArray vtu_array(const std::string& name, const std::vector<std::int32_t>& values,
                   const VtuEncoding& encoding);
VtuArray vtu_array(const std::string& name, const std::vector<std::uint8_t>& values,
                   const VtuEncoding& encoding);

/// Arrays of the whole file, which have a length of their own.
VtuArray vtu_field_array(const std::string& name, const std::vector<double>& values,
                         const VtuEncoding& encoding);
VtuArray vtu_field_array(const std::string& name, const std::vector<std::string>& texts,
                         const VtuEncoding& encoding);

/// A grid in one piece; it looks at arrays that outlive it.
struct VtuGrid {
  std::size_t n_points = 0, n_cells = 0;
  std::vector<const VtuArray*> field_data, point_data, cell_data, points, cells;
  /// Of the file: "2.2" where there are VTK_LAGRANGE_HEXAHEDRON. Readers renumber the nodes on the edges of
  /// those in older files.
  const char* version = "1.0";
};

/// @param compression  of all its arrays
/// @throws FileError naming the file if it cannot be written
void write_vtu(const std::filesystem::path& path, const VtuGrid& grid, VtuCompression compression);

}  // namespace pipelines
