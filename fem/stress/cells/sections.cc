#include "fem/stress/cells/sections.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "fem/base/common/dense_algebra.h"
#include "fem/base/values/constants.h"
#include "fem/mesh/grid/cell_geometry.h"

namespace fem {

namespace {

constexpr double relative_tolerance =
    1e-6;  // of the radius: coordinates in the file carry 16 digits, charts 15

struct FlatFace {
  double z_m = 0;
  std::vector<std::int32_t> nodes;
};

/// All faces normal to z, each once, ascending in z.
std::vector<FlatFace> flat_faces(const Grid& grid) {
  const int n_faces = grid.shape().n_faces();
  std::vector<char> at_boundary(n_faces * grid.n_cells(), 0);
  for (const auto& face : grid.boundary) at_boundary[n_faces * std::size_t(face.cell) + face.face] = 1;
  const auto corners = face_corners(grid.shape());
  std::vector<FlatFace> faces;
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (int f = 0; f < n_faces; ++f) {
      const auto nodes = nodes_of_face(grid, c, f);
      const auto opposite =  // a corner on the other side
          grid.shape().is_tetrahedron() ? grid.nodes_of(c)[f] : nodes_of_face(grid, c, f ^ 1)[0];
      double low = grid.position(nodes[0])[2], high = low, size = 0;
      for (const int corner : corners) {
        const double* x = grid.position(nodes[corner]);
        low = std::min(low, x[2]);
        high = std::max(high, x[2]);
        size =
            std::max(size, std::hypot(x[0] - grid.position(nodes[0])[0], x[1] - grid.position(nodes[0])[1]));
      }
      const bool cell_is_below = grid.position(opposite)[2] < low;
      if (high - low <= relative_tolerance * size && (cell_is_below || at_boundary[n_faces * c + f]))
        faces.push_back({(low + high) / 2, nodes});
    }
  std::stable_sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) { return a.z_m < b.z_m; });
  return faces;
}

/// Integrals of the shape functions over a section, times 1, x, y measured from the z axis.
struct Section {
  struct Weight {
    double one = 0, x = 0, y = 0;
  };
  std::map<std::int32_t, Weight> weights;
  std::vector<std::int32_t> rim;
  std::vector<double> rim_weight;  ///< sum to 1
  double area_m2 = 0;
  Eigen::Matrix<double, 6, 6> rigid =
      Eigen::Matrix<double, 6, 6>::Zero();  // of the modes about the section's axis
};

void refuse(const SectionPlane& plane, const std::string& what) {
  std::ostringstream message;
  message << "section plane z = " << plane.z_m << " m, radius " << plane.radius_m << " m: " << what;
  throw std::invalid_argument(message.str());
}

