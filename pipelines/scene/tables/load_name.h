/// Loads by name, "<port>.<component>".
#pragma once

#include <optional>
#include <string>

#include "kinetics/table/load_table.h"
#include "pipelines/scene/whole/scene_findings.h"

namespace pipelines {

struct LoadName {
  std::string port, component;
  std::string unit;  ///< SI unit of the component
};

/// The load that a text names; none if it names no load: not_a_load says why.
std::optional<LoadName> parse_load(const std::string& name);
std::string not_a_load(const std::string& name);

/// The SI unit of a component: "fx" and "fz" N, "torque" N m, "ax" m/s2 ...; empty if it is none.
std::string unit_of_component(const std::string& component);

/// Squares of loads up to here, and their sums with arms of metres, stay within the range of numbers.
constexpr double most_load = 1e152;
inline Range loads_within() {
  return between(-most_load, most_load);
}

/// Stands for what was refused: its effect is known all the same, and needs no second error.
kinetics::TableLoad nothing_of(const std::string& effect);

}  // namespace pipelines
