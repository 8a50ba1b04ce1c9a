/// Scenes of concentric shafts drawn at random: the population on which a run's promises are tested.
#pragma once

#include <string>

namespace promises {

/// The text of a scene: a shaft of 2 to 8 segments with fillets, grooves and bores, on two bearings, between
/// which or beyond which loads act: bending, torsion, tension or spin, one alone or several together. The
/// same seed gives the same text on every machine. A drawing may be impossible to mesh; read_scene or the
/// mesher refuses it then.
std::string random_shaft_scene(unsigned seed);

}  // namespace promises
