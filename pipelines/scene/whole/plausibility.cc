#include "pipelines/scene/whole/plausibility.h"

#include <fmt/core.h>

#include <cmath>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/fatigue/weld_classes.h"
#include "pipelines/scene/whole/body_reader.h"
#include "pipelines/scene/whole/machine_kind.h"

namespace pipelines {
namespace {

constexpr double g_m_s2 = 9.81, rpm = 2 * pi / 60;
constexpr double most_speed_rad_s = 3600 * rpm * (1 + 1e-3);
constexpr double most_peripheral_m_s = 50, most_tolerance = 0.2, most_poisson_ratio = 0.49;

const char* const unit_of_speed =
    "a bare number is in rad/s and \"Hz\" counts turns per second; write \"... rpm\" if that is meant";

/// Waves along a bar of solids: a third of polyethylene's and 1.25 times beryllium's, below.
constexpr double least_wave_m_s = 300, most_wave_m_s = 16000;
constexpr double least_yield_strain = 2e-5, most_yield_strain = 0.2;

/// A modulus, density or strength that does not fit the others, by powers of ten mostly.
void doubt_material(const BodyScene& body, Doubts& doubts) {
  const auto& material = body.material;
  const double wave_m_s = std::sqrt(material.youngs_modulus_Pa / material.density_kg_m3);
  if (wave_m_s < least_wave_m_s || wave_m_s > most_wave_m_s)
    doubts.texts.push_back(
        fmt::format("{}.material: sound would run along a bar with youngs_modulus = {:.4g} GPa and density = "
                    "{:.4g} kg/m3 at {:.3g} m/s; in solids it does at 920 (polyethylene) to 12870 m/s "
                    "(beryllium), in steel at 5200: check both and their units (steel has 210e9 Pa and 7850 "
                    "kg/m3)",
                    body.name, material.youngs_modulus_Pa / 1e9, material.density_kg_m3, wave_m_s));
  const double yield_strain = body.yield_strength_Pa / material.youngs_modulus_Pa;
  if (yield_strain < least_yield_strain || yield_strain > most_yield_strain)
    doubts.texts.push_back(
        fmt::format("{}.material: yield_strength = {:.4g} MPa would be reached at a strain of {:.2g} with "
                    "youngs_modulus = {:.4g} GPa; metals yield at 0.0002 to 0.02, plastics below 0.1: check "
                    "both and their units",
                    body.name, body.yield_strength_Pa / 1e6, yield_strain, material.youngs_modulus_Pa / 1e9));
}

/// The fastest seat of a shaft.
void doubt_seats(const Scene& scene, const BodyScene& body, Doubts& doubts) {
  const auto speed_rad_s = reader_of(body).seat_speed_rad_s(scene, body);
  if (!speed_rad_s || body.shaft() == nullptr) return;
  const meshes::ShaftSegment* fastest = nullptr;
  for (const auto& segment : body.shaft()->geometry.segments)
    if (segment.is_port && (fastest == nullptr || segment.diameter_m > fastest->diameter_m))
      fastest = &segment;
  if (fastest != nullptr)
    doubts.peripheral("the seat \"" + fastest->name + "\" of the " + body.name,
                      *speed_rad_s * fastest->diameter_m / 2);
}

/// Classes of the scene's own that IIW does not have.
void doubt_classes(const BodyScene& body, Doubts& doubts) {
  if (!body.fatigue) return;
  const auto doubt = [&](const std::string& of, const WeldToeScene& toe) {
    if (!is_fat_class(toe.class_Pa))
      doubts.texts.push_back(
          fmt::format("{}: class {:.4g} MPa is no FAT class of IIW ({}); hot-spot stress in "
                      "steel has FAT 90 and 100",
                      of, toe.class_Pa / 1e6, fat_classes_text()));
  };
  doubt(body.name + ".fatigue.welds", body.fatigue->toes);
  for (const auto& [name, toe] : body.fatigue->toes_by_name)
    if (toe.class_Pa != body.fatigue->toes.class_Pa)
      doubt(body.name + ".fatigue.welds, \"" + name + "\"", toe);
}

}  // namespace

void Doubts::speed(const std::string& of, double speed_rad_s) {
  if (std::abs(speed_rad_s) > most_speed_rad_s)
    texts.push_back(
        fmt::format("{} turns at {:.6g} rpm ({:.6g} rad/s), faster than any motor on the mains "
                    "without gears (3600 rpm): {}",
                    of, std::abs(speed_rad_s) / rpm, std::abs(speed_rad_s), unit_of_speed));
}

void Doubts::acceleration(const std::string& of, double size_m_s2, double most_m_s2) {
  if (size_m_s2 > most_m_s2)
    texts.push_back(
        fmt::format("{} is accelerated by {:.3g} g, where {:.3g} g is the most that such mills "
                    "are built for: check speed and radius ({})",
                    of, size_m_s2 / g_m_s2, most_m_s2 / g_m_s2, unit_of_speed));
}

void Doubts::peripheral(const std::string& of, double speed_m_s) {
  if (std::abs(speed_m_s) > most_peripheral_m_s)
    texts.push_back(
        fmt::format("{} runs at a peripheral speed of {:.3g} m/s; bearings and belts end at "
                    "about {:g} m/s: check speed and diameter",
                    of, std::abs(speed_m_s), most_peripheral_m_s));
}

std::vector<std::string> implausible(const Scene& scene) {
  Doubts doubts;
  kind_of(scene.machine).doubt(scene, doubts);
  for (const auto& body : scene.bodies) {
    doubt_seats(scene, body, doubts);
    doubt_classes(body, doubts);
    doubt_material(body, doubts);
    if (body.material.poisson_ratio > most_poisson_ratio)
      doubts.texts.push_back(
          fmt::format("{}.material.poisson_ratio = {:g}: cells of degree 2 hardly keep the volume of such a "
                      "material, and "
                      "the solid's stress comes out too low; the error \"locking\" states by how much",
                      body.name, body.material.poisson_ratio));
  }
  if (scene.accuracy.tolerance > most_tolerance)
    doubts.texts.push_back(
        fmt::format("tolerance = {:g} %: a stress known no better tells little more than "
                    "its order of magnitude; a bare number is a share, 0.05 is 5 %",
                    100 * scene.accuracy.tolerance));
  return doubts.texts;
}

}  // namespace pipelines
