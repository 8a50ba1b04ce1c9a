/// The series of a load stage that headline numbers are made of.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "kinetics/train_crests.h"
#include "kinetics/values/load_history.h"
#include "pipelines/base/common/statistics.h"
#include "pipelines/base/fields/field.h"
#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// Components of a resultant that are not zero throughout: use(name, unit, series).
template <typename Use>
void for_each_component(const kinetics::LoadHistory& loads, const Use& use) {
  for (const auto& resultant : loads.resultants)
    for (const auto& [row, component, unit] :
         {std::tuple{0, ".fx", "N"}, {1, ".fy", "N"}, {2, ".torque", "N m"}}) {
      const Eigen::ArrayXd series = resultant.total.row(row);
      if ((series != 0).any()) use(resultant.role + component, std::string(unit), series);
    }
}

/// What a series of the load stage amounts to.
struct LoadFigure {
  std::string name, unit;
  Statistics statistics;  ///< over the whole course where the machine knows it between the instants
  double time_of_max_s = 0, time_of_min_s = 0;
  double first = 0;  ///< at the first instant
};

/// The fields of statistics.csv and loads.<name>; sweeps have all numbers but the times.
FieldTable<LoadFigure> load_fields();

/// The table `loads` of summary.json; null without any.
summary::Json loads_json(const std::vector<LoadFigure>& figures);

/// Figure of a series by its instants alone.
LoadFigure figure_of(const std::string& name, const std::string& unit, const Eigen::ArrayXd& values,
                     const Eigen::ArrayXd& time_s);

/// Quantities that have statistics; of machines whose loads are samples, what is given at their ports too.
/// @param scene  with the masses that it leaves to a mesh
/// @param loads  loads of its load stage, in the scene's turns
std::vector<LoadFigure> load_figures(const Scene& scene, const kinetics::LoadHistory& loads);

/// Puts extremes, mean and RMS over the whole course in the place of those of the instants.
void take_course(const std::vector<kinetics::CourseFigures>& course, LoadFigure& figure);

/// What the scene's machine knows of the loads' course between their instants; empty: nothing that these do
/// not.
std::vector<kinetics::CourseFigures> course_of_loads(const Scene& scene, const kinetics::LoadHistory& loads);

/// @return of the quantity's name; null: the instants tell it
const kinetics::CourseFigures* find_course(const std::vector<kinetics::CourseFigures>& course,
                                           const std::string& quantity);

}  // namespace pipelines
