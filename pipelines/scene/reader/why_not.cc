#include "pipelines/scene/reader/why_not.h"

#include <fmt/core.h>

namespace pipelines {
namespace {

/// Beyond it the bulk modulus multiplies what the dilatation is off by to several per cent of a pressure.
constexpr double largest_poisson_ratio = 0.49;

std::string why_no_revolution(const BodyScene& body) {
  const ShaftShape* shape = body.shaft();
  if (shape == nullptr) return "is no shaft or drum given by its contour";
  if (!shape->keyways.empty()) return "has keyways";
  if (body.natural_frequencies > 0) return "asks for natural frequencies, which need the solid's mesh";
  return {};
}

}  // namespace

std::string why_not_axisymmetric(const BodyScene& body) {
  if (auto why = why_no_revolution(body); !why.empty()) return why;
  if (body.material.poisson_ratio > largest_poisson_ratio)
    return fmt::format("has a Poisson ratio of {:g}, above {:g}", body.material.poisson_ratio,
                       largest_poisson_ratio);
  return {};
}

std::string why_not_beam(const BodyScene& body) {
  return why_no_revolution(body);
}

std::string why_not(Method method, const BodyScene& body) {
  return method == Method::beam           ? why_not_beam(body)
         : method == Method::axisymmetric ? why_not_axisymmetric(body)
                                          : std::string();
}

}  // namespace pipelines
