#include <stdexcept>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/names/nearest_name.h"
#include "pipelines/scene/reader/scene_stages.h"
#include "pipelines/scene/reader/why_not.h"
#include "pipelines/scene/whole/requested_method.h"

namespace pipelines {
namespace {

std::string quoted_names() {
  auto names = method_names();
  for (auto& name : names) name = '"' + name + '"';
  return listed(names);
}

/// "; did you mean "beam"?", or nothing.
std::string near_method(const std::string& text) {
  const auto nearest = nearest_name(text, method_names());
  return nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?";
}

/// What is wrong with a method for the scene's bodies, and what to do; empty: nothing.
std::string remedy_for(Method method, const Scene& scene) {
  for (const auto& body : scene.bodies)
    if (const auto why = why_not(method, body); !why.empty())
      return "the " + body.name + " " + why + "; write \"auto\" or \"solid\"";
  return {};
}

}  // namespace

Method read_method(SceneTable& root, const Scene& scene) {
  const std::string text = root.text_or("method", "auto", "the cheapest model that meets the tolerance");
  if (text.empty()) return Method::automatic;  // refused already
  const auto method = method_of(text);
  if (!method)
    root.refuse("method", "unknown model" + near_method(text) + "; write one of " + quoted_names());
  else if (const auto remedy = remedy_for(*method, scene); !remedy.empty())
    root.refuse("method", remedy);
  return method.value_or(Method::automatic);
}

Method requested_method(const std::string& option, const Scene& scene) {
  if (option.empty()) return scene.method;
  const auto method = method_of(option);
  if (!method)
    throw OptionError("--method " + option + ": unknown model" + near_method(option) + "; write one of " +
                      listed(method_names()));
  if (scene.bodies.empty())
    throw OptionError(
        "--method " + option +
        ": the scene has no body, and only bodies have a model; leave it out, or add a body, as "
        "[shaft], to the scene");
  if (const auto remedy = remedy_for(*method, scene); !remedy.empty())
    throw OptionError("--method " + option + ": " + remedy);
  return *method;
}

}  // namespace pipelines