Section make_section(const Grid& grid, const std::vector<FlatFace>& faces, const SectionPlane& plane) {
  if (!(plane.radius_m > 0)) refuse(plane, "the radius must be positive");
  const double tolerance = relative_tolerance * plane.radius_m;
  const auto from_axis = [&](std::int32_t node) {
    const double* x = grid.position(node);
    return std::hypot(x[0] - plane.axis_x_m, x[1] - plane.axis_y_m);
  };
  const auto hangs = [&](std::int32_t node) {  // on the larger neighbour's parabola, not on the circle
    return std::binary_search(grid.hanging.node.begin(), grid.hanging.node.end(), node);
  };
  const auto from_z_axis = [&](std::int32_t node) {
    return std::hypot(grid.position(node)[0], grid.position(node)[1]);
  };
  const Tabulation at = gauss_on_face(grid.shape(), grid.degree + 3);
  Section section;
  auto face = std::lower_bound(faces.begin(), faces.end(), plane.z_m - tolerance,
                               [](const FlatFace& f, double z) { return f.z_m < z; });
  for (; face != faces.end() && face->z_m <= plane.z_m + tolerance; ++face) {
    if (std::any_of(face->nodes.begin(), face->nodes.end(), [&](auto node) {
          return !hangs(node) && (from_axis(node) > plane.radius_m + tolerance ||
                                  from_z_axis(node) < plane.inner_radius_m - tolerance);
        }))
      continue;
    for (int q = 0; q < at.n_points; ++q) {
      const FacePoint p = face_point(grid, face->nodes, at, q);
      const double area = std::abs(p.area[2]);
      section.area_m2 += area;
      for (int i = 0; i < at.n_shapes; ++i) {
        const double share = area * at.value[std::size_t(q) * at.n_shapes + i];
        auto& weight = section.weights[face->nodes[i]];
        weight.one += share;
        weight.x += share * p.position[0];
        weight.y += share * p.position[1];
      }
      const double x = p.position[0] - plane.axis_x_m, y = p.position[1] - plane.axis_y_m;
      Eigen::Matrix<double, 3, 6> modes;
      modes << 1, 0, 0, 0, 0, -y, 0, 1, 0, 0, 0, x, 0, 0, 1, y, -x, 0;
      section.rigid += area * modes.transpose() * modes;
    }
  }
  if (section.weights.empty()) refuse(plane, "no cell faces lie in it");
  // A circle of n chords covers sin(2 pi / n) / (2 pi / n) of its disc: 10 % off for 8 chords, far less for
  // parabolas.
  const double disc = pi * plane.radius_m * plane.radius_m, allowed = grid.degree == 1 ? 0.15 : 0.01;
  const double ring = disc - pi * plane.inner_radius_m * plane.inner_radius_m;
  if (std::abs(section.area_m2 - ring) > allowed * ring)
    refuse(plane, "its cell faces have " + std::to_string(section.area_m2 / ring) + " of the area of the " +
                      (plane.inner_radius_m > 0 ? "ring" : "disc"));
  std::vector<double> angles_rad;
  for (const auto& [node, weight] : section.weights) {
    if (hangs(node) || std::abs(from_axis(node) - plane.radius_m) > tolerance) continue;
    section.rim.push_back(node);
    angles_rad.push_back(
        std::atan2(grid.position(node)[1] - plane.axis_y_m, grid.position(node)[0] - plane.axis_x_m));
  }
  if (section.rim.empty()) refuse(plane, "no node lies on its rim");
  section.rim_weight.assign(section.rim.size(), 1.0 / double(section.rim.size()));
  if (grid.hanging.n() > 0)
    if (auto weights = weights_around(angles_rad); !weights.empty()) section.rim_weight = std::move(weights);
  return section;
}

/// Sums over the nodes of a section.
struct SectionSums {
  std::array<double, 6> resultant{}, motion{};
  std::array<double, 2> mean_rim_shear_Pa{};
};

/// The sums over the nodes that this rank has.
SectionSums sum(const Grid& grid, const SectionPlane& plane, const Section& section,
                const UnitResponses& responses, std::size_t load) {
  const auto stress = [&](std::int32_t node) {
    return responses.unit_stress_Pa(std::size_t(node)) + 6 * load;
  };
  SectionSums r;
  for (const auto& [node, weight] : section.weights) {
    if (!responses.has(std::size_t(node))) continue;
    const double *s = stress(node), *u = responses.unit_displacement_m(std::size_t(node)) + 3 * load;
    const double xz = s[5], yz = s[4], zz = s[2];
    r.resultant[0] += weight.one * xz;
    r.resultant[1] += weight.one * yz;
    r.resultant[2] += weight.one * zz;
    r.resultant[3] += weight.y * zz;
    r.resultant[4] -= weight.x * zz;
    r.resultant[5] += weight.x * yz - weight.y * xz;
    const double x = weight.x - plane.axis_x_m * weight.one, y = weight.y - plane.axis_y_m * weight.one;
    for (std::size_t d = 0; d < 3; ++d) r.motion[d] += weight.one * u[d];
    r.motion[3] += y * u[2];
    r.motion[4] -= x * u[2];
    r.motion[5] += x * u[1] - y * u[0];
  }
  for (std::size_t i = 0; i < section.rim.size(); ++i) {
    const auto node = section.rim[i];
    if (!responses.has(std::size_t(node))) continue;
    const auto shear = rim_shear(grid.position(node)[0] - plane.axis_x_m,
                                 grid.position(node)[1] - plane.axis_y_m, stress(node));
    for (std::size_t c = 0; c < 2; ++c) r.mean_rim_shear_Pa[c] += section.rim_weight[i] * shear[c];
  }
  return r;
}

