/// The two parameter sets of the planetary mill's reference outputs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "kinetics/planetary_mill.h"

namespace planetary_sets {

using Json = nlohmann::json;

/// A file of tests/data.
Json read(const std::string& name);

/// Set "A" (fitted to the paper's figures, cannot be built) or "B" (the printed data, can be built), as the
/// reference file describes it.
kinetics::PlanetaryMill mill_of(const std::string& set, kinetics::PlanetaryConvention convention);

kinetics::PlanetaryConvention convention_named(const std::string& name);

/// All effects over the angles first, first + step, ... of one turn, without the question whether the machine
/// can be built: the references hold set A, and belts beyond geometry, under `consistent` too.
/// @param n  instants of the whole turn
kinetics::LoadHistory loads_of(kinetics::PlanetaryMill mill, int n);

/// R_A at one angle.
double R_A_N(kinetics::PlanetaryMill mill, double phi_deg);

/// The abscissa of a figure put into the machine: "fig4" Omega, "fig5" gamma in degrees, "fig6" k, "fig7" b,
/// "fig8" c. The references take Figs 6-8 at 60 rad/s and Figs 7 and 8 at k = 0.4.
kinetics::PlanetaryMill at_abscissa(kinetics::PlanetaryMill mill, const std::string& figure, double x);

}  // namespace planetary_sets
