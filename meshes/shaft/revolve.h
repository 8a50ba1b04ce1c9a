/// From the meridian to the solid: revolved about z, cores filled, eccentric segments shifted.
#pragma once

#include "meshes/shaft/meridian.h"
#include "meshes/spacing/disc.h"
#include "meshes/values/hex_mesh.h"

namespace meshes {

/// Node j on each circle lies as on the disc, at the angle 2 pi j / n_sectors from +x.
/// Eccentric segments: (x, y) += shift (r - r_a) / (R - r_a) beyond their inner radius r_a.
HexMesh revolve(const Meridian& meridian, const ShaftLayout& layout, const SurfaceTable& surfaces,
                const Disc& disc);

}  // namespace meshes
