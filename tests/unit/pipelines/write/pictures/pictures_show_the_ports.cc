#include <gtest/gtest.h>
#include <vtkBiQuadraticQuad.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "fem/base/values/body_nodes.h"
#include "pipelines/loads/stage/body_mesh.h"
#include "pipelines/scene/whole/scene.h"
#include "pipelines/write/drawing/label_rows.h"
#include "pipelines/write/pictures/port_picture.h"
#include "pipelines/write/pictures/port_surface.h"
#include "pipelines/write/pictures/port_visibility.h"
#include "tests/unit/pipelines/examples/results_bar.h"
#include "tests/unit/pipelines/examples/results_directory.h"

using namespace pipelines;
using results_test::Directory;

namespace {

using Areas = std::map<std::string, double>;

/// Area of the faces of each name in a list, as VTK reads them: 3 x 3 Gauss points on each face.
Areas areas(const std::filesystem::path& vtu, const char* field, const char* list) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(vtu.c_str());
  reader->Update();
  auto* grid = reader->GetOutput();
  auto* ids = grid->GetCellData()->GetArray(field);
  auto* names = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray(list));
  Areas result;
  for (vtkIdType f = 0; f < grid->GetNumberOfCells(); ++f) {
    const int id = int(ids->GetComponent(f, 0));
    auto* face = vtkBiQuadraticQuad::SafeDownCast(grid->GetCell(f));
    double& area = result[id == 0 ? "" : names->GetValue(id - 1)];
    const double g = std::sqrt(0.15), points[3] = {0.5 - g, 0.5, 0.5 + g},
                 weights[3] = {5. / 18, 8. / 18, 5. / 18};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double at[3] = {points[i], points[j], 0};
        double d[18], u[3] = {}, v[3] = {};
        face->InterpolateDerivs(at, d);
        for (vtkIdType n = 0; n < 9; ++n)
          for (int c = 0; c < 3; ++c) {
            u[c] += d[n] * face->GetPoints()->GetPoint(n)[c];
            v[c] += d[9 + n] * face->GetPoints()->GetPoint(n)[c];
          }
        area += weights[i] * weights[j] *
                std::sqrt(std::pow(u[1] * v[2] - u[2] * v[1], 2) + std::pow(u[2] * v[0] - u[0] * v[2], 2) +
                          std::pow(u[0] * v[1] - u[1] * v[0], 2));
      }
  }
  return result;
}

/// Every port of the body has its own area, all faces are there, and every face has a feature.
void expect_areas(const char* scene_name, const char* body_name, const Areas& expected) {
  const Directory at;
  const Scene scene = read_scene(std::filesystem::path(SOURCE_DIR) / "pipelines/scenes" / scene_name);
  const BodyScene& body = *scene.body(body_name);
  const auto mesh = build_mesh(body);
  write_port_surface(at / "ports.vtu", fem::body_nodes(to_fem_body(mesh, body.material)), mesh);
  auto ports = areas(at / "ports.vtu", port_fields::port, port_fields::port_names);
  const auto features = areas(at / "ports.vtu", port_fields::feature, port_fields::feature_names);
  double all = 0, all_features = 0;
  for (const auto& [name, area] : ports) all += area;
  for (const auto& [name, area] : features) all_features += area;
  EXPECT_NEAR(all_features, all, 1e-9 * all);
  EXPECT_EQ(features.count(""), 0u);
  EXPECT_GT(ports[""], 0);
  ports.erase("");
  EXPECT_EQ(ports.size(), expected.size());
  // Quadratic faces over 22.5 degrees are within 1e-4 of a cylinder; another length, radius or group is not.
  for (const auto& [name, area] : expected) EXPECT_NEAR(ports[name], area, 1e-3 * area) << name;
}

double tube(double diameter, double length) {
  return M_PI * diameter * length;
}
double ring(double outer_diameter, double inner_diameter) {
  return M_PI / 4 * (outer_diameter * outer_diameter - inner_diameter * inner_diameter);
}

// Diameters, lengths and fillets are those of the scene files. A fillet lies on the thinner of its
// neighbours; the loaded zone is the length less that fillet at both ends.
TEST(PortSurface, OfTheShaftHasTheAreasOfItsCylinders) {
  expect_areas("vibratory_mill.toml", "shaft",
               {{"end_1", ring(0.025, 0)},
                {"coupling", tube(0.025, 0.043)},
                {"debalance_1", tube(0.03, 0.034)},
                {"main_bearing_1", tube(0.035, 0.021)},
                {"eccentric_seat", tube(0.06, 0.06)},
                {"main_bearing_2", tube(0.035, 0.021)},
                {"debalance_2", tube(0.03, 0.034)},
                {"end_2", ring(0.03, 0)}});
}

