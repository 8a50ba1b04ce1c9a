#include "kinetics/vibratory/balance.h"

#include <algorithm>

#include "kinetics/vibratory/books.h"
#include "kinetics/vibratory/pitch.h"

namespace kinetics::vibratory {
namespace {

using Eigen::Array2Xd;
using Eigen::Array3d;
using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index block_size = 256;

/// Books the placed forces of the effects over one block of instants.
class BlockBooking {
public:
  BlockBooking(const VibratoryMill& mill, Index first, Index count, Books& books)
      : mill_(mill),
        at_(part_of(books.motion, first, count)),
        first_(first),
        translation_m_(translation(mill, at_)),
        velocity_m_s_(translation_velocity(mill, at_)),
        books_(books) {}

  void book(std::size_t index, const NamedEffect& effect) {
    for (const PlacedForce& placed : effect.evaluate(at_)) {
      const Array2Xd arm_m = position(mill_, placed, at_);
      if (placed.place == Place::debalance) {
        book_on_shaft(index, placed, arm_m);
      } else {
        book_on_chamber(index, placed, arm_m);
        const bool charge = placed.place == Place::charge_centre || placed.place == Place::chamber_centre;
        if (charge) books_.charge_power_W.segment(first_, at_.size()) += taken_W(placed, arm_m);
        if (effect.name == "spring_damping")
          books_.damping_power_W.segment(first_, at_.size()) += taken_W(placed, arm_m);
      }
    }
    books_.close(index, first_, at_.size());
  }

  /// The joints' own forces, so that what is left of the sums is what does not close.
  void book_joints() {
    const auto total = [&](RoleIndex role) {
      return books_.roles[role].total.middleCols(first_, at_.size());
    };
    const Array2Xd at_pivot_m = Array2Xd::Zero(2, at_.size());
    books_.chamber.add(first_, at_pivot_m, total(housing_bore).topRows<2>());
    books_.shaft.add(first_, translation_m_, total(eccentric).topRows<2>());
    books_.shaft.add(first_, at_pivot_m, total(frame_bearings).topRows<2>());
    books_.shaft.add_couple(first_, total(drive).row(2).transpose());
  }

private:
  template <class Load>
  void post(std::size_t role, std::size_t effect, const Load& load) {
    books_.post(role, effect, first_, at_.size(), load);
  }

  /// +- the force, without torque.
  void post_force(std::size_t role, std::size_t effect, double sign, const Array2Xd& force_N) {
    post(role, effect, [&](Index i) { return Array3d(sign * force_N(0, i), sign * force_N(1, i), 0); });
  }

  void book_on_shaft(std::size_t effect, const PlacedForce& placed, const Array2Xd& arm_m) {
    const Array2Xd& F_N = placed.force_N;
    const ArrayXd moment_Nm = cross(arm_m, F_N);
    post(debalance, effect, [&](Index i) { return Array3d(F_N(0, i), F_N(1, i), moment_Nm[i]); });
    post_force(frame_bearings, effect, -1, F_N);
    post(drive, effect, [&](Index i) { return Array3d(0, 0, -moment_Nm[i]); });
    books_.shaft.add(first_, arm_m, F_N);
  }

  void book_on_chamber(std::size_t effect, const PlacedForce& placed, const Array2Xd& arm_m) {
    const Array2Xd& F_N = placed.force_N;
    const ArrayXd moment_Nm = cross(translation_m_, F_N);  // of the force -B = F on the shaft, about E
    post_force(eccentric, effect, 1, F_N);
    post_force(housing_bore, effect, -1, F_N);
    post_force(frame_bearings, effect, -1, F_N);
    post(drive, effect, [&](Index i) { return Array3d(0, 0, -moment_Nm[i]); });
    book_at_port(effect, placed);
    books_.chamber.add(first_, arm_m, F_N);
    if (placed.couple_Nm.size() > 0) {
      books_.chamber.add_couple(first_, placed.couple_Nm);
      books_.couple_Nm.segment(first_, at_.size()) += placed.couple_Nm;
    }
  }

  /// The load that reaches the chamber itself, at its own port.
  void book_at_port(std::size_t effect, const PlacedForce& placed) {
    const Array2Xd& F_N = placed.force_N;
    if (placed.place == Place::charge_centre) {
      const ArrayXd moment_Nm = mill_.charge_offset_m * cross(at_.along_chi, F_N);
      post(inner_wall, effect, [&](Index i) { return Array3d(F_N(0, i), F_N(1, i), moment_Nm[i]); });
    } else if (placed.place == Place::chamber_centre) {
      post_force(inner_wall, effect, 1, F_N);
    } else if (placed.place == Place::spring_foot) {
      post_force(first_spring_foot + placed.foot, effect, 1, F_N);
    }
  }

  /// Power that a force takes from the chamber.
  ArrayXd taken_W(const PlacedForce& placed, const Array2Xd& arm_m) const {
    return -dot(placed.force_N, velocity_m_s_ + scaled(at_.theta_rad_s, turned(arm_m)));
  }

  const VibratoryMill& mill_;
  const Instants at_;
  const Index first_;
  const Array2Xd translation_m_, velocity_m_s_;
  Books& books_;
};

}  // namespace

LoadHistory empty_history(const VibratoryMill& mill, const std::vector<NamedEffect>& effects,
                          const ArrayXd& time_s, const Instants& motion) {
  LoadHistory history;
  history.machine = "vibratory_mill";
  history.convention = mill.convention == Convention::published ? "published" : "consistent";
  for (const NamedEffect& effect : effects) history.effects.push_back(effect.name);
  history.time_s = time_s;
  history.phi_rad = motion.phi_rad;
  history.speed_rad_s = motion.speed_rad_s;
  history.acceleration_rad_s2 = motion.acceleration_rad_s2;
  return history;
}

ArrayXd times_s(const VibratoryMill& mill, const Instants& steady) {
  return (steady.phi_rad - mill.initial_angle_rad) / mill.speed_rad_s;
}

void balance_over(const VibratoryMill& mill, const std::vector<NamedEffect>& effects, const Instants& motion,
                  LoadHistory& history) {
  Books books(mill, effects.size(), motion);
  for (Index first = 0; first < motion.size(); first += block_size) {
    BlockBooking block(mill, first, std::min(block_size, motion.size() - first), books);
    for (std::size_t i = 0; i < effects.size(); ++i) block.book(i, effects[i]);
    block.book_joints();
  }
  write_results(mill, effects, books, history);
}

LoadHistory balance(const VibratoryMill& mill, const std::vector<NamedEffect>& effects,
                    const TimeGrid& grid) {
  Instants motion = steady_instants(mill, grid, 0, Index(grid.turns) * grid.instants_per_turn);
  if (contains(effects, "pitch")) solve_pitch(mill, effects).apply(motion);
  LoadHistory history = empty_history(mill, effects, times_s(mill, motion), motion);
  balance_over(mill, effects, motion, history);
  return history;
}

}  // namespace kinetics::vibratory
