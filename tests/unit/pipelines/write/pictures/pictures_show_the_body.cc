#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <cstdlib>

#include "pipelines/write/drawing/cut_surface.h"
#include "pipelines/write/drawing/picture_surface.h"
#include "pipelines/write/exports/vtk_files.h"
#include "pipelines/write/pictures/picture.h"
#include "tests/unit/pipelines/examples/results_bar.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::Directory;

namespace {

/// A round bar along z, 1 m long; the field has its peak, 200, on the surface at z = 0.3.
void write_bar(const std::filesystem::path& path) {
  const auto disc = [](results_test::Point p) -> results_test::Point {
    const double u = 2 * p[0] - 1, v = 2 * p[1] - 1;
    return {0.1 * u * std::sqrt(1 - v * v / 2), 0.1 * v * std::sqrt(1 - u * u / 2), p[2]};
  };
  const auto nodes = results_test::mapped_cube(2, 2, 10, disc);
  std::vector<double> stress(nodes.n);
  for (std::size_t i = 0; i < nodes.n; ++i)
    stress[i] = 2e9 * nodes.xyz_m[3 * i] * std::exp(-50 * std::pow(nodes.xyz_m[3 * i + 2] - 0.3, 2));
  write_envelope_vtu(path, nodes, {nodal_field("stress [Pa]", stress)});
}

struct Pixels {
  vtkNew<vtkPNGReader> reader;
  explicit Pixels(const std::filesystem::path& path) {
    reader->SetFileName(path.c_str());
    reader->Update();
  }
  /// Share of the pixels of the rectangle (shares of the picture, from below) that have the property.
  template <class Property>
  double share(double left, double bottom, double right, double top, Property property) const {
    auto* image = reader->GetOutput();
    const int* size = image->GetDimensions();
    int n = 0, n_all = 0;
    for (int y = int(bottom * size[1]); y < int(top * size[1]); ++y)
      for (int x = int(left * size[0]); x < int(right * size[0]); ++x, ++n_all) {
        const auto* rgb = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
        n += property(rgb[0], rgb[1], rgb[2]);
      }
    return double(n) / n_all;
  }
};

bool white(int r, int g, int b) {
  return r > 250 && g > 250 && b > 250;
}
bool dark(int r, int g, int b) {
  return r < 80 && g < 80 && b < 80;
}
/// The dark end of the colours.
bool largest(int r, int g, int b) {
  return r > 60 && g < 60 && b < 70 && r > 2 * g;
}
bool blue(int r, int g, int b) {
  return r < 60 && g < 140 && b > 130;
}

TEST(Picture, ShowsTheBodyThePeakAndTheScale) {
  const Directory at;
  write_bar(at / "bar.vtu");
  PictureOptions options;
  options.scale = 1e-6;
  ASSERT_TRUE(write_picture(at / "bar.vtu", "stress [Pa]", "A bar", "MPa", at / "bar.png", options))
      << "no EGL: pipelines/setup installs it";
  const Pixels picture(at / "bar.png");
  EXPECT_EQ(picture.reader->GetOutput()->GetDimensions()[0], options.width);
  EXPECT_EQ(picture.reader->GetOutput()->GetDimensions()[1], options.height);
  EXPECT_GT(picture.share(0, 0.93, 1, 1, white), 0.9);  // the heading: dark words on white
  EXPECT_GT(picture.share(0, 0.93, 0.3, 1, dark), 0.005);
  const double body =
      1 - picture.share(0, 0.48, 1, 0.93, white);  // the whole body, neither lost nor too near
  EXPECT_GT(body, 0.15);
  EXPECT_LT(body, 0.8);
  EXPECT_GT(picture.share(0.3, 0.2, 0.45, 0.3, largest), 0.5);  // the peak is in the middle of the detail
  EXPECT_GT(picture.share(0.74, 0.02, 0.8, 0.4, [](int r, int g, int b) { return !white(r, g, b); }), 0.1);
}

// A place that governs without being the field's peak (a weld toe) is what the picture looks at and rings.
TEST(Picture, LooksAtThePlaceThatIsMarked) {
  const Directory at;
  write_bar(at / "bar.vtu");
  PictureOptions options;
  options.scale = 1e-6;
  options.mark = PictureMark{{0.1, 0, 0.85}, "hot-spot stress 250 MPa\nthe toe"};
  ASSERT_TRUE(write_picture(at / "bar.vtu", "stress [Pa]", "A bar", "MPa", at / "bar.png", options));
  const Pixels picture(at / "bar.png");
  EXPECT_LT(picture.share(0.3, 0.2, 0.45, 0.3, largest), 0.01);  // nothing of the peak in the detail's middle
  // Seen from x > 0 with y up: z = 0.85 of the bar from the right.
  EXPECT_GT(picture.share(0, 0.48, 0.4, 0.93, blue), 0);
  EXPECT_EQ(picture.share(0.5, 0.48, 1, 0.93, blue), 0)
      << "the field's own largest is ringed in another colour";
}

// Notes stand in white boxes beside their places, in both parts of the picture.
TEST(Picture, WritesNotesBesideTheirPlaces) {
  const Directory at;
  write_bar(at / "bar.vtu");
  PictureOptions options;
  options.scale = 1e-6;
  const auto draw = [&](const char* name) {
    return write_picture(at / "bar.vtu", "stress [Pa]", "A bar", "MPa", at / name, options);
  };
  ASSERT_TRUE(draw("plain.png"));
  options.notes = {{{0.1, 0, 0.85}, "8.3 h"}};
  options.notes_are = "lives";
  ASSERT_TRUE(draw("noted.png"));
  const Pixels plain(at / "plain.png"), noted(at / "noted.png");
  const auto gain = [&](double left, double right) {  // in the upper half, where the whole body is
    return noted.share(left, 0.48, right, 0.93, dark) - plain.share(left, 0.48, right, 0.93, dark);
  };
  EXPECT_GT(gain(0, 0.4), 1e-4) << "z = 0.85 of the bar from the right";
  EXPECT_EQ(gain(0.5, 1), 0);
}

TEST(Picture, TellsWhatIsMissing) {
  const Directory at;
  write_bar(at / "bar.vtu");
  const auto message = [&](const char* vtu, const char* field) -> std::string {
    try {
      return write_picture(at / vtu, field, "", "", at / "bar.png") ? "drawn" : "no EGL";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  ASSERT_EQ(message("bar.vtu", "stress [Pa]"), "drawn") << "pipelines/setup installs EGL";
  EXPECT_NE(message("bar.vtu", "strain").find("\"strain\""), std::string::npos);
  EXPECT_NE(message("none.vtu", "strain").find("none.vtu"), std::string::npos);
}

TEST(PictureDeathTest, WithoutEglNothingIsDrawnAndNothingEnds) {
  const Directory at;
  write_bar(at / "bar.vtu");
  testing::FLAGS_gtest_death_test_style = "threadsafe";  // a fresh process: EGL is found once per process
  EXPECT_EXIT(
      {
        setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere", 1);
        unsetenv("DISPLAY");
        std::exit(write_picture(at / "bar.vtu", "stress [Pa]", "", "", at / "bar.png") ? 1 : 0);
      },
      testing::ExitedWithCode(0), "");
  EXPECT_FALSE(std::filesystem::exists(at / "bar.png"));
}

// VTK's own filters find the faces of quadratic tetrahedra, and keep them curved.
TEST(Picture, ShowsQuadraticTetrahedra) {
  const Directory at;
  const auto nodes = results_test::mapped_tetrahedra([](results_test::Point p) -> results_test::Point {
    return {p[0] + 0.2 * p[1] * p[1], p[1], p[2] + 0.1 * p[0] * p[1]};
  });
  std::vector<double> value(nodes.n, 1);
  value[26] = 7;
  write_envelope_vtu(at / "t.vtu", nodes, {nodal_field("value", value)});
  const auto faces = boundary_faces(at / "t.vtu", "value", 2, "");
  ASSERT_EQ(faces->GetNumberOfCells(), 12);
  for (vtkIdType f = 0; f < 12; ++f) EXPECT_EQ(faces->GetCellType(f), VTK_QUADRATIC_TRIANGLE);
  EXPECT_EQ(peak_of(faces.get(), smooth_surface(faces.get(), 1).get()).value, 14);
}

// The bar's peak is on the side of +x at z = 0.3: with z < 0.45 left out the largest is at the next nodes, z
// = 0.45.
TEST(Picture, TakesNoPeakWhereTheFieldIsExcluded) {
  const Directory at;
  const auto nodes = results_test::mapped_cube(2, 2, 10, [](results_test::Point p) -> results_test::Point {
    return {0.1 * p[0], 0.1 * p[1], p[2]};
  });
  std::vector<double> value(nodes.n), excluded(nodes.n);
  for (std::size_t i = 0; i < nodes.n; ++i) {
    value[i] = nodes.xyz_m[3 * i] * std::exp(-50 * std::pow(nodes.xyz_m[3 * i + 2] - 0.3, 2));
    excluded[i] = nodes.xyz_m[3 * i + 2] < 0.44;
  }
  write_envelope_vtu(at / "b.vtu", nodes, {nodal_field("value", value), nodal_field("left out", excluded)});
  const auto peak = [&](const char* field) {
    const auto faces = boundary_faces(at / "b.vtu", "value", 1, field);
    return peak_of(faces.get(), smooth_surface(faces.get(), 1).get());
  };
  EXPECT_NEAR(peak("").at[2], 0.3, 1e-7);  // the filters work in single precision
  EXPECT_NEAR(peak("left out").at[2], 0.45, 1e-7);
}

// Shafts and chambers stand as the machine does: y is up in every view, from whatever side a place is seen.
TEST(Picture, HasYUp) {
  for (const std::array<double, 6>& bounds :
       {std::array<double, 6>{-0.1, 0.1, -0.1, 0.1, 0, 1}, {-1, 1, -1, 1, -1, 1}})
    for (const Vector& normal :
         {Vector{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0.1, -0.7, 0.7}}) {
      const auto view = views_of(bounds.data(), normal).front();
      EXPECT_GT(view.axes()[1][1], 0.4);
      EXPECT_EQ(view.axes()[0][1], 0) << "level";
      if (normal[2] == 0) {
        EXPECT_GT(view.axes()[2][0] * normal[0] + view.axes()[2][1] * normal[1], 0.3) << "it faces the eye";
      }
    }
}

// A pipe, 1 m long, with a slit: outside it is looked at as it is, inside only cut open, beyond the axis from
// the place.
TEST(Picture, CutsOpenWhatHidesAPlace) {
  const Directory at;
  const auto pipe = [](results_test::Point p) -> results_test::Point {
    const double angle = 6.2 * (1 - p[0]), r = 0.1 + 0.05 * p[1];
    return {r * std::cos(angle), r * std::sin(angle), p[2]};
  };
  const auto nodes = results_test::mapped_cube(12, 1, 4, pipe);
  write_envelope_vtu(at / "p.vtu", nodes, {nodal_field("value", std::vector<double>(nodes.n, 1))});
  const auto faces = boundary_faces(at / "p.vtu", "value", 1, "");
  const auto surface = smooth_surface(faces.get(), 2);
  const auto outside = view_of_place(surface.get(), {-0.15, 0, 0.5}, {-1, 0, 0});
  EXPECT_FALSE(outside.cut);
  EXPECT_LT(outside.view.towards_eye[0], -0.5);
  const auto inside = view_of_place(surface.get(), {-0.1, 0, 0.5}, {1, 0, 0});
  ASSERT_TRUE(inside.cut);
  EXPECT_EQ(inside.cut->normal, (Vector{1, 0, 0}));
  EXPECT_GT(inside.cut->point[0], -0.05);
  EXPECT_LT(inside.cut->point[0], 0.05);
  EXPECT_LT(clipped(surface.get(), *inside.cut)->GetBounds()[1], 0.05);
  EXPECT_GT(section(faces.get(), 2, *inside.cut)->GetNumberOfCells(), 0);
}

}  // namespace