TEST(PortSurface, OfTheChamberHasTheAreasOfItsBoresFlangesAndPads) {
  expect_areas("vibratory_mill.toml", "chamber",
               {{"housing_bore", tube(0.095, 0.105)},
                {"inner_wall", tube(0.26, 0.21)},
                {"covers", 2 * ring(0.372, 0.284)},
                {"spring_foot_1", 2 * 0.05 * 0.03},
                {"spring_foot_2", 2 * 0.05 * 0.03}});
}

TEST(PortSurface, OfTheDrumHasTheAreasOfItsTrunnionsAndItsWall) {
  expect_areas("planetary_mill.toml", "drum",
               {{"end_1", ring(0.08, 0.04)},
                {"trunnion_1", tube(0.08, 0.034)},
                {"inner_wall", tube(0.2, 1)},
                {"trunnion_2", tube(0.08, 0.034)},
                {"pulley_seat", tube(0.07, 0.092)},
                {"end_2", ring(0.07, 0.04)}});
}

// Over random requests: in their rows, side by side, in the order of their anchors; leaders of one row do not
// cross.
TEST(LabelRows, OfRandomLabelsDoNotOverlap) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(0, 1000), wide(40, 130);
  for (int n = 0; n < 50; ++n) {
    std::vector<LabelRequest> requests(std::size_t(n % 11));
    for (auto& request : requests) request = {anywhere(random), 200 + 0.1 * anywhere(random), wide(random)};
    const LabelRows rows{0, 1000, 30, 470, 10};
    const auto places = place_labels(requests, rows);
    ASSERT_EQ(places.size(), requests.size());
    for (std::size_t i = 0; i < requests.size(); ++i) {
      EXPECT_GE(places[i].left, -1e-9);
      EXPECT_LE(places[i].left + requests[i].width, 1000 + 1e-9);
      for (std::size_t j = 0; j < requests.size(); ++j)
        if (i != j && places[i].above == places[j].above && requests[i].anchor_x < requests[j].anchor_x) {
          EXPECT_LE(places[i].left + requests[i].width + 10, places[j].left + 1e-9);
        }
    }
  }
  // Alone a label stands over its anchor, in the nearer row.
  const auto alone = place_labels({{300, 100, 80}}, {0, 1000, 30, 470, 10});
  EXPECT_FALSE(alone[0].above);
  EXPECT_EQ(alone[0].left, 260);
}

// A square ring, and a port in two pieces: the place to point at is on the port and not at its edge.
TEST(SeenPorts, ArePointedAtInside) {
  PortPixels pixels{30, 20, std::vector<std::size_t>(600, 0)};
  const auto fill = [&](int x0, int x1, int y0, int y1, std::size_t port) {
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) pixels.port[std::size_t(y) * 30 + std::size_t(x)] = port;
  };
  fill(2, 17, 2, 17, 1);
  fill(7, 12, 7, 12, 0);
  fill(20, 25, 0, 5, 2);
  fill(20, 25, 15, 20, 2);
  const auto seen = seen_ports(pixels, 3);
  EXPECT_EQ(seen[0].n_pixels, 200u);
  EXPECT_EQ(seen[1].n_pixels, 50u);
  EXPECT_EQ(seen[2].n_pixels, 0u);
  for (int p : {0, 1})
    for (int step : {-1, 0, 1}) {
      EXPECT_EQ(pixels.port[std::size_t(seen[p].y * 30 + seen[p].x + step)], p + 1u) << p;
      EXPECT_EQ(pixels.port[std::size_t((seen[p].y + step) * 30 + seen[p].x)], p + 1u) << p;
    }
}

/// A round bar along z, 1 m long, with ports on its mantle (ids 0 to 3 are its quarters) and at both ends.
meshes::BodyMesh write_bar_with_ports(const std::filesystem::path& vtu) {
  const auto nodes = results_test::mapped_cube(2, 2, 10, [](results_test::Point p) -> results_test::Point {
    const double u = 2 * p[0] - 1, v = 2 * p[1] - 1;
    return {0.1 * u * std::sqrt(1 - v * v / 2), 0.1 * v * std::sqrt(1 - u * u / 2), p[2]};
  });
  using Kind = meshes::Port::Kind;
  meshes::BodyMesh mesh;
  mesh.ports = {{"near", Kind::face, 0, 0, 1, 0, 0, 0},
                {"upper", Kind::face, 3, 0, 1, 0, 0, 0},
                {"left_end", Kind::face, 4, 0, 0, 0.1, 0, 0},
                {"right_end", Kind::face, 5, 1, 1, 0.1, 0, 0}};
  write_port_surface(vtu, nodes, mesh);
  return mesh;
}

