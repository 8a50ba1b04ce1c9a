/// Shafts and drums drawn at random; the same seed gives the same bodies with every library.
#pragma once

#include <random>
#include <string>

#include "meshes/shaft_layout/shaft_geometry.h"

/// Number of bodies to try: MILLSTRESS_RANDOM_BODIES, else 50.
int n_random_bodies();

/// 1 to 7 segments of 20 to 100 mm, each 0.35 to 3 diameters long; fillets 5 to 90 % of the step (one in five
/// sharp), at most 15 % of the length that carries them; half of all segments are ports; a segment thicker
/// than both neighbours is eccentric in two of three cases, in any direction, by 10 to 75 % of the ring left
/// by its fillets. At one in four shoulders the smaller segment gives way to a relief groove, 3 to 15 % deep,
/// 5 to 20 % of its diameter long, with fillets that take up to 90 % of its length.
/// A third of the shafts is bored, by 10 to 60 % of the smallest diameter that the bore passes: right
/// through, blind from one end, or with two bores that meet, or face each other blind, inside a concentric
/// segment.
meshes::Shaft random_shaft(std::mt19937& random);

/// A shell of 50 to 600 mm radius, its wall 2.5 to 15 % of that, 0.5 to 8 radii long, in up to three pieces
/// (of which the middle one may be thinner, down to 2 %); covers 5 to 40 % of the radius thick, one in four
/// stands out as a flange by up to 15 %; trunnions of one to four steps that begin at 25 to 80 % of the
/// shell's bore, with fillets of up to 80 % of their step and 35 % of the lengths beside them; bored by 20 to
/// 60 % of the smallest diameter, or (one in three) solid.
meshes::Shaft random_drum(std::mt19937& random);

/// Dimensions in one line, to find a failure again.
std::string text(const meshes::Shaft& shaft);