SectionResponse respond(const Section& section, const SectionSums& sums) {
  const Eigen::Matrix<double, 6, 1> motion =
      solve_symmetric(section.rigid, Eigen::Map<const Eigen::Matrix<double, 6, 1>>(sums.motion.data()));
  SectionResponse r;
  r.resultant = sums.resultant;
  r.mean_rim_shear_Pa = sums.mean_rim_shear_Pa;
  for (int d = 0; d < 3; ++d) {
    r.translation_m[std::size_t(d)] = motion[d];
    r.rotation_rad[std::size_t(d)] = motion[3 + d];
  }
  return r;
}

}  // namespace

std::array<double, 2> rim_shear(double x_m, double y_m, const double* stress_Pa) {
  const double r = std::hypot(x_m, y_m), c = x_m / r, s = y_m / r;
  return {(stress_Pa[1] - stress_Pa[0]) * s * c + stress_Pa[3] * (c * c - s * s),
          stress_Pa[4] * c - stress_Pa[5] * s};
}

namespace {

/// More than the pressure round a seat has as a rule.
constexpr int highest_left_out = 12;

/// The weights changed by as little as lets a mean see nothing of the harmonics 1 to `highest`, sine and
/// cosine; none where one of them would be negative. Half of the angle between neighbours alone leaves a
/// hundredth of a lateral force's shear stress in the mean where unlike gaps meet, which may be more than a
/// small torque has.
std::optional<std::vector<double>> without_harmonics(const std::vector<double>& angles_rad,
                                                     const std::vector<double>& weights, int highest) {
  constexpr double independent = 1e-6;  // of 0.5 where nodes are even
  const auto n = Eigen::Index(weights.size());
  Eigen::MatrixXd harmonics(n, 2 * highest + 1), wanted(2 * highest + 1, 1);
  wanted.setZero();
  wanted(0, 0) = 1;
  const Eigen::Map<const Eigen::VectorXd> before(weights.data(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    harmonics(i, 0) = 1;
    for (int k = 1; k <= highest; ++k) {
      harmonics(i, 2 * k - 1) = std::cos(k * angles_rad[std::size_t(i)]);
      harmonics(i, 2 * k) = std::sin(k * angles_rad[std::size_t(i)]);
    }
  }
  const Eigen::MatrixXd scaled = before.asDiagonal() * harmonics;
  const Eigen::MatrixXd missing = wanted - transposed_product(harmonics, before);
  const auto multipliers = solve_symmetric(transposed_product(harmonics, scaled), missing, independent);
  if (!multipliers) return std::nullopt;
  const Eigen::VectorXd after = before + product(scaled, *multipliers);
  if (after.minCoeff() < 0) return std::nullopt;
  return std::vector<double>(after.data(), after.data() + n);
}

}  // namespace

std::vector<double> weights_around(const std::vector<double>& angles_rad) {
  const std::size_t n = angles_rad.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return angles_rad[a] < angles_rad[b]; });
  std::vector<double> weights(n, 0);
  for (std::size_t k = 0; k < n; ++k) {
    const auto here = order[k], next = order[(k + 1) % n];
    double gap = angles_rad[next] - angles_rad[here];
    if (k + 1 == n) gap += 2 * pi;
    if (gap > pi / 2 * (1 + relative_tolerance)) return {};
    weights[here] += gap / (4 * pi);
    weights[next] += gap / (4 * pi);
  }
  for (int highest = int(std::min<std::size_t>(highest_left_out, (n - 1) / 2)); highest > 0; --highest)
    if (const auto better = without_harmonics(angles_rad, weights, highest)) return *better;
  return weights;
}

void respond_on_sections(const Grid& grid, const std::vector<SectionPlane>& planes,
                         UnitResponses& responses) {
  responses.planes = planes;
  responses.plane_area_m2.clear();
  responses.sections.clear();
  if (planes.empty()) return;
  const auto faces = flat_faces(grid);
  for (const auto& plane : planes) {
    const Section section = make_section(grid, faces, plane);
    responses.plane_area_m2.push_back(section.area_m2);
    std::vector<SectionSums> sums;
    for (std::size_t k = 0; k < responses.channels.size(); ++k)
      sums.push_back(sum(grid, plane, section, responses, k));
    static_assert(sizeof(SectionSums) == 14 * sizeof(double));
    responses.sum_over_ranks(sums.front().resultant.data(), 14 * sums.size());
    for (const auto& of_load : sums) responses.sections.push_back(respond(section, of_load));
  }
}

}  // namespace fem
