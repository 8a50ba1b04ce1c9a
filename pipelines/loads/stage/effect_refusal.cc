/// How a scene's effects are refused that leave a body without equilibrium: the same words for every command.
#include <algorithm>
#include <stdexcept>

#include "kinetics/values/machine_refused.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/name_lists.h"
#include "pipelines/loads/stage/body_loads.h"
#include "pipelines/loads/stage/effect_closure.h"
#include "pipelines/loads/stage/load_maker.h"
#include "pipelines/scene/whole/body_effects.h"

namespace pipelines {
namespace {

using Names = std::vector<std::string>;

/// Names in quotation marks: "a", "b" and "c".
std::string quoted(const Names& names, const std::string& last = " and ") {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : last) + ("\"" + names[i] + "\"");
  return text;
}

/// What is left over; without figures, which differ a little from mesh to mesh: the words of a refusal do
/// not.
std::string rest_text(const Closure& closure) {
  static const char* const names[] = {"forces along x",  "forces along y",  "forces along z",
                                      "moments about x", "moments about y", "torques about z"};
  std::string text;
  for (std::size_t c = 0; c < 6; ++c)
    if ((c < 3 ? closure.force[c] : closure.moment[c - 3]) > Closure::limit)
      text += (text.empty() ? "" : " and ") + std::string(names[c]);
  return text;
}

struct Remedies {
  Names add;     ///< any one of these would do
  Names remove;  ///< all of these together
};

bool admits(Scene scene, const Names& effects, const std::vector<MeshedBody>& meshed,
            const MassAgreement& masses) {
  scene.effects = effects;
  if (effects.empty() || !open_needs(effect_table(scene), effects).empty()) return false;
  try {
    return is_admissible(try_effects(scene, meshed, masses), meshed);
  } catch (const kinetics::MachineRefused&) {
    return false;
  } catch (const StageRefused&) {
    return false;
  }
}

Remedies remedies_for(const Scene& scene, const std::vector<MeshedBody>& meshed, const MassAgreement& masses,
                      const Names& unbalanced) {
  Remedies remedies;
  for (const auto& effect : scene.effects_key.offered) {
    if (scene.has_effect(effect)) continue;
    Names more = scene.effects;
    more.push_back(effect);
    if (admits(scene, more, meshed, masses)) remedies.add.push_back(effect);
  }
  if (unbalanced.empty()) return remedies;
  const Names off = with_dependents(effect_table(scene), scene.effects, unbalanced);
  if (admits(scene, names_without(scene.effects, off), meshed, masses)) remedies.remove = off;
  return remedies;
}

std::string remedy_text(const Remedies& remedies, const std::string& support) {
  std::vector<std::string> ways;
  if (!remedies.add.empty()) ways.push_back("add " + quoted(remedies.add, " or "));
  if (!support.empty()) ways.push_back(support);
  if (!remedies.remove.empty()) ways.push_back("remove " + quoted(remedies.remove));
  std::string text;
  for (const auto& way : ways) text += (text.empty() ? "" : ", or ") + way;
  return text;
}

[[noreturn]] void refuse_effects(const Scene& scene, const std::string& remedy) {
  const auto& key = scene.effects_key;
  const bool is_whole =
      !key.as_written.empty() && std::string("]\"").find(key.as_written.back()) != std::string::npos;
  std::string list;
  for (const auto& effect : scene.effects) list += (list.empty() ? "\"" : ", \"") + effect + "\"";
  throw SceneError({{scene.file.string(), key.line, key.column, "effects",
                     is_whole ? key.as_written : "[" + list + "]", remedy}});
}

}  // namespace

void require_equilibrium(const Scene& scene, const std::vector<MeshedBody>& meshed,
                         const MassAgreement& masses, const std::vector<BodyLoads>& loads) {
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const auto& body = scene.bodies[i];
    const auto& regions = meshed[i].regions;
    if (loads[i].unit_loads.empty()) {
      const auto remedies = remedies_for(scene, meshed, masses, {});
      refuse_effects(scene, "no effect of the scene loads the " + body.name + "; " +
                                (remedies.add.empty() ? "name one that does" : remedy_text(remedies, "")) +
                                ", or remove [" + body.name + "]");
    }
    const Closure closure = closure_of(loads[i], regions);
    if (closure.holds()) continue;
    const auto unbalanced = unbalanced_effects(loads[i], regions);
    const auto support = load_maker_of(body).missing_support(body, closure);
    const auto remedy = remedy_text(remedies_for(scene, meshed, masses, unbalanced), support);
    if (remedy.empty() || closure.channel_resultant > Closure::limit)
      require_closed_loads(loads[i], regions);  // no choice of effects is at fault
    refuse_effects(scene, "the " + body.name + " is not in equilibrium: the loads of " + quoted(unbalanced) +
                              " leave " + rest_text(closure) + " that nothing balances; " + remedy);
  }
}

}  // namespace pipelines
