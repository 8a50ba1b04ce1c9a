#include "pipelines/superpose/envelope/superposition.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "fem/mesh/ranks/ranks.h"
#include "pipelines/base/common/parallel.h"
#include "pipelines/superpose/kernels/batch_walk.h"
#include "pipelines/superpose/kernels/lode_cosine.h"
#include "pipelines/superpose/kernels/walked_factors.h"

namespace pipelines {
namespace {

Stress combine(const double* unit, const Eigen::ArrayXXd& factors, Eigen::Index instant) {
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (Eigen::Index k = 0; k < factors.rows(); ++k)
    sum += factors(k, instant) * Eigen::Map<const Eigen::Matrix<double, 6, 1>>(unit + 6 * k);
  Stress s;
  std::copy_n(sum.data(), 6, s.begin());
  return s;
}

/// Shares of the effects in the von Mises stress of a node at one instant.
/// @param sigma_v  von Mises stress of `stress`
/// @param along    room for a number per channel: 3/2 of its unit stress times the deviator over sigma_v^2
void find_shares(const double* unit, const ChannelHistory& loads, const Stress& stress, double sigma_v,
                 Eigen::Index instant, Eigen::VectorXd& along, float* shares) {
  const std::size_t n_effects = loads.effects.size();
  if (sigma_v == 0) {
    std::fill_n(shares, n_effects, 0.0f);
    return;
  }
  const double mean = (stress[0] + stress[1] + stress[2]) / 3, scale = 1.5 / (sigma_v * sigma_v);
  Eigen::Matrix<double, 6, 1> deviator;
  for (Eigen::Index c = 0; c < 6; ++c)
    deviator[c] = scale * (c < 3 ? stress[std::size_t(c)] - mean : 2 * stress[std::size_t(c)]);
  for (Eigen::Index k = 0; k < along.size(); ++k)
    along[k] = deviator.dot(Eigen::Map<const Eigen::Matrix<double, 6, 1>>(unit + 6 * k));
  for (std::size_t e = 0; e < n_effects; ++e)
    shares[e] = float(loads.by_effect[e].col(instant).matrix().dot(along));
}

/// Largest principal stress by the Lode angle, mean + 2/3 sigma_v cos(theta), where that is as exact as QR
/// iteration: the angle loses digits towards two equal largest principal stresses, cos(3 theta) = -1.
std::optional<double> principal_by_angle(const Stress& s) {
  const double mean = (s[0] + s[1] + s[2]) / 3, sigma_v = von_mises_Pa(s), scale = 1 / sigma_v;
  const double dx = scale * (s[0] - mean), dy = scale * (s[1] - mean), dz = scale * (s[2] - mean);
  const double xy = scale * s[3], yz = scale * s[4], xz = scale * s[5];
  const double cosine =
      13.5 * (dx * (dy * dz - yz * yz) - xy * (xy * dz - yz * xz) + xz * (xy * yz - dy * xz));
  if (!(cosine > -0.5)) return {};
  return mean + 2.0 / 3.0 * sigma_v * lode_cosine(std::min(cosine, 1.0));
}

/// Squares and cubes of stresses beyond these leave the range of numbers.
constexpr double smallest_Pa = 1e-80, largest_Pa = 1e80;

/// A power of two that brings the largest size to about 1; 1 where there is no need, or nothing to scale.
double power_to_unit_size(double largest) {
  if (!(largest > 0) || !std::isfinite(largest) || (largest > smallest_Pa && largest < largest_Pa)) return 1;
  return std::ldexp(1.0, std::clamp(-std::ilogb(largest), -1000, 1000));
}

double power_to_unit_size(const Stress& s) {
  double largest = 0;
  for (const double component : s) largest = std::max(largest, std::abs(component));
  return power_to_unit_size(largest);
}

Stress scaled(Stress s, double factor) {
  for (double& component : s) component *= factor;
  return s;
}

void keep(NodalMaximum& maximum, std::size_t node, Eigen::Index instant, const Stress& stress,
          double value_Pa) {
  maximum.instant[node] = std::int32_t(instant);
  maximum.stress_Pa[node] = stress;
  maximum.value_Pa[node] = value_Pa;
}

/// The envelope of loads times `scale`, brought back.
Envelope unscaled(Envelope envelope, double scale) {
  for (NodalMaximum* maximum : {&envelope.von_mises, &envelope.principal}) {
    for (double& value : maximum->value_Pa) value /= scale;
    for (Stress& stress : maximum->stress_Pa) stress = scaled(stress, 1 / scale);
  }
  return envelope;
}

/// What each rank has found at its nodes, on all of them.
void complete(const fem::UnitResponses& responses, Envelope& envelope) {
  const auto* communicator = &responses.shared->communicator;
  for (NodalMaximum* maximum : {&envelope.von_mises, &envelope.principal}) {
    responses.complete(maximum->value_Pa);
    responses.complete(maximum->instant);
    if (!maximum->stress_Pa.empty())
      fem::complete(*communicator, maximum->stress_Pa.front().data(), 6 * maximum->stress_Pa.size());
  }
  responses.complete(envelope.effect_share);
}

/// Nodes that a thread takes at once.
constexpr std::size_t nodes_at_once = 64 * kernel::batch;

}  // namespace

double von_mises_Pa(const Stress& s) {
  if (const double scale = power_to_unit_size(s); scale != 1) return von_mises_Pa(scaled(s, scale)) / scale;
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

double largest_principal_Pa(const Stress& s) {
  if (const double scale = power_to_unit_size(s); scale != 1)
    return largest_principal_Pa(scaled(s, scale)) / scale;
  if (const auto value = principal_by_angle(s)) return *value;
  Eigen::Matrix3d tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

Stress own_stress_at(const fem::UnitResponses& responses, const ChannelHistory& loads, std::size_t node,
                     Eigen::Index instant) {
  return combine(responses.unit_stress_Pa(node), loads.values, instant);
}

Stress stress_at(const fem::UnitResponses& responses, const ChannelHistory& loads, std::size_t node,
                 Eigen::Index instant) {
  return combine(responses.stress_anywhere_Pa(node), loads.values, instant);
}

void check_channels(const ChannelHistory& loads, const fem::UnitResponses& responses) {
  bool same = loads.channels.size() == responses.channels.size() &&
              loads.values.rows() == Eigen::Index(loads.channels.size());
  for (std::size_t k = 0; same && k < loads.channels.size(); ++k)
    same = loads.channels[k].name == responses.channels[k];
  if (!same)
    throw std::invalid_argument("superposition: the load channels are not those of the unit responses");
}

EnvelopeWalk::EnvelopeWalk(const ChannelHistory& loads) : loads_(&loads) {
  if (const double scale = power_to_unit_size(loads.values.size() > 0 ? loads.values.abs().maxCoeff() : 0.0);
      scale != 1) {
    scale_ = scale;
    of_unit_size_ = loads;
    of_unit_size_.values *= scale;
    for (auto& part : of_unit_size_.by_effect) part *= scale;
  }
  factors_ = std::make_shared<const WalkedFactors>(this->loads().values);
}

const ChannelHistory& EnvelopeWalk::loads() const {
  return scale_ == 1 ? *loads_ : of_unit_size_;
}

Envelope EnvelopeWalk::of(const fem::UnitResponses& responses, int n_threads) const {
  const ChannelHistory& loads = this->loads();
  check_channels(loads, responses);
  const std::size_t n_nodes = responses.nodes.n, n_effects = loads.effects.size();
  Envelope result;
  for (NodalMaximum* maximum : {&result.von_mises, &result.principal}) {
    maximum->value_Pa.assign(n_nodes, 0.0);
    maximum->instant.assign(n_nodes, 0);
    maximum->stress_Pa.assign(n_nodes, Stress{});
  }
  result.effect_share.assign(n_nodes * n_effects, 0.0f);

  for_each_range(responses.n_rows(), nodes_at_once, n_threads, [&](std::size_t begin, std::size_t end) {
    BatchWalk walk(*factors_, responses);
    Eigen::VectorXd along(loads.values.rows());
    for (std::size_t first = begin; first < end; first += kernel::batch) {
      const std::size_t n = std::min(kernel::batch, end - first);
      const auto& found = walk.of(first, n);
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t node = responses.node_of_row(first + i);
        const double* unit = responses.unit_stress_Pa(node);
        const Eigen::Index of_mises = found[i].von_mises_instant, of_principal = found[i].principal_instant;
        const Stress stress = combine(unit, loads.values, of_mises);
        keep(result.von_mises, node, of_mises, stress, von_mises_Pa(stress));
        const Stress other = of_principal == of_mises ? stress : combine(unit, loads.values, of_principal);
        keep(result.principal, node, of_principal, other, largest_principal_Pa(other));
        find_shares(unit, loads, stress, result.von_mises.value_Pa[node], of_mises, along,
                    result.effect_share.data() + node * n_effects);
      }
    }
  });
  if (responses.shared) complete(responses, result);
  if (scale_ != 1) return unscaled(std::move(result), scale_);
  return result;
}

bool have_same_values(const ChannelHistory& a, const ChannelHistory& b) {
  const auto is_named_alike = [](const Channel& one, const Channel& other) { return one.name == other.name; };
  const auto is_equal = [](const Eigen::ArrayXXd& one, const Eigen::ArrayXXd& other) {
    return one.rows() == other.rows() && one.cols() == other.cols() && (one == other).all();
  };
  return std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), b.channels.end(),
                    is_named_alike) &&
         a.effects == b.effects && is_equal(a.values, b.values) &&
         std::equal(a.by_effect.begin(), a.by_effect.end(), b.by_effect.begin(), b.by_effect.end(), is_equal);
}

