#include "pipelines/search/cheap_models/torsion_by_feature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "pipelines/judge/analysis/exclusion_border.h"
#include "pipelines/judge/figures/diagrams.h"

namespace pipelines {
namespace {

using Rings = std::vector<TorsionRing>;

double distance_m(const TorsionRing& a, const TorsionRing& b) {
  return std::hypot(a.z_m - b.z_m, a.radius_m - b.radius_m);
}

/// The nearest ring of another feature; their number: there is none.
std::size_t next_beyond(const Rings& rings, const TorsionRing& end) {
  std::size_t nearest = rings.size();
  for (std::size_t i = 0; i < rings.size(); ++i)
    if (rings[i].feature != end.feature &&
        (nearest == rings.size() || distance_m(rings[i], end) < distance_m(rings[nearest], end)))
      nearest = i;
  return nearest;
}

/// Rings of each feature in their order along the axis, with the next ones of other features at both ends.
std::map<std::string, std::vector<std::size_t>> curves_of(const Rings& rings) {
  std::map<std::string, std::vector<std::size_t>> curves;  // ascending z: a bore's are apart
  for (std::size_t i = 0; i < rings.size(); ++i) curves[rings[i].feature].push_back(i);
  for (auto& [feature, own] : curves) {
    const auto first = next_beyond(rings, rings[own.front()]), last = next_beyond(rings, rings[own.back()]);
    if (first < rings.size()) own.insert(own.begin(), first);
    if (last < rings.size()) own.push_back(last);
  }
  return curves;
}

/// Torsional stress along three rings, at the instant of the one in the middle.
class RingParabola {
public:
  RingParabola(const Rings& rings, const std::array<std::size_t, 3>& index, const BodyLoads& loads,
               fem::UnitResponses& responses)
      : index_(index),
        responses_(responses),
        along_m_{-distance_m(rings[index[0]], rings[index[1]]), 0,
                 distance_m(rings[index[1]], rings[index[2]])} {
    const auto& middle = rings[index[1]];
    factors_ = middle.denser_instant >= 0 ? loads.history.passed_over.col(middle.denser_instant)
                                          : loads.history.values.col(middle.instant);
  }

  double along_m(std::size_t ring) const { return along_m_[ring]; }

  double stress_Pa(double along_m) const {
    const auto unit = unit_Pa(along_m);
    double sum[2] = {0, 0};
    for (std::size_t k = 0; k < unit.size(); ++k)
      for (std::size_t c = 0; c < 2; ++c) sum[c] += factors_[Eigen::Index(k)] * unit[k][c];
    return std::hypot(sum[0], sum[1]);
  }

  std::array<double, 2> place_zr_m(double along_m) const {
    const auto weight = weights(along_m);
    std::array<double, 2> place{0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      place[0] += weight[i] * responses_.rings[index_[i]].z_m;
      place[1] += weight[i] * responses_.rings[index_[i]].radius_m;
    }
    return place;
  }

  /// Brings one of the three rings there.
  void move(std::size_t ring, double along_m) {
    const auto unit = unit_Pa(along_m);
    const auto [z_m, radius_m] = place_zr_m(along_m);
    auto& moved = responses_.rings[index_[ring]];
    moved.z_m = z_m;
    moved.radius_m = radius_m;
    std::copy(unit.begin(), unit.end(),
              responses_.ring_shear_Pa.begin() + std::ptrdiff_t(index_[ring] * unit.size()));
  }

private:
  std::array<double, 3> weights(double along_m) const {
    std::array<double, 3> weight{1, 1, 1};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (j != i) weight[i] *= (along_m - along_m_[j]) / (along_m_[i] - along_m_[j]);
    return weight;
  }
  std::vector<std::array<double, 2>> unit_Pa(double along_m) const {
    const auto weight = weights(along_m);
    const std::size_t n_channels = responses_.channels.size();
    std::vector<std::array<double, 2>> unit(n_channels, {0, 0});
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < n_channels; ++k)
        for (std::size_t c = 0; c < 2; ++c)
          unit[k][c] += weight[i] * responses_.ring_shear_Pa[index_[i] * n_channels + k][c];
    return unit;
  }

  std::array<std::size_t, 3> index_;
  fem::UnitResponses& responses_;
  std::array<double, 3> along_m_;
  Eigen::ArrayXd factors_;
};

/// From the middle ring towards another one: half of the way, or the border of what is left out around that.
double reach_m(const RingParabola& parabola, const TorsionRing& next, std::size_t to,
               const meshes::BodyMesh& mesh) {
  if (next.max_Pa > 0) return parabola.along_m(to) / 2;
  double outside_m = 0, within_m = parabola.along_m(to);
  for (int i = 0; i < 40; ++i) {
    const double middle_m = (outside_m + within_m) / 2;
    const auto [z_m, r_m] = parabola.place_zr_m(middle_m);
    (beyond_border_m(mesh, {r_m, 0, z_m}, std::nullopt) >= 0 ? outside_m : within_m) = middle_m;
  }
  return outside_m;
}

void move_to_maximum(const Rings& rings, const std::array<std::size_t, 3>& index, const BodyLoads& loads,
                     const meshes::BodyMesh& mesh, fem::UnitResponses& responses) {
  RingParabola parabola(rings, index, loads, responses);
  const double low_m = reach_m(parabola, rings[index[0]], 0, mesh),
               high_m = reach_m(parabola, rings[index[2]], 2, mesh);
  double best_m = 0, most_Pa = parabola.stress_Pa(0);
  constexpr int n_steps = 256;
  for (int i = 0; i <= n_steps; ++i) {
    const double along_m = low_m + (high_m - low_m) * i / n_steps, here_Pa = parabola.stress_Pa(along_m);
    if (!(here_Pa > most_Pa)) continue;
    most_Pa = here_Pa;
    best_m = along_m;
  }
  if (best_m == 0) return;
  const std::size_t towards = best_m < 0 ? 0 : 2;
  parabola.move(best_m / parabola.along_m(towards) > 0.5 ? towards : 1, best_m);
}

}  // namespace

void move_rings_to_maxima(const BodyLoads& loads, const meshes::BodyMesh& mesh,
                          fem::UnitResponses& responses) {
  const auto rings = torsion_rings(loads, responses, mesh);
  for (const auto& [feature, curve] : curves_of(rings)) {
    const auto largest = std::max_element(curve.begin(), curve.end(),
                                          [&](auto a, auto b) { return rings[a].max_Pa < rings[b].max_Pa; });
    // At an end what is higher belongs to the next feature.
    if (largest == curve.begin() || largest + 1 == curve.end() || rings[*largest].max_Pa == 0) continue;
    move_to_maximum(rings, {*(largest - 1), *largest, *(largest + 1)}, loads, mesh, responses);
  }
}

std::map<std::string, FeatureTorsion> torsion_by_feature(const BodyLoads& loads,
                                                         const fem::UnitResponses& responses,
                                                         const meshes::BodyMesh& mesh) {
  const auto rings = torsion_rings(loads, responses, mesh);
  std::map<std::string, FeatureTorsion> result;
  for (const auto& [feature, curve] : curves_of(rings)) {
    auto& torsion = result[feature];
    for (const auto i : curve) torsion.value_Pa = std::max(torsion.value_Pa, rings[i].max_Pa);
    for (const auto i : curve)
      torsion.rise_Pa = std::max(torsion.rise_Pa, rings[i].max_Pa + rings[i].rise_Pa - torsion.value_Pa);
  }
  return result;
}

}  // namespace pipelines
