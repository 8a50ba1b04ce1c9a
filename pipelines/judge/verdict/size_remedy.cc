#include "pipelines/judge/verdict/size_remedy.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "fem/stress/cells/surface_stress.h"
#include "meshes/shaft_layout/shaft_checks.h"
#include "meshes/values/refused.h"
#include "pipelines/base/fatigue/endurance.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/analysis/weld_places.h"
#include "pipelines/judge/figures/stress_gradient.h"
#include "pipelines/judge/life/body_fatigue.h"
#include "pipelines/judge/verdict/local_laws.h"
#include "pipelines/scene/kinds/body_names.h"

namespace pipelines {
namespace {

using Eigen::Index;

/// What is too large: the stress at one instant, or what it changes by between two.
struct TooLarge {
  std::string place;  ///< a feature, or a weld toe
  std::array<double, 3> position_m{};
  std::size_t node = 0;  ///< there; at a toe its nearer reference point
  double factor = 1;     ///< by which it has to come down
  Index to = 0;
  std::optional<Index> from;
  double own_share = 0;                  ///< share of the body's own accelerated mass
  std::optional<double> gradient_per_m;  ///< of the amplitude, where the strength has its support
  bool is_of_running = true;
};

/// A value of an instant, or the change of it between two: columns of instants.
template <typename Columns>
Eigen::ArrayXd taken_from(const Columns& columns, const TooLarge& stress) {
  Eigen::ArrayXd column = columns.col(stress.to);
  if (stress.from) column -= columns.col(*stress.from);
  return column;
}

/// The instant next to one between them; the last is followed by the first.
Index nearest_instant(const Responded& analysis, double instant) {
  return Index(std::llround(instant)) % analysis.loads.history.values.cols();
}

double own_share(const Responded& analysis, const std::vector<double>& effect_share) {
  double sum = 0;
  const auto& effects = analysis.loads.history.effects;
  for (std::size_t e = 0; e < effects.size() && e < effect_share.size(); ++e)
    for (const auto* own : {effect_name::drum_gravity, effect_name::drum_transport, DrumNames::spin})
      if (effects[e] == own) sum += effect_share[e];
  return std::clamp(sum, 0.0, 1.0);
}

/// What a place bears by its support, where the gradient goes with a size.
StrengthBySize supported(const Responded& analysis, const TooLarge& stress,
                         const std::function<double(double)>& gradient_of_size, double now_m) {
  if (!stress.gradient_per_m) return {};
  const auto& material = analysis.scene.fatigue->material;
  const double of_one = *stress.gradient_per_m / gradient_of_size(now_m);
  return [=](double size_m) {
    return support_factor(material, StressKind::normal, of_one * gradient_of_size(size_m));
  };
}

/// Height of the thicker segment's surface above the thinner one's, at the angle of a place.
double step_m(const meshes::ShaftSegment& thin, const meshes::ShaftSegment& thick,
              const std::array<double, 3>& at_m) {
  const double angle_rad = std::atan2(at_m[1], at_m[0]), offset_m = thick.eccentricity_m;
  const double along_m = offset_m * std::cos(angle_rad - thick.eccentricity_angle_rad);
  const double radius_m = thick.diameter_m / 2;
  return along_m + std::sqrt(radius_m * radius_m + along_m * along_m - offset_m * offset_m) -
         thin.diameter_m / 2;
}

/// Nominal stress of the thinner section next to a shoulder.
std::optional<DinTriple> nominal_Pa(const Judged& analysis, const std::string& thin, double z_m,
                                    const TooLarge& stress) {
  if (!analysis.diagrams) return std::nullopt;
  const auto* section = nearest_section(*analysis.diagrams, thin, z_m);
  if (section == nullptr || stress.to >= section->by_statics.cols()) return std::nullopt;
  SectionResult taken;
  taken.plane = section->plane;
  taken.by_statics = taken_from(section->by_statics, stress);
  auto nominal = nominal_load(taken).mean_Pa;
  nominal.tension = std::abs(nominal.tension);
  return nominal;
}

bool fits(meshes::Shaft shaft, std::size_t fillet, double radius_m) {
  shaft.fillets_m[fillet] = radius_m;
  try {
    meshes::check_shaft(shaft);
  } catch (const meshes::GeometryRefused&) {
    return false;
  }
  return true;
}

/// Where the mix of loads is not known, each kind of them for itself: the largest radius does for all.
std::optional<double> radius_of(const ShoulderSize& shoulder, const DinTriple& nominal,
                                const TooLarge& stress, const StrengthBySize& strength) {
  if (stress.is_of_running) return radius_for(shoulder, nominal, stress.factor, strength);
  double largest_m = 0;
  for (const auto& alone : {DinTriple{1, 0, 0}, DinTriple{0, 1, 0}, DinTriple{0, 0, 1}}) {
    const auto radius_m = radius_for(shoulder, alone, stress.factor, strength);
    if (!radius_m) return std::nullopt;
    largest_m = std::max(largest_m, *radius_m);
  }
  return largest_m;
}

std::string radius_remedy(const Judged& analysis, const meshes::Shaft& shaft, const TooLarge& stress) {
  for (std::size_t i = 0; i < shaft.fillets_m.size(); ++i) {
    const auto &left = shaft.segments[i], &right = shaft.segments[i + 1];
    if (stress.place != "fillet " + left.name + "/" + right.name || left.bore_m > 0 || right.bore_m > 0)
      continue;
    const bool rises = left.diameter_m < right.diameter_m;
    const auto &thin = rises ? left : right, &thick = rises ? right : left;
    const double large_m = thin.diameter_m + 2 * step_m(thin, thick, stress.position_m);
    const ShoulderSize shoulder{thin.diameter_m, large_m, shaft.fillets_m[i]};
    const auto nominal = nominal_Pa(analysis, thin.name, left.end_m, stress);
    if (!nominal || !(shoulder.fillet_m > 0) || !(large_m > thin.diameter_m)) return "";
    const auto gradient = [=](double radius_m) {
      return din_shoulder_gradient_1_m(shoulder.small_m, shoulder.large_m, radius_m).bending;
    };
    auto radius_m =
        radius_of(shoulder, *nominal, stress, supported(analysis, stress, gradient, shoulder.fillet_m));
    if (radius_m) radius_m = two_digits_up_m(*radius_m);
    if (!radius_m || *radius_m >= (large_m - thin.diameter_m) / 2 || !fits(shaft, i, *radius_m)) return "";
    return fmt::format(
        ", or the fillet have a radius of about {:g} mm in place of {:g} mm (by notch factors)",
        1e3 * *radius_m, 1e3 * shoulder.fillet_m);
  }
  return "";
}

/// A plate or a wall at a place.
struct Plate {
  std::string name;
  double thickness_m = 0;
};

std::optional<Plate> chamber_plate(const meshes::Chamber& chamber, const std::string& place, bool is_toe) {
  const auto begins = [&](const char* name) { return place.rfind(name, 0) == 0; };
  if (is_toe || place == "tube outside" || place == "inner_wall")
    return Plate{"wall of the tube", chamber.tube.wall_m};
  if (begins("web ")) return Plate{"webs", chamber.webs.thickness_m};
  if (begins("lug ")) return Plate{"lugs", chamber.lugs.thickness_m};
  return std::nullopt;
}

std::optional<Plate> drum_wall(const meshes::Shaft& drum, const std::string& place) {
  constexpr double thin = 0.2;  // of the outer radius: a wall bends as a plate
  for (const auto& segment : drum.segments) {
    const double wall_m = (segment.diameter_m - segment.bore_m) / 2;
    if (segment.bore_m > 0 && wall_m <= thin * segment.diameter_m / 2 &&
        (place == segment.name || place == segment.bore_port || place == "bore " + segment.name))
      return Plate{"wall of " + segment.name, wall_m};
  }
  return std::nullopt;
}

/// None where ranks share the body: a rank has the stress of its own nodes only.
std::optional<Plate> plate_at(const Responded& analysis, const std::string& place, bool is_toe) {
  const auto& scene = analysis.scene;
  if (analysis.responses.shared) return std::nullopt;
  if (const auto* chamber = std::get_if<ChamberShape>(&scene.shape))
    return chamber_plate(chamber->geometry, place, is_toe);
  return scene.name == "drum" && scene.shaft() != nullptr ? drum_wall(scene.shaft()->geometry, place)
                                                          : std::nullopt;
}

using UnitStress = std::vector<std::array<double, 6>>;

/// Unit stress on the other face of a plate; empty: no face of the mesh is there.
UnitStress opposite_unit_Pa(const Responded& analysis, const TooLarge& stress, double thickness_m) {
  constexpr double off_surface = 0.05;  // of the thickness: the normal is one of chords
  const auto& nodes = analysis.responses.nodes;
  if (nodes.faces.empty()) return {};
  const auto normal = SurfaceSlopes(nodes).outward_normal(stress.node);
  auto at_m = stress.position_m;
  for (std::size_t c = 0; c < 3; ++c) at_m[c] -= thickness_m * normal[c];
  StressPoint point;
  for (const auto& share : fem::point_on_boundary(nodes, at_m, off_surface * thickness_m).shares)
    point.parts.push_back({share.node, share.weight});
  return point.parts.empty() ? UnitStress{} : unit_stress_at(analysis.responses, point);
}

Stress stress_of(const UnitStress& unit_Pa, const Eigen::ArrayXd& factors) {
  Stress sum{};
  for (std::size_t k = 0; k < unit_Pa.size(); ++k)
    for (std::size_t c = 0; c < 6; ++c) sum[c] += factors[Index(k)] * unit_Pa[k][c];
  return sum;
}

/// What is too large at a face, and on the other face of the plate where that is known.
struct Faces {
  Stress own_Pa{};
  std::optional<Stress> opposite_Pa;
};

/// The thickness, or from one to another where the parts of the stress are not known: the least one bends
/// alone, the largest one has no bending.
std::string thickness_remedy(const Plate& plate, const Faces& faces, const TooLarge& stress,
                             const StrengthBySize& strength) {
  const auto needed = [&](const PlateStress& parts) {
    return thickness_for(parts, plate.thickness_m, stress.own_share, stress.factor, strength);
  };
  const bool is_known = faces.opposite_Pa && stress.is_of_running;
  const auto least =
      needed(is_known ? plate_stress(faces.own_Pa, *faces.opposite_Pa) : PlateStress{Stress{}, faces.own_Pa});
  const auto most = is_known ? least : needed({faces.own_Pa, Stress{}});
  if (!least || !most) return "";
  const auto up = fmt::format("{:g} mm", 1e3 * two_digits_up_m(*most));
  const auto down = is_known ? "" : fmt::format("{:g} to ", 1e3 * two_digits_down_m(*least));
  return fmt::format(", or the {} be about {}{} thick in place of {:g} mm (by bending and membrane stress)",
                     plate.name, down, up, 1e3 * plate.thickness_m);
}

std::string thickness_remedy(const Responded& analysis, const TooLarge& stress) {
  const auto plate = plate_at(analysis, stress.place, false);
  if (!plate) return "";
  const auto factors = taken_from(analysis.loads.history.values, stress);
  Faces faces;
  faces.own_Pa = stress_of(unit_stress_at(analysis.responses, {{{stress.node, 1}}, 0}), factors);
  if (const auto unit_Pa = opposite_unit_Pa(analysis, stress, plate->thickness_m); !unit_Pa.empty())
    faces.opposite_Pa = stress_of(unit_Pa, factors);
  const auto gradient = [](double thickness_m) { return 2 / thickness_m; };
  return thickness_remedy(*plate, faces, stress, supported(analysis, stress, gradient, plate->thickness_m));
}

std::string size_remedy(const Judged& analysis, const TooLarge& stress) {
  if (const auto* shaft = analysis.scene.shaft())
    if (auto text = radius_remedy(analysis, shaft->geometry, stress); !text.empty()) return text;
  return thickness_remedy(analysis, stress);
}

/// A weld toe by the stress along one direction.
/// @param angle_rad  ToeStress::angle_rad
/// @param is_range   its largest change over the cycle; else the largest stress
std::string toe_remedy(const Judged& analysis, const std::string& toe, double factor, double angle_rad,
                       bool is_range, bool is_of_running) {
  const auto plate = plate_at(analysis, toe, true);
  if (!plate || !analysis.scene.fatigue) return "";
  const auto spot = std::find_if(analysis.hot_spots.begin(), analysis.hot_spots.end(),
                                 [&](const auto& s) { return s.name == toe; });
  if (spot == analysis.hot_spots.end()) return "";
  const auto places = weld_places(analysis);
  const auto place = std::find_if(places.begin(), places.end(), [&](const auto& p) { return p.name == toe; });
  if (place == places.end()) return "";
  const auto& values = analysis.loads.history.values;
  const auto along_Pa = place->along_Pa(values, angle_rad);
  TooLarge stress{toe, spot->toe_m, spot->near_node, factor, spot->instant, {}, 0, {}, is_of_running};
  Index from = 0;
  if (is_range) {
    along_Pa.maxCoeff(&stress.to);
    along_Pa.minCoeff(&from);
    stress.from = from;
  }
  const Eigen::ArrayXd factors = taken_from(values, stress);
  Faces faces;
  faces.own_Pa[0] = place->along_Pa(factors, angle_rad)[0];
  if (const auto unit_Pa = opposite_unit_Pa(analysis, stress, plate->thickness_m); !unit_Pa.empty()) {
    auto opposite = *place;
    opposite.unit_Pa = Eigen::Map<const Eigen::MatrixXd>(unit_Pa.front().data(), 6, Index(unit_Pa.size()));
    faces.opposite_Pa = Stress{opposite.along_Pa(factors, angle_rad)[0]};
  }
  const double exponent = place->detail.thickness_exponent;
  return thickness_remedy(*plate, faces, stress, [=](double thickness_m) {
    return is_range ? thickness_factor(thickness_m, exponent) : 1;
  });
}

}  // namespace

std::string size_remedy(const Judged& analysis, double factor) {
  if (!(factor > 1)) return "";
  const auto governing = governing_stress(analysis);
  if (governing.kind == GoverningStress::Kind::hot_spot)
    return toe_remedy(analysis, governing.place, factor, 0, false, true);
  const auto& peak = analysis.peak;
  return size_remedy(analysis, {peak.feature,
                                peak.position_m,
                                peak.node,
                                factor,
                                peak.instant,
                                {},
                                own_share(analysis, peak.effect_share),
                                {},
                                true});
}

std::string size_remedy_of_fatigue(const Judged& analysis, const std::string& place, double factor,
                                   bool is_of_running) {
  if (!(factor > 1)) return "";
  const auto& fatigue = *analysis.fatigue;
  for (const auto& weld : fatigue.welds)
    if (weld.name == place) return toe_remedy(analysis, place, factor, weld.angle_rad, true, is_of_running);
  for (const auto& used : fatigue.places)
    if (used.feature == place)
      return size_remedy(analysis,
                         {place, used.position_m, used.node, factor, nearest_instant(analysis, used.to),
                          nearest_instant(analysis, used.from), own_share(analysis, used.effect_share),
                          used.gradient_per_m, is_of_running});
  return "";
}

}  // namespace pipelines