/// Share of the picture's pixels in a colour, whatever its brightness; of swatches and shaded surfaces alike.
double share_of(const std::filesystem::path& png, const Colour& colour) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(png.c_str());
  reader->Update();
  auto* image = reader->GetOutput();
  const int* size = image->GetDimensions();
  const double length = std::sqrt(colour[0] * colour[0] + colour[1] * colour[1] + colour[2] * colour[2]);
  int n = 0;
  for (int y = 0; y < size[1]; ++y)
    for (int x = 0; x < size[0]; ++x) {
      const auto* rgb = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      const double product = rgb[0] * colour[0] + rgb[1] * colour[1] + rgb[2] * colour[2],
                   own = std::sqrt(rgb[0] * rgb[0] + rgb[1] * rgb[1] + rgb[2] * rgb[2]);
      n += own > 0.3 * length && product > 0.998 * length * own;
    }
  return double(n) / (double(size[0]) * size[1]);
}

TEST(PortPicture, ShowsEachPortInItsColour) {
  const Directory at;
  write_bar_with_ports(at / "ports.vtu");
  ASSERT_TRUE(write_port_picture(at / "ports.vtu", "A bar", at / "ports.png"))
      << "no EGL: pipelines/setup installs it";
  // Far more than a label's swatch, which has 16 x 16 pixels: 2e-4.
  for (std::size_t port : {0, 1}) EXPECT_GT(share_of(at / "ports.png", port_colour(port)), 0.02) << port;
  for (std::size_t port : {2, 3}) EXPECT_GT(share_of(at / "ports.png", port_colour(port)), 0.002) << port;
  EXPECT_LT(share_of(at / "ports.png", port_colour(4)), 1e-4);  // nobody's
  EXPECT_LT(std::filesystem::file_size(at / "ports.png"), 250000u);
}

TEST(PortPicture, TellsWhatIsMissing) {
  const Directory at;
  const auto message = [&](const char* vtu) -> std::string {
    try {
      return write_port_picture(at / vtu, "", at / "ports.png") ? "drawn" : "no EGL";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  EXPECT_NE(message("none.vtu").find("none.vtu"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(at / "ports.png"));
}

TEST(PortPictureDeathTest, WithoutEglNothingIsDrawnAndNothingEnds) {
  const Directory at;
  write_bar_with_ports(at / "ports.vtu");
  testing::FLAGS_gtest_death_test_style = "threadsafe";  // a fresh process: EGL is found once per process
  EXPECT_EXIT(
      {
        setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere", 1);
        unsetenv("DISPLAY");
        std::exit(write_port_picture(at / "ports.vtu", "", at / "ports.png") ? 1 : 0);
      },
      testing::ExitedWithCode(0), "");
  EXPECT_FALSE(std::filesystem::exists(at / "ports.png"));
}

TEST(PortPicture, CutsThroughTheAxesOfBores) {
  using Kind = meshes::Port::Kind;
  EXPECT_FALSE(cut_through_bores({{"seat", Kind::seat, 1, 0, 1, 0.1, 0, 0}}));
  const auto one = cut_through_bores({{"bore", Kind::bore, 1, 0, 1, 0.1, 0.2, 0}});
  ASSERT_TRUE(one);
  EXPECT_EQ(one->point, (Vector{0.2, 0, 0}));
  const auto two =
      cut_through_bores({{"a", Kind::bore, 1, 0, 1, 0.1, 0, 0}, {"b", Kind::bore, 1, 0, 1, 0.1, 0.3, 0.4}});
  ASSERT_TRUE(two);
  EXPECT_NEAR(two->normal[0], -0.8, 1e-15);
  EXPECT_NEAR(two->normal[1], 0.6, 1e-15);
}

// Twenty ports: colours differ from each other and from the grey of the rest.
TEST(PortPicture, HasAColourForEveryPort) {
  std::vector<Colour> colours{{222, 222, 222}};
  for (std::size_t i = 0; i < 20; ++i) {
    const Colour colour = port_colour(i);
    for (const auto& other : colours)
      EXPECT_GT(
          std::abs(colour[0] - other[0]) + std::abs(colour[1] - other[1]) + std::abs(colour[2] - other[2]),
          30)
          << i;
    colours.push_back(colour);
  }
}

}  // namespace
