/// Chambers that the tests of this folder share. Lengths in m.
#pragma once

#include <random>
#include <string>

#include "meshes/chamber/chamber_geometry.h"

/// The laboratory chamber; coupling spec, section 7.2.
meshes::Chamber laboratory_chamber();

/// Three feet (one above the tube's axis), three webs, unequal in z, a lug that overlaps the webs around the
/// tube.
meshes::Chamber lopsided_chamber();

/// 1 to 3 webs, 1 to 4 feet anywhere around the tube, sizes drawn from the ranges that chamber.h documents;
/// may be one that has to be refused.
meshes::Chamber random_chamber(std::mt19937& random);

/// In one line, for messages.
std::string text(const meshes::Chamber& chamber);
