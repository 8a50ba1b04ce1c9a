/// What a scene says that is legal but hardly meant: speeds that come from a wrong unit, mostly.
#pragma once

#include <string>
#include <vector>

#include "pipelines/scene/whole/scene.h"

namespace pipelines {

/// Collects what is hardly meant, each as a sentence.
class Doubts {
public:
  void speed(const std::string& of, double speed_rad_s);
  void acceleration(const std::string& of, double size_m_s2, double most_m_s2);
  void peripheral(const std::string& of, double speed_m_s);

  std::vector<std::string> texts;
};

/// Sentences for the user. Warned of are
///   a drive faster than 3600 rpm: no motor turns faster on the mains of 60 Hz without gears or a converter;
///   an acceleration of a vibratory mill's chamber above 20 g: such mills run at 3 to 12 g, eccentric ones of
///     high energy at up to 16 g; of a planetary mill's drums above 100 g: mills of laboratories end there;
///   a peripheral speed of a seat or belt above 50 m/s: of a rolling bearing this is a speed factor n d of
///     1e6 mm/min, where oil jets begin; belts of rubber end at 40 to 50 m/s;
///   a modulus and a density with which sound runs along a bar slower than 300 or faster than 16000 m/s: a
///     third of what it does in polyethylene (920) and 1.25 times that in beryllium (12870, the fastest
///     metal; CRC Handbook of Chemistry and Physics, "Speed of sound in various media", extensional waves);
///   a yield strength that is reached at a strain below 2e-5, a tenth of what the softest metals have
///     (annealed aluminium, 20 MPa of 70 GPa: 2.9e-4), or above 0.2, where no stress is linear any more;
///   a Poisson's ratio above 0.49, where cells of degree 2 lock (error_budget.cc);
///   a tolerance above 20 %, which says little more than the order of magnitude.
/// @param scene  read without an error
std::vector<std::string> implausible(const Scene& scene);

}  // namespace pipelines
