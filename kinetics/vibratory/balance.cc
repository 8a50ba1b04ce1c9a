#include "kinetics/vibratory/balance.h"

#include <algorithm>

#include "kinetics/vibratory/books.h"
#include "kinetics/vibratory/pitch.h"

namespace kinetics::vibratory {
namespace {

using Eigen::Array2Xd;
using Eigen::Array3Xd;
using Eigen::ArrayXd;
using Eigen::Index;

constexpr Index block_size = 256;

Array3Xd load_of(const Array2Xd& force_N, const ArrayXd& torque_Nm) {
  Array3Xd load(3, force_N.cols());
  load.topRows<2>() = force_N;
  load.row(2) = torque_Nm.transpose();
  return load;
}

Array3Xd pure_force(const Array2Xd& force_N) {
  return load_of(force_N, ArrayXd::Zero(force_N.cols()));
}

Array3Xd pure_torque(const ArrayXd& torque_Nm) {
  return load_of(Array2Xd::Zero(2, torque_Nm.size()), torque_Nm);
}

/// Roles in the order of the documentation. Those that only carry an effect's own load are dropped later if
/// nothing was posted to them.
void open_roles(Books& books, const VibratoryMill& mill) {
  books.open("eccentric", "force -B of the chamber on the shaft, through E' = ecc e(phi)");
  books.open("debalance", "force on the debalances, at KE e(phi) of the shaft; torque: its moment about E");
  books.open("frame_bearings",
             "reaction R_E of the frame's bearings on the shaft, through E (massless shaft)");
  books.open("drive", "torque -T of the coupling on the shaft");
  books.open("housing_bore", "force B of the eccentric on the chamber, through E'");
  books.open("inner_wall",
             "force F_w of the charge on the chamber's wall, through its axis C; torque r e(chi) x F_w");
  for (std::size_t i = 0; i < mill.springs.size(); ++i)
    books.open("spring_foot_" + std::to_string(i + 1), "force of the spring on the chamber at its foot");
}

void book_on_shaft(const VibratoryMill& mill, const std::string& effect, const PlacedForce& placed,
                   const Instants& at, Index first, Books& books) {
  const Array2Xd arm_m = position(mill, placed, at);
  const ArrayXd moment_Nm = cross(arm_m, placed.force_N);
  books.post("debalance", effect, first, load_of(placed.force_N, moment_Nm));
  books.post("frame_bearings", effect, first, pure_force(-placed.force_N));
  books.post("drive", effect, first, pure_torque(-moment_Nm));
  books.shaft.add(first, arm_m, placed.force_N);
}

/// The load that reaches the chamber itself, at its own port.
void book_at_port(const VibratoryMill& mill, const std::string& effect, const PlacedForce& placed,
                  const Instants& at, Index first, Books& books) {
  if (placed.place == Place::charge_centre) {
    const Array2Xd from_centre_m = mill.charge_offset_m * direction(at.chi_rad);
    books.post("inner_wall", effect, first, load_of(placed.force_N, cross(from_centre_m, placed.force_N)));
  } else if (placed.place == Place::chamber_centre) {
    books.post("inner_wall", effect, first, pure_force(placed.force_N));
  } else if (placed.place == Place::spring_foot) {
    books.post("spring_foot_" + std::to_string(placed.foot + 1), effect, first, pure_force(placed.force_N));
  }
}

void book_on_chamber(const VibratoryMill& mill, const std::string& effect, const PlacedForce& placed,
                     const Instants& at, Index first, Books& books) {
  const Array2Xd& force_N = placed.force_N;
  books.post("eccentric", effect, first, pure_force(force_N));
  books.post("housing_bore", effect, first, pure_force(-force_N));
  books.post("frame_bearings", effect, first, pure_force(-force_N));
  books.post("drive", effect, first, pure_torque(-cross(translation(mill, at), force_N)));
  book_at_port(mill, effect, placed, at, first, books);

  const Array2Xd arm_m = position(mill, placed, at);
  books.chamber.add(first, arm_m, force_N);
  if (placed.couple_Nm.size() > 0) {
    books.chamber.add_couple(first, placed.couple_Nm);
    books.couple_Nm.segment(first, at.size()) += placed.couple_Nm;
  }
  const Array2Xd velocity_m_s = translation_velocity(mill, at) + scaled(at.theta_rad_s, turned(arm_m));
  const ArrayXd taken_W = -dot(force_N, velocity_m_s);
  if (placed.place == Place::charge_centre || placed.place == Place::chamber_centre)
    books.charge_power_W.segment(first, at.size()) += taken_W;
  if (effect == "spring_damping") books.damping_power_W.segment(first, at.size()) += taken_W;
}

/// The joints' own forces, so that what is left of the sums is what does not close.
void book_joints(const VibratoryMill& mill, Books& books) {
  const auto total = [&](std::size_t index) -> const Array3Xd& { return books.resultants[index].total; };
  const Array3Xd &eccentric = total(0), &frame = total(2), &drive = total(3), &bore = total(4);
  const Array2Xd at_pivot_m = Array2Xd::Zero(2, bore.cols());
  books.chamber.add(0, at_pivot_m, bore.topRows<2>());
  books.shaft.add(0, translation(mill, books.motion), eccentric.topRows<2>());
  books.shaft.add(0, at_pivot_m, frame.topRows<2>());
  books.shaft.add_couple(0, drive.row(2).transpose());
}

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
  const Index n_instants = motion.size();
  Books books(n_instants);
  open_roles(books, mill);
  for (Index first = 0; first < n_instants; first += block_size) {
    const Instants at = part_of(motion, first, std::min(block_size, n_instants - first));
    for (const NamedEffect& effect : effects)
      for (const PlacedForce& placed : effect.evaluate(at)) {
        if (placed.place == Place::debalance)
          book_on_shaft(mill, effect.name, placed, at, first, books);
        else
          book_on_chamber(mill, effect.name, placed, at, first, books);
      }
  }
  books.motion = motion;
  book_joints(mill, books);
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
