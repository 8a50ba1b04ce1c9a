#include "pipelines/superposition/superposition.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>

#include "pipelines/superposition/superposition_kernel.h"

namespace pipelines {
namespace {

/// Residuals of a channel, relative to itself, that count as rounding.
constexpr double dependent = 1e-14;

/// cos(acos(c) / 3) = cos(2/3 acos(s)) with s = sqrt((1 + c) / 2) is analytic but at s = -1: its Chebyshev
/// series over s in [0, 1], t = 2 s - 1, falls by six with each term and is 1e-15 exact; in powers of t,
/// whose coefficients fall as well, nothing cancels.
std::array<double, kernel::n_lode_terms> lode_polynomial() {
  constexpr std::size_t n = kernel::n_lode_terms, n_points = 64;
  std::array<double, n> powers{}, before{}, chebyshev{};  // of T_(k-1) and of T_k
  chebyshev[0] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    double coefficient = 0;
    for (std::size_t j = 0; j < n_points; ++j) {
      const double angle = M_PI * (double(j) + 0.5) / double(n_points);
      coefficient +=
          std::cos(2.0 / 3.0 * std::acos(0.5 + 0.5 * std::cos(angle))) * std::cos(double(k) * angle);
    }
    coefficient *= (k == 0 ? 1.0 : 2.0) / double(n_points);
    std::array<double, n> next{};  // T_(k+1) = 2 t T_k - T_(k-1), T_1 = t
    for (std::size_t i = 0; i < n; ++i) {
      powers[i] += coefficient * chebyshev[i];
      next[i] = (i > 0 ? (k == 0 ? 1.0 : 2.0) * chebyshev[i - 1] : 0.0) - before[i];
    }
    before = chebyshev;
    chebyshev = next;
  }
  return powers;
}

/// The unit stresses of a node, K x 6.
const double* unit_stress(const fem::UnitResponses& responses, std::size_t node) {
  return responses.stress_Pa.data() + node * responses.channels.size() * 6;
}

Stress combine(const double* unit, const Eigen::ArrayXXd& factors, Eigen::Index instant) {
  Stress s{};
  for (Eigen::Index k = 0; k < factors.rows(); ++k)
    for (std::size_t c = 0; c < 6; ++c) s[c] += factors(k, instant) * unit[6 * std::size_t(k) + c];
  return s;
}

/// Shares of the effects in the von Mises stress of a node at one instant.
void find_shares(const double* unit, const ChannelHistory& loads, const Stress& stress, Eigen::Index instant,
                 double* shares) {
  const std::size_t n_effects = loads.effects.size();
  const double sigma_v = von_mises_Pa(stress);
  const double mean = (stress[0] + stress[1] + stress[2]) / 3;
  const Stress deviator{stress[0] - mean, stress[1] - mean, stress[2] - mean,
                        stress[3],        stress[4],        stress[5]};
  for (std::size_t e = 0; e < n_effects; ++e) {
    if (sigma_v == 0) {
      shares[e] = 0;
      continue;
    }
    const Stress part = combine(unit, loads.by_effect[e], instant);
    double product = 0;
    for (std::size_t c = 0; c < 6; ++c) product += (c < 3 ? 1 : 2) * part[c] * deviator[c];
    shares[e] = 1.5 * product / (sigma_v * sigma_v);
  }
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

/// The envelope of loads times `scale`, brought back.
Envelope unscaled(Envelope envelope, double scale) {
  for (NodalMaximum* maximum : {&envelope.von_mises, &envelope.principal}) {
    for (double& value : maximum->value_Pa) value /= scale;
    for (Stress& stress : maximum->stress_Pa) stress = scaled(stress, 1 / scale);
  }
  return envelope;
}

}  // namespace

double von_mises_Pa(const Stress& s) {
  if (const double scale = power_to_unit_size(s); scale != 1) return von_mises_Pa(scaled(s, scale)) / scale;
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

double largest_principal_Pa(const Stress& s) {
  if (const double scale = power_to_unit_size(s); scale != 1)
    return largest_principal_Pa(scaled(s, scale)) / scale;
  Eigen::Matrix3d tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

Stress stress_at(const fem::UnitResponses& responses, const ChannelHistory& loads, std::size_t node,
                 Eigen::Index instant) {
  return combine(unit_stress(responses, node), loads.values, instant);
}

void check_channels(const ChannelHistory& loads, const fem::UnitResponses& responses) {
  bool same = loads.channels.size() == responses.channels.size() &&
              loads.values.rows() == Eigen::Index(loads.channels.size());
  for (std::size_t k = 0; same && k < loads.channels.size(); ++k)
    same = loads.channels[k].name == responses.channels[k];
  if (!same)
    throw std::invalid_argument("superposition: the load channels are not those of the unit responses");
}

std::vector<double> blocked_factors(const Eigen::ArrayXXd& values,
                                    const std::vector<Eigen::Index>& channels) {
  static_assert(factors_block == kernel::block);
  const auto n_instants = std::size_t(values.cols()), n_walked = channels.size();
  const std::size_t n_blocks = (n_instants + kernel::block - 1) / kernel::block;
  std::vector<double> factors(n_blocks * n_walked * kernel::block);
  for (std::size_t i = 0; i < n_blocks * kernel::block; ++i)
    for (std::size_t k = 0; k < n_walked; ++k)
      factors[((i / kernel::block) * n_walked + k) * kernel::block + i % kernel::block] =
          values(channels[k], Eigen::Index(std::min(i, n_instants - 1)));
  return factors;
}

IndependentChannels independent_channels(const Eigen::ArrayXXd& values) {
  const Eigen::Index n = values.rows(), most = std::min(n, values.cols());
  IndependentChannels result;
  if (!values.allFinite()) {  // nothing follows from what is no number
    result.of_channel.setIdentity(n, n);
    for (Eigen::Index k = 0; k < n; ++k) result.channels.push_back(k);
    return result;
  }
  const Eigen::ArrayXd sizes = values.matrix().rowwise().norm();
  const Eigen::ArrayXd scale = (sizes > 0).select(sizes.inverse(), 0.0);
  const Eigen::MatrixXd instants = (values.colwise() * scale).matrix().transpose();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(instants);
  const auto& order = qr.colsPermutation().indices();
  Eigen::Index rank = 0;
  while (rank < most && std::abs(qr.matrixQR()(rank, rank)) > dependent) ++rank;
  result.of_channel = Eigen::MatrixXd::Zero(n, rank);
  const Eigen::MatrixXd rest = qr.matrixQR()
                                   .topLeftCorner(rank, rank)
                                   .triangularView<Eigen::Upper>()
                                   .solve(qr.matrixQR().topRightCorner(rank, n - rank));
  for (Eigen::Index i = 0; i < rank; ++i) {
    result.channels.push_back(order[i]);
    result.of_channel(order[i], i) = 1;
    for (Eigen::Index k = 0; k < n - rank; ++k)
      if (sizes[order[rank + k]] > 0)
        result.of_channel(order[rank + k], i) = rest(i, k) * sizes[order[rank + k]] / sizes[order[i]];
  }
  return result;
}

EnvelopeWalk::EnvelopeWalk(const ChannelHistory& loads) : loads_(&loads) {
  if (const double scale = power_to_unit_size(loads.values.size() > 0 ? loads.values.abs().maxCoeff() : 0.0);
      scale != 1) {
    scale_ = scale;
    of_unit_size_ = loads;
    of_unit_size_.values *= scale;
    for (auto& part : of_unit_size_.by_effect) part *= scale;
  }
  const auto& values = this->loads().values;
  independent_ = independent_channels(values);
  n_blocks_ = (std::size_t(values.cols()) + kernel::block - 1) / kernel::block;
  factors_ = blocked_factors(values, independent_.channels);
}

const ChannelHistory& EnvelopeWalk::loads() const {
  return scale_ == 1 ? *loads_ : of_unit_size_;
}

Envelope EnvelopeWalk::of(const fem::UnitResponses& responses, int n_threads) const {
  const ChannelHistory& loads = this->loads();
  check_channels(loads, responses);
  const std::size_t n_nodes = responses.nodes.n, n_effects = loads.effects.size();
  const std::size_t n_walked = independent_.channels.size();
  Envelope result;
  for (NodalMaximum* maximum : {&result.von_mises, &result.principal}) {
    maximum->value_Pa.assign(n_nodes, 0.0);
    maximum->instant.assign(n_nodes, 0);
    maximum->stress_Pa.assign(n_nodes, Stress{});
  }
  result.effect_share.assign(n_nodes * n_effects, 0.0);

  kernel::Walk& walk = kernel::walk_for_this_machine();
  static const auto lode = lode_polynomial();
  const auto work = [&](std::size_t begin, std::size_t end) {
    std::array<kernel::NodeMaximum, kernel::batch> found;
    std::vector<double> walked(kernel::batch * n_walked * 6);
    for (std::size_t first = begin; first < end; first += kernel::batch) {
      const std::size_t n = std::min(kernel::batch, end - first);
      for (std::size_t i = 0; i < n; ++i) {
        using UnitStress = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
        Eigen::Map<UnitStress>(walked.data() + i * n_walked * 6, Eigen::Index(n_walked), 6).noalias() =
            independent_.of_channel.transpose() *
            Eigen::Map<const UnitStress>(unit_stress(responses, first + i), independent_.of_channel.rows(),
                                         6);
      }
      walk(walked.data(), n, n_walked, factors_.data(), n_blocks_, lode.data(), found.data());
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t node = first + i;
        const double* unit = unit_stress(responses, node);
        const auto keep = [&](NodalMaximum& maximum, Eigen::Index instant, auto&& measure) {
          const Stress stress = combine(unit, loads.values, instant);
          maximum.instant[node] = std::int32_t(instant);
          maximum.stress_Pa[node] = stress;
          maximum.value_Pa[node] = measure(stress);
        };
        keep(result.von_mises, found[i].von_mises_instant, von_mises_Pa);
        keep(result.principal, found[i].principal_instant, largest_principal_Pa);
        find_shares(unit, loads, result.von_mises.stress_Pa[node], found[i].von_mises_instant,
                    result.effect_share.data() + node * n_effects);
      }
    }
  };
  // Nodes are independent, so the split between threads cannot change a bit of the result.
  const std::size_t n_workers = std::size_t(std::max(1, n_threads));
  std::vector<std::thread> threads;
  for (std::size_t w = 1; w < n_workers; ++w)
    threads.emplace_back(work, n_nodes * w / n_workers, n_nodes * (w + 1) / n_workers);
  work(0, n_nodes / n_workers);
  for (auto& thread : threads) thread.join();
  return scale_ == 1 ? result : unscaled(std::move(result), scale_);
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

std::vector<double> displacement_at(const fem::UnitResponses& responses, const ChannelHistory& loads,
                                    Eigen::Index instant) {
  const std::size_t n_channels = responses.channels.size();
  std::vector<double> displacement(responses.nodes.n * 3, 0.0);
  for (std::size_t node = 0; node < responses.nodes.n; ++node)
    for (std::size_t k = 0; k < n_channels; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        displacement[3 * node + c] += loads.values(Eigen::Index(k), instant) *
                                      responses.displacement_m[(node * n_channels + k) * 3 + c];
  return displacement;
}

}  // namespace pipelines
