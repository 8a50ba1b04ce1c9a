#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "kinetics/drive_train.h"
#include "kinetics/torsion/stepper.h"
#include "kinetics/torsion_chain/checks.h"
#include "kinetics/torsion_chain/excitation.h"
#include "kinetics/values/wrong_input.h"

namespace kinetics {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using torsion::ReducedTrain;
using torsion::StepState;

/// Reduced initial values per node, from real ones per inertia.
ArrayXd initial(const DriveTrain& train, const ReducedTrain& reduced, const std::string& what,
                const ArrayXd& given) {
  ArrayXd node = ArrayXd::Zero(reduced.n_nodes());
  if (given.size() == 0) return node;
  if (given.size() != reduced.ratio.size())
    refuse("number of entries of " + what, double(given.size()),
           "must be one per inertia, " + number(double(reduced.ratio.size())) + ", or none");
  std::vector<bool> set(reduced.n_nodes(), false);
  for (Index i = 0; i < given.size(); ++i) {
    const std::string name = what + " of " + train.inertias[i].name;
    require_finite(name, given[i]);
    const Index k = reduced.node_of[i];
    const double value = given[i] / reduced.ratio[i];
    if (set[k] && std::abs(value - node[k]) > 1e-12 * std::max(std::abs(value), std::abs(node[k])))
      refuse(name, given[i], "contradicts the inertia that a rigid element joins it with; obey its ratio");
    if (reduced.held == k && value != 0) refuse(name, given[i], "must be zero, for the inertia is held");
    set[k] = true;
    node[k] = value;
  }
  return node;
}

ArrayXd viscous_stand_in(const DriveTrain& train, const ReducedTrain& reduced, const TransientRun& run) {
  if (!reduced.loss_factor.any()) return reduced.edge_damping;
  if (!(run.loss_frequency_rad_s > 0) || !std::isfinite(run.loss_frequency_rad_s)) {
    const auto lossy = std::find_if(train.elements.begin(), train.elements.end(),
                                    [](const TrainElement& e) { return e.loss_factor != 0; });
    refuse("loss_frequency", run.loss_frequency_rad_s,
           "must be positive: " + lossy->name +
               " has a loss factor, which in time is viscous damping fitted at one "
               "frequency; give the frequency that dominates");
  }
  return reduced.edge_damping + reduced.loss_factor * reduced.stiffness / run.loss_frequency_rad_s;
}

void check_run(const TransientRun& run) {
  require_finite("time_step_s", run.time_step_s);
  if (run.time_step_s <= 0)
    refuse("time_step_s", run.time_step_s, "must be positive; 1/20 of the period resolved");
  if (run.n_steps < 1) refuse("n_steps", double(run.n_steps), "must be at least 1");
  if (run.store_every < 1) refuse("store_every", double(run.store_every), "must be at least 1");
}

/// Torques per inertia, real, of excitations and further loads.
class Torques {
public:
  Torques(const DriveTrain& train, const ReducedTrain& reduced, const TransientRun& run)
      : excitation_(torsion::spectral(train, reduced)), loads_(run.loads) {
    if (!run.with_excitations) excitation_ = {ArrayXd::Zero(reduced.ratio.size()), {}};
    for (const TransientLoad& load : loads_)
      at_.push_back(torsion::inertia_at(train, load.inertia, "inertia of a transient load"));
  }
  ArrayXd operator()(double time_s) const {
    ArrayXd torque_Nm = torsion::torque_at(excitation_, time_s);
    for (std::size_t i = 0; i < loads_.size(); ++i) torque_Nm[at_[i]] += loads_[i].torque_Nm(time_s);
    if (!torque_Nm.isFinite().all())
      refuse("torque at time_s", time_s, "must be a finite number; check the loads");
    return torque_Nm;
  }

private:
  torsion::Spectral excitation_;
  std::vector<TransientLoad> loads_;
  std::vector<Index> at_;
};

/// Writes states into the columns of a result.
class Recorder {
public:
  Recorder(const DriveTrain& train, const ReducedTrain& reduced, Index n_columns) : reduced_(reduced) {
    const Index n = reduced.ratio.size(), m = static_cast<Index>(train.elements.size());
    TrainMotion& motion = result.motion;
    motion.angle_rad = motion.speed_rad_s = motion.acceleration_rad_s2 = Eigen::ArrayXXd::Zero(n, n_columns);
    motion.torque_Nm = motion.reduced_torque_Nm = Eigen::ArrayXXd::Zero(m, n_columns);
    for (ArrayXd* values :
         {&motion.time_s, &result.kinetic_J, &result.potential_J, &result.work_J, &result.dissipated_J})
      *values = ArrayXd::Zero(n_columns);
    inertia_.resize(n), damping_.resize(n);
    for (Index i = 0; i < n; ++i) {
      inertia_[i] = train.inertias[i].inertia_kg_m2 * reduced.ratio[i] * reduced.ratio[i];
      damping_[i] = train.inertias[i].damping_N_m_s * reduced.ratio[i] * reduced.ratio[i];
    }
  }

