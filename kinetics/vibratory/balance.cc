#include "kinetics/vibratory/balance.h"

#include <algorithm>

#include "kinetics/vibratory/pitch.h"
#include "kinetics/vibratory_effects/effect_sums.h"

namespace kinetics::vibratory {
namespace {

using Eigen::Array2Xd;
using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index block_size = 256;

/// Adds the placed forces of the effects over one block of instants.
class BlockSums {
public:
  BlockSums(const VibratoryMill& mill, Index first, Index count, EffectSums& sums)
      : mill_(mill),
        at_(part_of(sums.motion, first, count)),
        first_(first),
        n_(count),
        translation_m_(translation(mill, at_)),
        velocity_m_s_(translation_velocity(mill, at_)),
        chamber_N_(2, count),
        shaft_N_(2, count),
        shaft_Nm_(count),
        sums_(sums) {}

  void book(std::size_t index, const NamedEffect& effect) {
    bool on_chamber = false, on_shaft = false;
    chamber_N_.setZero(), shaft_N_.setZero(), shaft_Nm_.setZero();
    for (const PlacedForce& placed : effect.evaluate(at_)) {
      const Array2Xd arm_m = position(mill_, placed, at_);
      if (placed.place == Place::debalance) {
        on_shaft = true;
        shaft_N_ += placed.force_N;
        shaft_Nm_ += cross(arm_m, placed.force_N);
        sums_.shaft.add(first_, arm_m, placed.force_N);
      } else {
        on_chamber = true;
        chamber_N_ += placed.force_N;
        book_on_chamber(index, effect.name, placed, arm_m);
      }
    }
    if (on_chamber) fill_eccentric(index);
    if (on_shaft) fill_debalance(index);
    if (on_chamber || on_shaft) fill_supports(index);
  }

  /// The joints' loads by the equations above, and what the sums of both bodies then leave.
  void close() {
    const auto total = [&](RoleIndex role) { return sums_.roles[role].total.middleCols(first_, n_); };
    const Array2Xd chamber_N = sums_.chamber.force_N.middleCols(first_, n_);
    const Array2Xd frame_N = -chamber_N - sums_.shaft.force_N.middleCols(first_, n_);
    const ArrayXd drive_Nm = -cross(translation_m_, chamber_N) - sums_.shaft.moment_Nm.segment(first_, n_);
    total(eccentric).topRows<2>() = chamber_N;
    total(housing_bore).topRows<2>() = -chamber_N;
    total(frame_bearings).topRows<2>() = frame_N;
    total(drive).row(2) = drive_Nm.transpose();

    const Array2Xd at_pivot_m = Array2Xd::Zero(2, n_);
    sums_.chamber.add(first_, at_pivot_m, -chamber_N);
    sums_.shaft.add(first_, translation_m_, chamber_N);
    sums_.shaft.add(first_, at_pivot_m, frame_N);
    sums_.shaft.add_couple(first_, drive_Nm);
  }

private:
  Columns share_of(std::size_t effect, std::size_t role) { return sums_.to_fill(role, effect, first_, n_); }

  void fill_eccentric(std::size_t effect) {
    Columns on_shaft = share_of(effect, eccentric), on_chamber = share_of(effect, housing_bore);
    for (Index i = 0; i < n_; ++i) {
      const double fx = chamber_N_(0, i), fy = chamber_N_(1, i);
      on_shaft(0, i) = fx, on_shaft(1, i) = fy, on_shaft(2, i) = 0;
      on_chamber(0, i) = -fx, on_chamber(1, i) = -fy, on_chamber(2, i) = 0;
    }
  }

  void fill_debalance(std::size_t effect) {
    Columns own = share_of(effect, debalance);
    own.topRows<2>() = shaft_N_;
    own.row(2) = shaft_Nm_.transpose();
    sums_.roles[debalance].total.middleCols(first_, n_) += own;
  }

  void fill_supports(std::size_t effect) {
    Columns frame = share_of(effect, frame_bearings), torque = share_of(effect, drive);
    for (Index i = 0; i < n_; ++i) {
      const double fx = chamber_N_(0, i), fy = chamber_N_(1, i);
      frame(0, i) = -fx - shaft_N_(0, i), frame(1, i) = -fy - shaft_N_(1, i), frame(2, i) = 0;
      torque(0, i) = torque(1, i) = 0;
      torque(2, i) = translation_m_(1, i) * fx - translation_m_(0, i) * fy - shaft_Nm_[i];
    }
  }

  void book_on_chamber(std::size_t index, const std::string& effect, const PlacedForce& placed,
                       const Array2Xd& arm_m) {
    sums_.chamber.add(first_, arm_m, placed.force_N);
    if (placed.couple_Nm.size() > 0) {
      sums_.chamber.add_couple(first_, placed.couple_Nm);
      sums_.couple_Nm.segment(first_, n_) += placed.couple_Nm;
    }
    const bool charge = placed.place == Place::charge_centre || placed.place == Place::chamber_centre;
    if (charge) book_at_port(index, inner_wall, placed);
    if (charge) add_taken(placed.force_N, arm_m, sums_.charge_power_W);
    if (placed.place == Place::spring_foot) book_at_port(index, first_spring_foot + placed.foot, placed);
    if (effect == "spring_damping") add_taken(placed.force_N, arm_m, sums_.damping_power_W);
  }

  /// The load that reaches the chamber itself, at its own port.
  void book_at_port(std::size_t effect, std::size_t role, const PlacedForce& placed) {
    Columns share = sums_.to_add(role, effect, first_, n_);
    auto total = sums_.roles[role].total.middleCols(first_, n_);
    share.topRows<2>() += placed.force_N;
    total.topRows<2>() += placed.force_N;
    if (placed.place != Place::charge_centre) return;
    const ArrayXd about_centre_Nm = mill_.charge_offset_m * cross(at_.along_chi, placed.force_N);
    share.row(2) += about_centre_Nm.transpose();
    total.row(2) += about_centre_Nm.transpose();
  }

  /// Adds the power that a force takes from the chamber.
  void add_taken(const Array2Xd& force_N, const Array2Xd& arm_m, ArrayXd& power_W) const {
    for (Index i = 0; i < n_; ++i)
      power_W[first_ + i] -= force_N(0, i) * (velocity_m_s_(0, i) - at_.theta_rad_s[i] * arm_m(1, i)) +
                             force_N(1, i) * (velocity_m_s_(1, i) + at_.theta_rad_s[i] * arm_m(0, i));
  }

  const VibratoryMill& mill_;
  const Instants at_;
  const Index first_, n_;
  const Array2Xd translation_m_, velocity_m_s_;
  Array2Xd chamber_N_, shaft_N_;  ///< forces of the effect that is being added
  ArrayXd shaft_Nm_;
  EffectSums& sums_;
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
  EffectSums sums(mill, effects.size(), motion);
  for (Index first = 0; first < motion.size(); first += block_size) {
    BlockSums block(mill, first, std::min(block_size, motion.size() - first), sums);
    for (std::size_t i = 0; i < effects.size(); ++i) block.book(i, effects[i]);
    block.close();
  }
  write_results(mill, effects, sums, history);
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
