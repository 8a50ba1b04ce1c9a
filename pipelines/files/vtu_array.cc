#include "pipelines/files/vtu_array.h"

#include <vtkNew.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "pipelines/common/errors.h"
#include "pipelines/common/parallel.h"
#include "pipelines/files/atomic_file.h"
#include "pipelines/files/markup.h"

namespace pipelines {
namespace {

constexpr std::size_t block_size = 32768;  // bytes that are compressed together, as VTK's own writer does

void append_number(std::string& data, std::uint64_t value) {
  data.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Level 1 takes half the time of the default for one percent more bytes.
std::string compressed(const unsigned char* bytes, std::size_t n) {
  vtkNew<vtkZLibDataCompressor> compressor;
  compressor->SetCompressionLevel(1);
  std::string result(compressor->GetMaximumCompressionSpace(n), '\0');
  const auto size =
      compressor->Compress(bytes, n, reinterpret_cast<unsigned char*>(result.data()), result.size());
  if (size == 0) throw std::runtime_error("a block of a VTK file cannot be compressed");
  result.resize(size);
  return result;
}

/// Behind the number of bytes; compressed, behind the number of blocks, their size, that of the last one if
/// it is shorter, and the compressed sizes.
std::string encoded(const void* values, std::size_t n_bytes, const VtuEncoding& encoding) {
  const auto* bytes = static_cast<const unsigned char*>(values);
  std::string data;
  if (encoding.compression == VtuCompression::none) {
    append_number(data, n_bytes);
    return n_bytes > 0 ? data.append(static_cast<const char*>(values), n_bytes) : data;
  }
  std::vector<std::string> blocks((n_bytes + block_size - 1) / block_size);
  for_each_parallel(blocks.size(), encoding.n_threads, [&](std::size_t, std::size_t i) {
    blocks[i] = compressed(bytes + i * block_size, std::min(block_size, n_bytes - i * block_size));
  });
  append_number(data, blocks.size());
  append_number(data, block_size);
  append_number(data, n_bytes % block_size);
  for (const auto& block : blocks) append_number(data, block.size());
  for (const auto& block : blocks) data += block;
  return data;
}

std::string attribute(const std::string& name, const std::string& value) {
  return ' ' + name + "=\"" + escaped(value) + '"';
}

template <class Number>
VtuArray array_of(const char* type, const std::string& name, const std::vector<Number>& values,
                  const VtuEncoding& encoding, const std::string& more = {}) {
  return {"<DataArray" + attribute("type", type) + attribute("Name", name) + more +
              attribute("format", "appended"),
          encoded(values.data(), values.size() * sizeof(Number), encoding)};
}

std::string components(int n, const std::vector<std::string>& names) {
  std::string text = n == 1 ? "" : attribute("NumberOfComponents", std::to_string(n));
  for (std::size_t c = 0; c < names.size(); ++c)
    text += attribute("ComponentName" + std::to_string(c), names[c]);
  return text;
}

std::string number_of_tuples(std::size_t n) {
  return attribute("NumberOfTuples", std::to_string(n));
}

/// Elements with their offsets, and the data that these lead to.
class AppendedData {
public:
  std::string elements(const std::string& indent, const std::vector<const VtuArray*>& arrays) {
    std::string text;
    for (const auto* array : arrays) {
      text += indent + array->element + attribute("offset", std::to_string(size_)) + "/>\n";
      arrays_.push_back(array);
      size_ += array->data.size();
    }
    return text;
  }
  void write(std::ostream& out) const {
    for (const auto* array : arrays_) out.write(array->data.data(), std::streamsize(array->data.size()));
  }

private:
  std::vector<const VtuArray*> arrays_;
  std::size_t size_ = 0;
};

std::string section(const std::string& indent, const std::string& name, const std::string& elements) {
  return indent + '<' + name + ">\n" + elements + indent + "</" + name + ">\n";
}

}  // namespace

VtuArray vtu_array(const std::string& name, const std::vector<float>& values, const VtuEncoding& encoding,
                   int n_components, const std::vector<std::string>& component_names) {
  return array_of("Float32", name, values, encoding, components(n_components, component_names));
}

VtuArray vtu_array(const std::string& name, const std::vector<double>& values, const VtuEncoding& encoding,
                   int n_components, const std::vector<std::string>& component_names) {
  return array_of("Float64", name, values, encoding, components(n_components, component_names));
}

VtuArray vtu_array(const std::string& name, const std::vector<std::int32_t>& values,
                   const VtuEncoding& encoding) {
  return array_of("Int32", name, values, encoding);
}

VtuArray vtu_array(const std::string& name, const std::vector<std::uint8_t>& values,
                   const VtuEncoding& encoding) {
  return array_of("UInt8", name, values, encoding);
}

VtuArray vtu_field_array(const std::string& name, const std::vector<double>& values,
                         const VtuEncoding& encoding) {
  return array_of("Float64", name, values, encoding, number_of_tuples(values.size()));
}

VtuArray vtu_field_array(const std::string& name, const std::vector<std::string>& texts,
                         const VtuEncoding& encoding) {
  std::string ended;  // each by a zero
  for (const auto& text : texts) ended.append(text.c_str(), text.size() + 1);
  return {"<Array" + attribute("type", "String") + attribute("Name", name) + number_of_tuples(texts.size()) +
              attribute("format", "appended"),
          encoded(ended.data(), ended.size(), encoding)};
}

void write_vtu(const std::filesystem::path& path, const VtuGrid& grid, VtuCompression compression) {
  AppendedData data;
  const std::string inner = "        ", outer = "      ";
  const std::string field_data =
      grid.field_data.empty() ? "" : section("    ", "FieldData", data.elements(outer, grid.field_data));
  std::string arrays = section(outer, "PointData", data.elements(inner, grid.point_data));
  arrays += section(outer, "CellData", data.elements(inner, grid.cell_data));
  arrays += section(outer, "Points", data.elements(inner, grid.points));
  arrays += section(outer, "Cells", data.elements(inner, grid.cells));

  AtomicFile file(path);
  std::ofstream out(file.temporary(), std::ios::binary);
  out << "<VTKFile type=\"UnstructuredGrid\"" << attribute("version", grid.version)
      << " byte_order=\"LittleEndian\" header_type=\"UInt64\""
      << (compression == VtuCompression::zlib ? " compressor=\"vtkZLibDataCompressor\"" : "")
      << ">\n  <UnstructuredGrid>\n"
      << field_data << "    <Piece" << attribute("NumberOfPoints", std::to_string(grid.n_points))
      << attribute("NumberOfCells", std::to_string(grid.n_cells)) << ">\n"
      << arrays << "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n   _";
  data.write(out);
  out << "\n  </AppendedData>\n</VTKFile>\n";
  out.close();
  if (!out) throw FileError(path.string() + ": cannot be written; check the directory and the free space");
  file.commit("</VTKFile>\n");
}

}  // namespace pipelines
