// Laws that every train obeys: 1000 trees of shafts, belts and gears, fixed seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "kinetics/torsion_chain/reduced.h"
#include "tests/unit/kinetics/torsion/trains.h"

namespace {

using Eigen::Index;
using kinetics::DriveTrain;
using kinetics::ForcedResponse;

const std::complex<double> i_unit(0, 1);

kinetics::DriveTrain draw(std::mt19937& generator) {
  return trains::random(generator, {});
}

/// @param scale  what b is a small remainder of, if it is: round-off is relative to that
double difference(const Eigen::ArrayXcd& a, const Eigen::ArrayXcd& b, double scale = 1e-300) {
  if (a.size() == 0) return 0;
  return (a - b).abs().maxCoeff() / std::max(b.abs().maxCoeff(), scale);
}

/// Largest excitation torque, on the scale of its own shaft.
double largest_excitation(const DriveTrain& train) {
  double largest = 0;
  for (const auto& x : train.excitations)
    largest = std::max(largest, std::abs(x.harmonics.at(0).amplitude_Nm));
  return largest;
}

/// Torque of the excitations on an inertia at a frequency.
std::complex<double> excitation(const DriveTrain& train, Index i, double w) {
  std::complex<double> sum = 0;
  for (const auto& x : train.excitations)
    for (const auto& h : x.harmonics)
      if (x.inertia == train.inertias[i].name && *h.frequency_rad_s == w)
        sum += std::polar(std::abs(h.amplitude_Nm), -h.phase_rad);
  return sum;
}

}  // namespace

TEST(TrainRandom, ReducingToAnyShaftGivesTheSamePhysics) {
  std::mt19937 generator(1);
  double worst_frequency = 0, worst_torque = 0, worst_angle = 0;
  for (int n = 0; n < 1000; ++n) {
    auto train = draw(generator);
    const auto here = forced_response(train);
    const auto modes = natural_modes(train);
    const auto u = kinetics::torsion::reduce(train).ratio;
    const Index other = static_cast<Index>(train.inertias.size()) - 1;
    train.reference_shaft = train.inertias[other].shaft;
    const auto there = forced_response(train);
    const auto modes_there = natural_modes(train);
    worst_frequency =
        std::max(worst_frequency, difference(modes_there.frequency_rad_s.cast<std::complex<double>>(),
                                             modes.frequency_rad_s.cast<std::complex<double>>()));
    for (std::size_t k = 0; k < here.harmonics.size(); ++k) {
      worst_torque = std::max(
          worst_torque,
          difference(there.harmonics[k].torque_Nm, here.harmonics[k].torque_Nm, largest_excitation(train)));
      worst_angle =
          std::max(worst_angle, difference(there.harmonics[k].angle_rad, here.harmonics[k].angle_rad));
      const Eigen::ArrayXcd rescaled = here.harmonics[k].reduced_torque_Nm / std::complex<double>(u[other]);
      const double scale = largest_excitation(train) * (u / u[other]).abs().maxCoeff();
      EXPECT_LT(difference(there.harmonics[k].reduced_torque_Nm, rescaled, scale), 1e-12);
    }
  }
  std::cout << "worst deviation: frequencies " << worst_frequency << ", torques " << worst_torque
            << ", angles " << worst_angle << '\n';
  EXPECT_LT(worst_frequency, 1e-12);
  EXPECT_LT(worst_torque, 1e-12);
  EXPECT_LT(worst_angle, 1e-12);
}

