/// A model of one body of a run, as a search knows it: its stress, what that is worth, and the next finer
/// model.
#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/base/common/several_ranks.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/analysis/judged.h"
#include "pipelines/loads/stage/load_stage.h"

namespace pipelines {

/// Seconds since a run began: those of the first of the ranks that share a body, so that all decide alike.
class RunTime {
public:
  using Clock = std::chrono::steady_clock;

  double seconds() const {
    return as_on_first_rank(std::chrono::duration<double>(Clock::now() - start_).count());
  }
  /// @param end_s  from the start of the run; 0: no limit
  /// @return infinite without a limit
  double seconds_until(double end_s) const {
    return end_s > 0 ? end_s - seconds() : std::numeric_limits<double>::infinity();
  }

private:
  Clock::time_point start_ = Clock::now();
};

/// What the models of a body need of the run that the body is part of.
struct RunOfBody {
  std::size_t index = 0;  ///< of the body in Scene::bodies
  RunOptions options{};
  bool is_search = false;        ///< else the mesh of the scene is solved once
  bool has_second_model = true;  ///< harmonics around the axis beside the solid, where they apply
  double tolerance = 0;          ///< of the governing stress, relative; 0: none
  double time_limit_s = 0;       ///< of the whole run; 0: none
  double end_s = 0;              ///< when this body's time is up, from the start of the run; 0: never
  RunTime time{};
  StageClock* clock = nullptr;
  /// Loads all bodies of a version of the scene.
  std::function<Loaded(const Scene&, std::vector<MeshedBody>)> load{};
  std::function<void(const std::string&)> warn{};  ///< takes warnings of the run

  double seconds_left() const { return time.seconds_until(end_s); }
};

class BodyModel;

/// What a search takes next.
struct Finer {
  std::unique_ptr<BodyModel> model{};  ///< null: there is none
  std::string why_not{};               ///< there is none
  double seconds = 0;                  ///< that it is forecast to take; 0: nobody knows
};

class BodyModel {
public:
  /// @param loaded  the loads that the model answers
  BodyModel(RunOfBody run, Loaded loaded) : run_(std::move(run)), loaded_(std::move(loaded)) {}
  virtual ~BodyModel() = default;

  /// The stress of the body under its loads: responds and superposes.
  virtual Judged solve() = 0;
  /// Enters what this model, and those that it was refined from, tell of the errors of `solved`, which
  /// solve() has returned.
  virtual void judge(Judged& solved) = 0;
  /// Before a search ends: judges the places that no step was for.
  /// @return false if they have been judged
  virtual bool judge_rest(Judged&) { return false; }
  /// @return why nothing finer is worth looking for; empty: it is
  virtual std::string reason_to_end(const Search&, const GoverningStress&) const { return {}; }
  /// The next model where the errors of `judged` are to become smaller, meshed and loaded. It may be solved
  /// while this one is there to return to.
  virtual Finer finer(const Judged& judged, const Search& search) = 0;
  /// Gives away what takes memory and could be made again.
  virtual void release() const {}

  /// Fineness in words, and what became finer before it; empty: nothing.
  virtual std::string fineness() const = 0;
  virtual std::string refined() const { return {}; }
  /// Seconds that have to be left once the search has ended.
  virtual double seconds_after() const { return 0; }

  /// The stress of a search that has ended, under the loads of this model, which other bodies have changed
  /// since, with the errors that were found.
  /// @param before  gives away what stays
  virtual Judged again(Judged& before);

  const Loaded& loaded() const { return loaded_; }

protected:
  const Scene& scene() const { return loaded_.scene; }
  const BodyScene& body() const { return loaded_.scene.bodies[run_.index]; }
  const MeshedBody& meshed() const { return loaded_.meshed[run_.index]; }
  const BodyLoads& body_loads() const { return loaded_.body_loads[run_.index]; }
  StageClock& clock() const { return *run_.clock; }

  /// Another version of the scene, loaded, with this body's mesh in the place of the present one.
  Loaded loaded_with(const Scene& scene, MeshedBody mesh) const;

  /// The responses of this model under its loads.
  /// @param meshed  that the responses are of
  /// @param known   their envelope, where it is known
  Judged judged(Responded responded, const MeshedBody& meshed,
                std::optional<Envelope> known = std::nullopt) const;
  /// The responses of `before` under the present loads.
  Judged judged_again(Judged& before) const;

  RunOfBody run_;
  Loaded loaded_;
};

}  // namespace pipelines
