/// What is known at a point of the pressure on a port: the stress that each harmonic brings, and what those
/// that were not solved may bring.
///
/// With the force F and a pattern's coefficients c_n the stress is F times the sum of c_n S_n. The closed
/// form of c_n is known for all n, whether it vanishes or not; S_n, the stress per unit of a coefficient, is
/// known of the harmonics that were solved. It falls with n: bending of a thin ring as 1/(n^2 - 1), stress at
/// a distance d from the pressure as exp(-n d / R), at the surface itself not at all.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "pipelines/loads/channels/load_collector.h"

namespace pipelines {

/// Channels of a port's harmonics.
struct SolvedPressure {
  PressureModel model;
  double force_N = 0;  ///< largest over the instants
  struct Harmonic {
    double unit = 1;                    ///< coefficient of the unit loads
    std::vector<std::size_t> channels;  ///< one or two, of the loads
  };
  std::map<int, Harmonic> harmonics;
};

/// Solved pressures by port; those of ports that a force loads alone.
std::map<std::string, SolvedPressure> solved_pressures(const BodyLoads& loads);

/// What share of the largest loads of a port others have, the largest of its channels: 1 for the loads
/// themselves, 0 for half a change in which the port's loads stay.
/// @param values  channels x instants, in the order of the loads
double share_of_loads(const BodyLoads& loads, const std::string& port, const Eigen::ArrayXXd& values);

/// |S_n| at a point for all n >= 2: of the harmonics that were solved the von Mises stress of both phases
/// together; of one between two of them the larger one; above the last one A / (n^2 - 1) + B through the last
/// two, component by component: a ring's bending, and what the pressure does right below itself, which may
/// take from each other in the von Mises stress of the harmonics that were solved and not above. That bounds
/// what falls with distance from the seat, too. With one of them alone it stays, with the mean pressure alone
/// it is that of a ring (PressureModel::ring_factor).
class StressByHarmonic {
public:
  /// @param unit_Pa  stress of the unit loads at the point
  StressByHarmonic(const SolvedPressure& pressure, const std::vector<std::array<double, 6>>& unit_Pa);
  bool is_solved(int n) const { return solved_Pa_.count(n) > 0; }
  /// Stress per unit of the coefficient of that harmonic, under the largest force [Pa].
  double at(int n) const;
  /// The largest harmonic that was solved; 1: none above the force.
  int last() const { return solved_Pa_.empty() ? 1 : solved_Pa_.rbegin()->first; }
  /// A and B, the stresses above the last harmonic that was solved.
  double falling_Pa() const { return falling_Pa_; }
  double level_Pa() const { return level_Pa_; }

private:
  std::map<int, double> solved_Pa_;  // n >= 2
  double falling_Pa_ = 0, level_Pa_ = 0;
};

/// Bounds the stress of a pattern's harmonics from `first` on. Above the last solved one it is the sum of
/// |c_n| A / (n^2 - 1), and B times the smaller of the sum of |c_n| and the largest pressure that these
/// harmonics make round the seat: that is finite where a pattern jumps and the sum is not.
double harmonics_from_Pa(const StressByHarmonic& stress, const PressurePattern& pattern, int first);

/// What harmonics that were not solved would bring to a point if the port had that pattern [Pa].
double unsolved_Pa(const StressByHarmonic& stress, const PressurePattern& pattern);

}  // namespace pipelines
