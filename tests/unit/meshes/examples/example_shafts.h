/// Shafts that the tests of this folder share. Lengths in m.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "meshes/shaft_layout/shaft_geometry.h"

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

/// The planetary drum, coupling spec, section 7.3: trunnions bored 40 mm, shell 200; z = 0 in its middle.
meshes::Shaft planetary_drum();

/// The root-peeler's working shaft, coupling spec, section 7.4; z = 0 in its middle.
meshes::Shaft working_shaft();

/// Stub axle that carries a drum's bearing on its free end: d80, fillet 5 against a flange d140, which sits
/// in the carrier with a spigot d100.
meshes::Shaft stub_axle();

/// Two seats eccentric towards +y and -x beside each other on a shaft with a bore of 12 mm.
meshes::Shaft two_eccentrics();

/// Every way in which bores of different size meet: blind from both ends, in a cylinder; a tube stepped
/// inside and sharp outside at one plane; a wall between two chambers that stands out as a flange.
std::vector<meshes::Shaft> stepped_bores();

/// Relief grooves, almost half round, with unlike fillets: beside a shoulder, and free on a bored shaft.
meshes::Shaft grooved_shaft();

/// A name in the tests' own temporary directory, different for each test and process.
std::filesystem::path temporary_msh(const std::string& name);
