/// The section of a body of revolution refined until every place's stress is known. Internal to the runs on
/// this model.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fem/models/axisymmetric/meridian_body.h"
#include "pipelines/judge/analysis/judged.h"

namespace pipelines {

/// One section, solved and superposed.
struct AxisymmetricStep {
  std::string fineness;  ///< in words
  fem::UnitResponses responses;
  Envelope envelope;
  NodePlaces node_places;
  std::vector<PlaceStress> places;  ///< with their errors; of the first step there are none yet
  LargestTorsion torsion;           ///< likewise
  double seconds = 0;

  const PlaceStress& peak() const;
  /// What the largest stress may be off by: its own error, or what another place with its error exceeds it
  /// by.
  double peak_error_Pa() const;
};

/// Each step cuts every cell of the one before in four, with cells half as large around fillets, ends of
/// loaded seats and sharp edges; where a place holds the accuracy back there is one more fine circle at its
/// largest stress from the third on. A place that no cut reaches would stand still and seem to be known.
/// Stress at the ends of loaded zones converges with first order, elsewhere with third; which one a place
/// shows from the third step on says what its last value misses (section_changes.h).
class AxisymmetricRefinement {
public:
  /// References have to outlive this object.
  /// @throws StageRefused if why_not_axisymmetric is not empty
  AxisymmetricRefinement(const BodyScene& body, const MeshedBody& meshed, const BodyLoads& loads,
                         int n_threads);

  AxisymmetricStep next(StageClock& clock);

  /// Whether no place with its error exceeds the largest stress by more than that share.
  static bool is_met(const AxisymmetricStep& step, double target);
  /// Values on the sections so far, by feature.
  const std::map<std::string, std::vector<double>>& values_Pa() const { return values_Pa_; }
  /// The next would have millions of unknowns.
  static constexpr int most_steps = 4;

private:
  void learn(AxisymmetricStep& step);
  void learn_torsion(AxisymmetricStep& step);
  void add_circles(const AxisymmetricStep& step);

  const MeshedBody* meshed_;
  const BodyLoads* loads_;
  int n_threads_;
  fem::MeridianBody section_;
  std::vector<fem::FineCircle> circles_;  // sizes of the first step
  std::vector<fem::SectionPlane> planes_;
  std::map<std::string, std::vector<double>> values_Pa_, torsion_Pa_;  // by feature, step after step
  int n_steps_ = 0;
};

/// What axisymmetric_stresses knows.
struct AxisymmetricStresses {
  std::vector<PlaceStress> places;
  LargestTorsion torsion;  ///< of the last section: sections are not refined for its sake
};

/// A section with so many unknowns is the last one of a second opinion: the next, with some 4 times as many,
/// would cost more than the solid that it stands beside.
constexpr std::size_t most_of_second_opinion = 100000;

/// The places of a shaft alone, by sections until no place's error exceeds `target` of the largest value, or
/// one has too many unknowns: the errors then say so. A second opinion on other models of the same loads: on
/// concentric shafts values are within their errors of the elastic solution.
/// @param meshed         features, ports, sharp edges and masses of whatever mesh the loads were made for
/// @param most_unknowns  of a section that another one follows
/// @throws as AxisymmetricRefinement
AxisymmetricStresses axisymmetric_stresses(const BodyScene& body, const MeshedBody& meshed,
                                           const BodyLoads& loads, int n_threads, double target = 0.005,
                                           std::size_t most_unknowns = most_of_second_opinion);

}  // namespace pipelines