// Written out from the definition in the header, element by element, without the reduction.
TEST(TrainRandom, TorquesFollowFromAnglesAndBalanceEveryInertia) {
  std::mt19937 generator(2);
  double worst_balance = 0, worst_law = 0;
  for (int n = 0; n < 1000; ++n) {
    const auto train = draw(generator);
    for (const auto& h : forced_response(train).harmonics) {
      const double w = h.frequency_rad_s;
      std::vector<std::complex<double>> sum(train.inertias.size());
      std::vector<double> size(train.inertias.size());
      for (std::size_t i = 0; i < sum.size(); ++i) {
        const auto& inertia = train.inertias[i];
        const auto add = [&](std::complex<double> torque) { sum[i] += torque, size[i] += std::abs(torque); };
        add(excitation(train, Index(i), w));
        add(w * w * inertia.inertia_kg_m2 * h.angle_rad[i]);
        add(-i_unit * w * inertia.damping_N_m_s * h.angle_rad[i]);
        for (std::size_t e = 0; e < train.elements.size(); ++e) {
          if (train.elements[e].first == inertia.name) add(-h.torque_Nm[e]);
          if (train.elements[e].second == inertia.name) add(h.torque_Nm[e] / train.elements[e].ratio);
        }
      }
      const double largest = *std::max_element(size.begin(), size.end());
      for (std::size_t i = 0; i < sum.size(); ++i)
        worst_balance = std::max(worst_balance, std::abs(sum[i]) / largest);
      for (std::size_t e = 0; e < train.elements.size(); ++e) {
        const auto& element = train.elements[e];
        const auto at = [&](const std::string& name) {
          for (std::size_t i = 0; i < train.inertias.size(); ++i)
            if (train.inertias[i].name == name) return i;
          return std::size_t{0};
        };
        const auto a = h.angle_rad[at(element.first)], b = h.angle_rad[at(element.second)] / element.ratio;
        if (element.rigid) {
          EXPECT_LT(std::abs(a - b), 1e-14 * (std::abs(a) + std::abs(b)));
          continue;
        }
        const bool on_second = element.kind != kinetics::ElementKind::shaft &&
                               element.stiffness_on == train.inertias[at(element.second)].shaft;
        const double to_first = on_second ? element.ratio * element.ratio : 1;
        const auto Z = to_first * (*element.stiffness_N_m_rad * (1.0 + i_unit * element.loss_factor) +
                                   i_unit * w * element.damping_N_m_s);
        worst_law = std::max(
            worst_law, std::abs(Z * (a - b) - h.torque_Nm[e]) / (std::abs(Z) * (std::abs(a) + std::abs(b))));
      }
    }
  }
  std::cout << "worst imbalance " << worst_balance << ", worst deviation of the torque law " << worst_law
            << '\n';
  EXPECT_LT(worst_balance, 1e-12);
  EXPECT_LT(worst_law, 1e-13);
}

// Mean power: that of the excitations against what dampers take, over the sum of sizes.
TEST(TrainRandom, ExcitationWorkIsDissipated) {
  std::mt19937 generator(3);
  double worst = 0, least_dissipated = 1;
  for (int n = 0; n < 1000; ++n) {
    auto train = draw(generator);
    train.inertias[0].damping_N_m_s += 0.1;
    for (const auto& h : forced_response(train).harmonics) {
      const double w = h.frequency_rad_s;
      const auto power = [](std::complex<double> torque, std::complex<double> speed) {
        return 0.5 * std::real(torque * std::conj(speed));
      };
      double in_W = 0, out_W = 0, size_W = 0;
      for (std::size_t i = 0; i < train.inertias.size(); ++i) {
        const auto speed = i_unit * w * h.angle_rad[i];
        const auto torque = excitation(train, Index(i), w);
        in_W += power(torque, speed);
        size_W += 0.5 * std::abs(torque * speed);
        out_W += 0.5 * train.inertias[i].damping_N_m_s * std::norm(speed);
      }
      for (std::size_t e = 0; e < train.elements.size(); ++e) {
        const auto& element = train.elements[e];
        if (element.rigid) continue;
        std::size_t second = 0;
        for (std::size_t i = 0; i < train.inertias.size(); ++i) {
          if (train.inertias[i].name == element.second) second = i;
        }
        const bool on_second = element.kind != kinetics::ElementKind::shaft &&
                               element.stiffness_on == train.inertias[second].shaft;
        const double to_first = on_second ? element.ratio * element.ratio : 1;
        const std::complex<double> Z(
            *element.stiffness_N_m_rad,
            *element.stiffness_N_m_rad * element.loss_factor + w * element.damping_N_m_s);
        const auto twist = h.torque_Nm[e] / (to_first * Z);
        out_W += 0.5 * w * to_first * Z.imag() * std::norm(twist);
      }
      worst = std::max(worst, std::abs(in_W - out_W) / std::max(size_W, out_W));
      least_dissipated = std::min(least_dissipated, out_W / size_W);
    }
  }
  std::cout << "worst power imbalance " << worst << ", least share dissipated " << least_dissipated << '\n';
  EXPECT_LT(worst, 1e-12);
}
