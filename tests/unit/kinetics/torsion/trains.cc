#include "tests/unit/kinetics/torsion/trains.h"

#include <cmath>
#include <map>

namespace trains {

using kinetics::DriveTrain;
using kinetics::ElementKind;
using kinetics::TrainElement;

DriveTrain chain(const std::vector<double>& inertia_kg_m2, const std::vector<double>& stiffness_N_m_rad) {
  DriveTrain train;
  for (std::size_t i = 0; i < inertia_kg_m2.size(); ++i)
    train.inertias.push_back({"J" + std::to_string(i), "s", inertia_kg_m2[i], 0, false});
  for (std::size_t e = 0; e < stiffness_N_m_rad.size(); ++e) {
    TrainElement element;
    element.name = "C" + std::to_string(e);
    element.first = train.inertias[e].name;
    element.second = train.inertias[e + 1].name;
    element.stiffness_N_m_rad = stiffness_N_m_rad[e];
    train.elements.push_back(element);
  }
  train.reference_shaft = "s";
  train.reference_speed_rad_s = 100;
  return train;
}

kinetics::TrainExcitation harmonic(const std::string& inertia, double amplitude_Nm, double frequency_rad_s,
                                   double phase_rad) {
  kinetics::TrainExcitation x;
  x.name = "torque_on_" + inertia;
  x.inertia = inertia;
  x.harmonics.push_back({amplitude_Nm, frequency_rad_s, std::nullopt, "", phase_rad});
  return x;
}

DriveTrain mok150(const std::string& belt_on, double half_shaft_N_m_rad) {
  const double pi = std::acos(-1.0);
  DriveTrain train = chain({1.302315e-3, 3.86275e-4, 2.460168e-2, 7.05e-5, 0.2099853},
                           {19127.1, 4096.91, half_shaft_N_m_rad, half_shaft_N_m_rad});
  const char* names[] = {"rotor", "driving_pulley", "driven_pulley", "working_shaft", "disc"};
  const char* elements[] = {"motor_shaft", "belt", "upper_half", "lower_half"};
  for (int i = 0; i < 5; ++i) {
    train.inertias[i].name = names[i];
    train.inertias[i].shaft = i < 2 ? "motor" : "working";
  }
  for (int e = 0; e < 4; ++e) {
    train.elements[e].name = elements[e];
    train.elements[e].first = names[e];
    train.elements[e].second = names[e + 1];
  }
  train.elements[0].diameter_m = 0.019;
  train.elements[1].kind = ElementKind::belt;
  train.elements[1].ratio = 0.375;
  train.elements[1].stiffness_on = belt_on;
  train.elements[2].diameter_m = train.elements[3].diameter_m = 0.030;
  train.reference_shaft = "motor";
  train.reference_speed_rad_s = 2 * pi * 1360 / 60;
  train.excitations = {harmonic("rotor", 3.744, 100 * pi), harmonic("disc", -9.6, 100 * pi)};
  return train;
}

DriveTrain random(std::mt19937& generator, const RandomTrain& kind) {
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(generator);
  };
  const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(generator); };
  const auto spread = [&] { return std::pow(10, uniform(-kind.decades / 2, kind.decades / 2)); };
  DriveTrain train;
  const int n = 2 + below(kind.most_inertias - 1);
  for (int i = 0; i < n; ++i) {
    const double J = spread();
    train.inertias.push_back(
        {"J" + std::to_string(i), "s0", J, kind.damped && below(2) ? J * uniform(1, 5) : 0.0, false});
  }
  for (int i = 1; i < n; ++i) {
    const int parent = below(i);
    TrainElement e;
    e.name = "E" + std::to_string(i);
    const bool forward = below(2) == 0;
    e.first = train.inertias[forward ? parent : i].name;
    e.second = train.inertias[forward ? i : parent].name;
    e.kind = static_cast<ElementKind>(below(3));
    train.inertias[i].shaft = train.inertias[parent].shaft;
    if (e.kind != ElementKind::shaft) {
      e.ratio = uniform(0.3, 3) * (e.kind == ElementKind::gear && below(2) ? -1 : 1);
      train.inertias[i].shaft = "s" + std::to_string(i);
      e.stiffness_on = train.inertias[below(2) ? parent : i].shaft;
      e.rigid = kind.rigid && below(3) == 0;
    }
    if (!e.rigid) {
      e.stiffness_N_m_rad = 1e3 * spread();
      if (kind.damped) {
        e.damping_N_m_s = *e.stiffness_N_m_rad * uniform(1e-3, 5e-3);
        e.loss_factor = below(2) ? uniform(0.01, 0.2) : 0.0;
      }
    }
    train.elements.push_back(e);
  }
  train.reference_shaft = "s0";
  train.reference_speed_rad_s = 10;
  const int a = below(n), b = below(n);
  train.excitations = {harmonic(train.inertias[a].name, uniform(1, 10), uniform(1, 60), uniform(-3, 3))};
  if (b != a) train.excitations.push_back(harmonic(train.inertias[b].name, uniform(1, 10), uniform(1, 60)));
  return train;
}

