#include "pipelines/scene/tables/load_name.h"

#include <map>
#include <vector>

#include "pipelines/base/names/name_fault.h"
#include "pipelines/base/names/nearest_name.h"

namespace pipelines {
namespace {

const std::map<std::string, std::string>& component_units() {
  static const std::map<std::string, std::string> units{
      {"fx", "N"},       {"fy", "N"},    {"fz", "N"},    {"mx", "N m"},    {"my", "N m"},
      {"torque", "N m"}, {"ax", "m/s2"}, {"ay", "m/s2"}, {"az", "rad/s2"}, {"spin", "rad2/s2"}};
  return units;
}

std::string component_list() {
  std::vector<std::string> names;
  for (const auto& [component, unit] : component_units()) names.push_back(component);
  return listed(names);
}

}  // namespace

std::optional<LoadName> parse_load(const std::string& name) {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos || dot == 0) return std::nullopt;
  const std::string component = name.substr(dot + 1);
  const std::string unit = unit_of_component(component);
  if (unit.empty() || !name_fault(name.substr(0, dot)).empty()) return std::nullopt;
  return LoadName{name.substr(0, dot), component, unit};
}

std::string not_a_load(const std::string& name) {
  if (std::string fault = cell_fault(name); !fault.empty()) return fault;
  const auto dot = name.rfind('.');
  if (const std::string fault = name_fault(name.substr(0, dot)); dot != std::string::npos && !fault.empty())
    return "the port's name " + fault;
  return "is no load; write \"<port>.<component>\", the component one of " + component_list();
}

std::string unit_of_component(const std::string& component) {
  const auto found = component_units().find(component);
  return found == component_units().end() ? "" : found->second;
}

kinetics::TableLoad nothing_of(const std::string& effect) {
  return {effect, "volume", "ax", "m/s2", kinetics::HarmonicCourse{}};
}

}  // namespace pipelines
