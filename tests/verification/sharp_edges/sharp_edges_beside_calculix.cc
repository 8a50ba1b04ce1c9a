/// Stress beside sharp inner edges of parts, from 1.2 to 3 times the distance that is left out, beside
/// CalculiX on a mesh with five cells within that distance.
///   tests/verification/sharp_edges/table      all ten parts, and tests/evidence/sharp_edges.md
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <random>

#include "fem/equations/loads/nodal_loads.h"
#include "fem/stress/cells/surface_stress.h"
#include "pipelines/command/calculix/calculix_model.h"
#include "pipelines/judge/analysis/exclusion_border.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/stages/place_errors.h"
#include "pipelines/search/loop/scene_run.h"
#include "tests/unit/pipelines/examples/results_directory.h"
#include "tests/unit/pipelines/examples/tools.h"
#include "tests/verification/calculix/calculix_results.h"
#include "tests/verification/sharp_edges/sharp_parts.h"

namespace {

using pipelines::Judged;
using Point = std::array<double, 3>;

constexpr double nearest = 1.2, farthest = 3;  // of the distance that is left out
constexpr std::size_t n_points = 20;
/// Cells of the reference within the distance that is left out; along the edge for so many of these distances
/// to either side, in an otherwise finer mesh than a run begins with.
constexpr double cells_within = 5, reach = 4.5, size_elsewhere = 0.7;

double distance_to_edges(const meshes::BodyMesh& mesh, const Point& at) {
  double least = 1e9;
  for (const auto& edge : mesh.sharp_edges) least = std::min(least, pipelines::distance_m(at, edge));
  return least;
}

double between(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

Point point_of(const fem::Nodes& nodes, std::size_t i) {
  return {nodes.xyz_m[3 * i], nodes.xyz_m[3 * i + 1], nodes.xyz_m[3 * i + 2]};
}

std::vector<std::size_t> nodes_on_surface(const fem::Nodes& nodes) {
  std::vector<std::size_t> result(nodes.faces.begin(), nodes.faces.end());
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

Point nearest_on(const std::array<Point, 2>& piece, const Point& at) {
  double along = 0, length2 = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    along += (at[d] - piece[0][d]) * (piece[1][d] - piece[0][d]);
    length2 += std::pow(piece[1][d] - piece[0][d], 2);
  }
  Point foot{};
  for (std::size_t d = 0; d < 3; ++d)
    foot[d] = piece[0][d] + std::clamp(along / length2, 0.0, 1.0) * (piece[1][d] - piece[0][d]);
  return foot;
}

/// The point of a sharp edge beside which a run finds the largest stress.
Point leading_foot(const Judged& analysis) {
  const auto& nodes = analysis.responses.nodes;
  const double d = analysis.mesh.sharp_edges.front().distance_m;
  double largest = 0;
  Point at{}, foot{};
  for (const auto i : nodes_on_surface(nodes)) {
    const double value = analysis.envelope.von_mises.value_Pa[i];
    const double away = distance_to_edges(analysis.mesh, point_of(nodes, i));
    if (analysis.places.excluded[i] == 0 && away < 12 * d && value > largest) {
      largest = value;
      at = point_of(nodes, i);
    }
  }
  double least = 1e9;
  for (const auto& edge : analysis.mesh.sharp_edges)
    for (const auto& piece : edge.pieces)
      if (const auto p = nearest_on(piece, at); between(p, at) < least) {
        least = between(p, at);
        foot = p;
      }
  return foot;
}

struct Reference {
  fem::Nodes nodes;
  std::vector<double> von_mises_Pa;
  std::vector<std::size_t> points;  ///< nodes: twenty beside the edge, and...
  double largest_at_border_Pa = 0;  ///< ... from 1 to 1.1 times the distance
  Point foot{};                     ///< of the edge, amid its fine cells
};

Reference reference(const pipelines::Scene& scene, const Judged& first,
                    const std::filesystem::path& directory) {
  const double d = first.mesh.sharp_edges.front().distance_m;
  const Point foot = leading_foot(first);
  auto fine = scene;
  auto& control = std::get<meshes::Import>(fine.bodies.at(0).shape).control;
  control.size_factor *= size_elsewhere;
  for (const auto& edge : first.mesh.sharp_edges)
    for (const auto& piece : edge.pieces) {
      const int n = std::max(1, int(std::ceil(between(piece[0], piece[1]) / d)));
      for (int i = 0; i <= n; ++i) {
        Point p{};
        for (std::size_t c = 0; c < 3; ++c) p[c] = piece[0][c] + (piece[1][c] - piece[0][c]) * i / n;
        if (between(p, foot) < reach * d) control.fine_spots.push_back({p, d, d / cells_within});
      }
    }
  pipelines::StageClock clock;
  const auto meshed = pipelines::mesh_body(fine.bodies.at(0), {});
  const auto loads = pipelines::load_bodies(fine, {meshed}, clock).body_loads.at(0);
  auto nodal = fem::nodal_loads(meshed.body, loads.unit_loads);
  const Eigen::ArrayXd factors = loads.history.values.col(0);
  std::vector<double> force(3 * nodal.nodes.n, 0.0);
  for (Eigen::Index k = 0; k < factors.size(); ++k)
    for (std::size_t i = 0; i < force.size(); ++i)
      force[i] += factors[k] * nodal.force_N[std::size_t(k) * force.size() + i];
  nodal.force_N = force;
  pipelines::write_calculix_model(directory / "part.inp", scene.title, {"pull"}, fine.bodies.at(0).material,
                                  nodal);
  const std::string ccx = "cd '" + directory.string() + "' && OMP_NUM_THREADS=1 ccx -i part > ccx.log 2>&1";
  if (std::system(ccx.c_str()) != 0) throw std::runtime_error("CalculiX did not run");
  const auto results = pipelines::read_calculix_results(directory / "part.frd", nodal.nodes.n);
  Reference reference;
  reference.foot = foot;
  reference.nodes = std::move(nodal.nodes);
  const auto& nodes = reference.nodes;
  for (std::size_t i = 0; i < nodes.n; ++i) {
    pipelines::Stress s;
    std::copy_n(&results.stress_Pa[6 * i], 6, s.begin());
    reference.von_mises_Pa.push_back(pipelines::von_mises_Pa(s));
  }
  std::vector<std::size_t> candidates;
  for (const auto i : nodes_on_surface(nodes)) {
    const auto at = point_of(nodes, i);
    const double away = distance_to_edges(meshed.mesh, at) / d;
    if (between(at, foot) > reach * d) continue;
    if (away >= nearest && away <= farthest) candidates.push_back(i);
    if (away >= 1 && away < 1.1)
      reference.largest_at_border_Pa = std::max(reference.largest_at_border_Pa, reference.von_mises_Pa[i]);
  }
  std::mt19937 random(51);
  for (std::size_t k = 0; k < n_points && k < candidates.size(); ++k) {
    std::swap(candidates[k], candidates[k + random() % (candidates.size() - k)]);
    reference.points.push_back(candidates[k]);
  }
  return reference;
}

struct Comparison {
  std::size_t n_held = 0;
  double worst_ratio = 0;  ///< difference over stated error
  double worst_Pa = 0, largest_Pa = 0;
};

/// The stated error at a point of the surface, by its nodes.
double stated_Pa(const Judged& analysis, const fem::PointOnBoundary& on) {
  double error_Pa = 0;
  for (const auto& feature : analysis.mesh.features)
    if (feature.boundary_id == analysis.responses.nodes.face_boundary_id[on.face])
      for (const auto& share : on.shares)
        error_Pa = std::max(error_Pa, pipelines::error_share_at(analysis, feature.name, share.node) *
                                          analysis.envelope.von_mises.value_Pa[share.node]);
  return error_Pa;
}

Comparison compare(const Judged& analysis, const Reference& reference) {
  const auto& nodes = analysis.responses.nodes;
  const double d = analysis.mesh.sharp_edges.front().distance_m;
  const Eigen::ArrayXd factors = analysis.loads.history.values.col(0);
  Comparison result;
  for (const auto i : reference.points) {
    const auto on = fem::point_on_boundary(nodes, point_of(reference.nodes, i), 0.2 * d);
    if (on.shares.empty()) {
      ADD_FAILURE() << "no face at a point of the reference";
      continue;
    }
    pipelines::StressPoint point;
    for (const auto& share : on.shares) point.parts.push_back({share.node, share.weight});
    const double ours_Pa =
                     pipelines::von_mises_of(pipelines::unit_stress_at(analysis.responses, point), factors),
                 true_Pa = reference.von_mises_Pa[i], off_Pa = std::abs(ours_Pa - true_Pa),
                 error_Pa = stated_Pa(analysis, on);
    if (std::getenv("MILLSTRESS_POINTS") != nullptr)
      fmt::print("  {:5.2f} d: {:7.2f} ccx {:7.2f} stated {:6.2f}\n",
                 distance_to_edges(analysis.mesh, point_of(reference.nodes, i)) / d, ours_Pa / 1e6,
                 true_Pa / 1e6, error_Pa / 1e6);
    result.n_held += off_Pa <= error_Pa;
    result.worst_ratio = std::max(result.worst_ratio, off_Pa / error_Pa);
    result.worst_Pa = std::max(result.worst_Pa, off_Pa);
    result.largest_Pa = std::max(result.largest_Pa, true_Pa);
  }
  return result;
}

/// By CalculiX where a run has its largest stress; 0 inside the body, and where its cells are not fine.
double at_peak_Pa(const Reference& reference, const Judged& analysis) {
  const auto& at_m = analysis.peak.position_m;
  const double d = analysis.mesh.sharp_edges.front().distance_m;
  const auto on = fem::point_on_boundary(reference.nodes, at_m, 0.05 * d);
  if (on.shares.empty() || between(at_m, reference.foot) > reach * d) return 0;
  double value_Pa = 0;
  for (const auto& share : on.shares) value_Pa += share.weight * reference.von_mises_Pa[share.node];
  return value_Pa;
}

Judged run(const pipelines::Scene& scene, double tolerance) {
  pipelines::SceneRunOptions options;
  options.fresh = true;
  options.cache = false;
  options.accuracy.tolerance = tolerance;
  options.accuracy.time_limit_s = tolerance > 0 ? 60 : 0;
  pipelines::StageClock clock;
  return pipelines::run_scene(scene, options, clock).analyses.at(0);
}

void hold(const sharp_parts::SharpPart& part, const std::vector<double>& tolerances) {
  SCOPED_TRACE(part.name);
  const results_test::Directory directory;
  const auto scene = pipelines::read_scene(sharp_parts::write_scene(part, directory.path));
  std::optional<Reference> by_calculix;
  for (const double tolerance : tolerances) {
    const auto analysis = run(scene, tolerance);
    ASSERT_FALSE(analysis.mesh.sharp_edges.empty());
    if (!by_calculix) by_calculix = reference(scene, analysis, directory.path);
    ASSERT_EQ(by_calculix->points.size(), n_points);
    const auto comparison = compare(analysis, *by_calculix);
    if (std::getenv("MILLSTRESS_POINTS") != nullptr)
      for (const auto& place : analysis.place_stresses)
        fmt::print("  {}: {:.1f} ± {:.1f}, {:.2f} cells to the border\n", place.feature, place.value_Pa / 1e6,
                   place.error_Pa / 1e6, pipelines::cells_to_border(analysis, place));
    const auto governing = pipelines::governing_stress(analysis);
    const auto row = fmt::format(
        "| {} | {} | {:.2f} | {} | {:.1f} ± {:.1f} | {:.1f} | {} of {} | {:.1f} | {:.2f} |", part.name,
        tolerance > 0 ? "search" : "first", 1e3 * analysis.mesh.sharp_edges.front().distance_m,
        analysis.responses.n_dofs, governing.value_Pa / 1e6, governing.errors.numerical_Pa() / 1e6,
        by_calculix->largest_at_border_Pa / 1e6, comparison.n_held, n_points, comparison.worst_Pa / 1e6,
        comparison.worst_ratio);
    fmt::print("{}\n", row);
    std::fflush(stdout);
    if (const char* rows = std::getenv("MILLSTRESS_SHARP_ROWS"); rows != nullptr)
      std::ofstream(rows, std::ios::app) << row << '\n';
    EXPECT_EQ(comparison.n_held, n_points);
    if (const auto there_Pa = at_peak_Pa(*by_calculix, analysis); there_Pa > 0) {
      EXPECT_NEAR(analysis.peak.value_Pa, there_Pa, analysis.peak.errors.numerical_Pa());
    }
    // The largest stress anywhere is at least that at the border here.
    EXPECT_GE(governing.value_Pa + governing.errors.numerical_Pa(), by_calculix->largest_at_border_Pa);
  }
}

}  // namespace

TEST(SharpEdges, SlotIsBoundedBesideItsCorners) {
  SKIP_WITHOUT("ccx");
  for (const auto& part : sharp_parts::all())
    if (part.name == "slot") hold(part, {0});
}

// Where edges meet stress may rise faster than along them, and cells beside the meeting see less of it.
TEST(SharpEdges, PartsWithVerticesAreBoundedOnTheFirstRunAndInTheSearch) {
  SKIP_WITHOUT("ccx");
  const char* only = std::getenv("MILLSTRESS_SHARP_PART");
  for (const auto& part : sharp_parts::with_vertices())
    if (only == nullptr || part.name == only) hold(part, {0, 0.05});
}

TEST(SharpEdges, TenPartsAreBoundedOnTheFirstRunAndInTheSearch) {
  SKIP_WITHOUT("ccx");
  const char* only = std::getenv("MILLSTRESS_SHARP_PART");
  for (const auto& part : sharp_parts::all())
    if (only == nullptr || part.name == only) hold(part, {0, 0.05});
}