Envelope envelope(const ChannelHistory& loads, const fem::UnitResponses& responses, int n_threads) {
  return EnvelopeWalk(loads).of(responses, n_threads);
}

namespace {

std::array<double, 3> sum(const double* unit_m, const ChannelHistory& loads, Eigen::Index instant) {
  std::array<double, 3> displacement{};
  for (Eigen::Index k = 0; k < loads.values.rows(); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      displacement[c] += loads.values(k, instant) * unit_m[3 * std::size_t(k) + c];
  return displacement;
}

}  // namespace

std::array<double, 3> displacement_at(const fem::UnitResponses& responses, const ChannelHistory& loads,
                                      std::size_t node, Eigen::Index instant) {
  return sum(responses.displacement_anywhere_m(node), loads, instant);
}

std::array<double, 3> own_displacement_at(const fem::UnitResponses& responses, const ChannelHistory& loads,
                                          std::size_t node, Eigen::Index instant) {
  return sum(responses.unit_displacement_m(node), loads, instant);
}

std::vector<double> displacement_at(const fem::UnitResponses& responses, const ChannelHistory& loads,
                                    Eigen::Index instant) {
  std::vector<double> displacement(responses.nodes.n * 3, 0.0);
  for (std::size_t row = 0; row < responses.n_rows(); ++row) {
    const auto node = responses.node_of_row(row);
    const auto of_node = own_displacement_at(responses, loads, node, instant);
    std::copy(of_node.begin(), of_node.end(), displacement.begin() + std::ptrdiff_t(3 * node));
  }
  responses.complete(displacement);
  return displacement;
}

}  // namespace pipelines