std::vector<long double> counted_frequencies(const DriveTrain& train) {
  using Real = long double;
  const std::size_t n = train.inertias.size();
  std::map<std::string, std::size_t> at;
  for (std::size_t i = 0; i < n; ++i) at[train.inertias[i].name] = i;
  // Ratios by repeated relaxation: every element fixes the ratio of its second inertia, or of its first.
  std::vector<Real> u(n, 0);
  u[0] = 1;
  for (std::size_t round = 0; round < n; ++round)
    for (const auto& e : train.elements) {
      if (u[at[e.first]] != 0)
        u[at[e.second]] = u[at[e.first]] * Real(e.ratio);
      else if (u[at[e.second]] != 0)
        u[at[e.first]] = u[at[e.second]] / Real(e.ratio);
    }
  struct Branch {
    std::size_t child;
    Real C;
  };
  std::vector<std::vector<Branch>> children(n);
  std::vector<std::size_t> order{0};
  std::vector<bool> seen(n, false);
  seen[0] = true;
  for (std::size_t k = 0; k < order.size(); ++k)
    for (const auto& e : train.elements) {
      const std::size_t a = at[e.first], b = at[e.second];
      if (a != order[k] && b != order[k]) continue;
      const std::size_t next = a == order[k] ? b : a;
      if (seen[next]) continue;
      seen[next] = true;
      order.push_back(next);
      const bool on_second = e.kind != ElementKind::shaft && e.stiffness_on == train.inertias[b].shaft;
      const Real ratio = u[on_second ? b : a];
      children[order[k]].push_back({next, Real(*e.stiffness_N_m_rad) * ratio * ratio});
    }
  const auto n_below = [&](Real w) {
    std::size_t count = 0;
    std::vector<Real> seen_from_below(n);
    for (std::size_t k = n; k-- > 0;) {
      const std::size_t i = order[k];
      Real G = -w * w * Real(train.inertias[i].inertia_kg_m2) * u[i] * u[i];
      for (const Branch& branch : children[i]) {
        const Real pivot = branch.C + seen_from_below[branch.child];
        if (pivot < 0) ++count;
        G += branch.C * seen_from_below[branch.child] / pivot;
      }
      seen_from_below[i] = G;
      if (k == 0 && G < 0) ++count;
    }
    return count;
  };
  std::vector<Real> frequencies{0};
  for (std::size_t k = 1; k < n; ++k) {
    Real low = 1e-12L, high = 1e14L;
    while (high / low > 1 + 1e-17L) {
      const Real middle = std::sqrt(low) * std::sqrt(high);
      if (middle <= low || middle >= high) break;
      (n_below(middle) > k ? high : low) = middle;
    }
    frequencies.push_back(low);
  }
  return frequencies;
}

}  // namespace trains
