/// Stress over the cycle at chosen points, from the files of a run.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace pipelines {

/// Point where a history is taken: a node, or where a weld toe's stress is extrapolated from.
struct HistoryPoint {
  struct Part {
    std::size_t node = 0;  ///< as in unit_responses.h5
    double weight = 1;
  };
  std::string body, name;              ///< "zone 1", a surface or weld toe, "node 12", "(1, 2, 3) mm"
  std::string feature;                 ///< feature that it lies on, as the run says; empty where it does not
  std::array<double, 3> position_m{};  ///< in the body's frame; of a toe the toe's own
  std::vector<Part> parts;
  double stated_Pa = 0;      ///< the run's largest von Mises stress there; 0 where it states none
  double distance_m = 0;     ///< distance of the node from the place that was asked for
  bool is_left_out = false;  ///< beside a sharp edge: the run reports no stress there, as none converges
};

struct StressHistory {
  HistoryPoint point;
  /// 6 x instants: xx, yy, zz, xy, yz, xz in the body's frame, which turns with it.
  Eigen::ArrayXXd stress_Pa;

  /// Von Mises stress, one value per instant.
  Eigen::ArrayXd von_mises_Pa() const;
  /// Von Mises stress with the sign of the principal stress of largest size.
  Eigen::ArrayXd signed_von_mises_Pa() const;
  /// Principal stresses, 3 x instants, falling.
  Eigen::ArrayXXd principal_Pa() const;
};

struct StressHistories {
  Eigen::ArrayXd time_s, drive_angle_rad;
  std::vector<StressHistory> points;
  std::vector<std::string> left_out;  ///< points of the run that have none, with the reason
};

/// Superposes the unit responses of a run with its channels at some points. Every point whose largest stress
/// the run states is held against it.
/// @param results  directory of a whole run
/// @param wanted   each "WHAT" or "BODY/WHAT", with WHAT "zone 2", the name of a surface, port or weld toe
///                 (where its stress is largest), "node 1234", or "12.5, 0, -3 mm" for the node nearest to
///                 it, not farther away than the cells there are long; none: all zones and weld toes
/// @throws OptionError for what is no point of the run, with names that are like it, for a place outside, and
///         for a toe that was solved as a submodel; StageRefused if the run has no
///         body with unit responses; FileError naming the file that is damaged, or of another run
StressHistories read_stress_histories(const std::filesystem::path& results,
                                      const std::vector<std::string>& wanted);

}  // namespace pipelines