  void write(Index column, double time_s, const torsion::Stepper& stepper, const StepState& state,
             const ArrayXd& reduced_load) {
    const ArrayXd edge_torque = stepper.torque(state);
    ArrayXd node_load = ArrayXd::Zero(reduced_.n_nodes());
    for (Index i = 0; i < reduced_load.size(); ++i) node_load[reduced_.node_of[i]] += reduced_load[i];
    ArrayXd a =
        (node_load - reduced_.damping * state.speed - stepper.leaving(edge_torque)) / reduced_.inertia;
    if (reduced_.held) a[*reduced_.held] = 0;
    const Index n = reduced_load.size();
    ArrayXd angle(n), speed(n), acceleration(n);
    for (Index i = 0; i < n; ++i) {
      const Index k = reduced_.node_of[i];
      angle[i] = state.angle[k], speed[i] = state.speed[k], acceleration[i] = a[k];
    }
    const ArrayXd torque = torsion::element_torques<ArrayXd>(
        reduced_, edge_torque, reduced_load - inertia_ * acceleration - damping_ * speed);
    TrainMotion& motion = result.motion;
    motion.time_s[column] = time_s;
    motion.angle_rad.col(column) = reduced_.ratio * angle;
    motion.speed_rad_s.col(column) = reduced_.ratio * speed;
    motion.acceleration_rad_s2.col(column) = reduced_.ratio * acceleration;
    motion.reduced_torque_Nm.col(column) = torque;
    motion.torque_Nm.col(column) = torque / reduced_.link_ratio;
    result.kinetic_J[column] = (reduced_.inertia * state.speed.square()).sum() / 2;
    result.potential_J[column] = (reduced_.stiffness * state.twist.square()).sum() / 2;
    result.work_J[column] = state.work_J;
    result.dissipated_J[column] = state.dissipated_J;
  }

  Transient result;

private:
  const ReducedTrain& reduced_;
  ArrayXd inertia_, damping_;  ///< moment of inertia and damping to the ground of each inertia, reduced
};

}  // namespace

Transient transient(const DriveTrain& train, const TransientRun& run) {
  check_run(run);
  const ReducedTrain reduced = torsion::reduce(train);
  const auto spectrum = torsion::spectrum(reduced, train.modal_damping_ratio != 0);
  const torsion::Stepper stepper(reduced, spectrum, train.modal_damping_ratio,
                                 viscous_stand_in(train, reduced, run), run.time_step_s);
  const Torques torques(train, reduced, run);
  StepState state;
  state.angle = initial(train, reduced, "angle", run.angle_rad);
  state.speed = initial(train, reduced, "speed", run.speed_rad_s);
  state.twist = state.rate = ArrayXd::Zero(reduced.n_edges());
  for (Index e = 0; e < reduced.n_edges(); ++e) {
    state.twist[e] = state.angle[reduced.edges[e].first] - state.angle[reduced.edges[e].second];
    state.rate[e] = state.speed[reduced.edges[e].first] - state.speed[reduced.edges[e].second];
  }

  Recorder recorder(train, reduced, run.n_steps / run.store_every + 1);
  ArrayXd now = torques(0) * reduced.ratio;
  recorder.write(0, 0, stepper, state, now);
  for (long step = 1; step <= run.n_steps; ++step) {
    const ArrayXd next = torques(double(step) * run.time_step_s) * reduced.ratio;
    ArrayXd mean = ArrayXd::Zero(reduced.n_nodes());
    for (Index i = 0; i < next.size(); ++i) mean[reduced.node_of[i]] += (now[i] + next[i]) / 2;
    stepper.advance(mean, state);
    now = next;
    if (step % run.store_every == 0)
      recorder.write(step / run.store_every, double(step) * run.time_step_s, stepper, state, now);
  }
  return recorder.result;
}

std::function<double(double)> torque_step(double start_s, double torque_Nm) {
  require_finite("start_s", start_s);
  require_finite("torque", torque_Nm);
  return [=](double time_s) { return time_s < start_s ? 0 : torque_Nm; };
}

std::function<double(double)> torque_table(std::vector<double> time_s, std::vector<double> torque_Nm) {
  if (time_s.empty() || time_s.size() != torque_Nm.size())
    refuse("number of entries of time_s", double(time_s.size()),
           "must equal that of torque, " + number(double(torque_Nm.size())) + ", and not be zero");
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    require_finite("time_s", time_s[i]);
    require_finite("torque", torque_Nm[i]);
    if (i > 0 && time_s[i] <= time_s[i - 1])
      refuse("time_s", time_s[i], "must exceed " + number(time_s[i - 1]));
  }
  return [time_s, torque_Nm](double t) {
    const auto after = std::upper_bound(time_s.begin(), time_s.end(), t) - time_s.begin();
    if (after == 0) return torque_Nm.front();
    if (after == static_cast<std::ptrdiff_t>(time_s.size())) return torque_Nm.back();
    const double share = (t - time_s[after - 1]) / (time_s[after] - time_s[after - 1]);
    return torque_Nm[after - 1] + share * (torque_Nm[after] - torque_Nm[after - 1]);
  };
}

}  // namespace kinetics
