#include "pipelines/write/pictures/port_body.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/write/pictures/port_surface.h"

namespace pipelines {
namespace {

constexpr int subdivisions = 2;  ///< a face is drawn in 16 pieces
constexpr Colour plain_grey{222, 222, 222};

vtkSmartPointer<vtkUnstructuredGrid> read_faces(const std::filesystem::path& vtu) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (!reader->CanReadFile(vtu.c_str())) throw FileError(vtu.string() + ": is no VTU file that can be read");
  reader->SetFileName(vtu.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Colours of the cells from their ports.
template <typename ColourOf>
void add_colours(vtkUnstructuredGrid* faces, vtkDataArray* ports, const char* name, ColourOf&& colour_of) {
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName(name);
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(faces->GetNumberOfCells());
  for (vtkIdType f = 0; f < faces->GetNumberOfCells(); ++f)
    colours->SetTypedTuple(f, colour_of(static_cast<int>(ports->GetComponent(f, 0))).data());
  faces->GetCellData()->AddArray(colours);
}

}  // namespace

Colour port_colour(std::size_t i) {
  // Okabe and Ito (2008), then four of Tol's muted colours; a fifth of a turn apart beyond them.
  constexpr std::array<Colour, 12> known = {{{230, 159, 0},
                                             {0, 114, 178},
                                             {0, 158, 115},
                                             {213, 94, 0},
                                             {86, 180, 233},
                                             {240, 228, 66},
                                             {204, 121, 167},
                                             {51, 34, 136},
                                             {136, 34, 85},
                                             {153, 153, 51},
                                             {17, 119, 51},
                                             {136, 204, 238}}};
  if (i < known.size()) return known[i];
  Colour colour;
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] =
        static_cast<unsigned char>(128 + 100 * std::cos(2 * pi * (0.618034 * double(i) + double(c) / 3)));
  return colour;
}

PortBody read_port_body(const std::filesystem::path& vtu, const std::optional<CutPlane>& cut) {
  const auto faces = read_faces(vtu);
  auto* ports = faces->GetCellData()->GetArray(port_fields::port);
  auto* names =
      vtkStringArray::SafeDownCast(faces->GetFieldData()->GetAbstractArray(port_fields::port_names));
  if (!ports || !names || faces->GetNumberOfCells() == 0)
    throw FileError(vtu.string() + ": has no faces with ports");
  PortBody body;
  for (vtkIdType i = 0; i < names->GetNumberOfValues(); ++i) body.ports.push_back(names->GetValue(i));

  add_colours(faces, ports, port_arrays::colour,
              [](int port) { return port > 0 ? port_colour(std::size_t(port) - 1) : plain_grey; });
  add_colours(faces, ports, port_arrays::id, [](int port) {
    return Colour{static_cast<unsigned char>(port / 256), 1, static_cast<unsigned char>(port % 256)};
  });
  body.whole = {smooth_surface(faces, subdivisions), curved_edges(faces, 1 << subdivisions)};
  if (!cut) return body;

  body.half = {clipped(body.whole.surface.get(), *cut), clipped(body.whole.edges.get(), *cut)};
  body.face = section(faces, subdivisions, *cut);
  return body;
}

}  // namespace pipelines
