/// Shafts that the tests of this folder share. Lengths in m.
#pragma once

#include <filesystem>
#include <string>

#include "meshes/shaft.h"

/// The laboratory shaft with the eccentric seat; coupling spec, section 7.1.
meshes::Shaft laboratory_shaft();

/// Two concentric segments of small diameter 1 and big diameter D, each 2 long; 0: a sharp shoulder.
meshes::Shaft shoulder_shaft(double big_diameter_m, double fillet_m);

/// One cylinder, 0.05 x 0.2, a port.
meshes::Shaft plain_cylinder();

/// Diameters 30, 40, 50 mm, sharp shoulders.
meshes::Shaft three_steps();

/// Sharp corners only, in the middle a disc of 60 mm eccentric by -4 mm between 40 and 30 mm.
meshes::Shaft sharp_eccentric_shaft();

/// A name in the tests' own temporary directory, different for each test and process.
std::filesystem::path temporary_msh(const std::string& name);
