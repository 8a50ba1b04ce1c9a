/// What section planes and rings of the surface feel of the harmonics. Internal to fem.
#pragma once

#include <vector>

#include "fem/base/values/unit_responses.h"
#include "fem/models/axisymmetric/harmonic_strain.h"

namespace fem {

/// What one harmonic adds to one channel: nine columns of its amplitudes.
struct HarmonicPart {
  std::size_t channel;
  bool turned;
};

class HarmonicSections {
public:
  /// Sets planes, their areas and rings; all their responses are zero. Rings lie on curved surfaces of
  /// concentric cylinders and on fillets.
  HarmonicSections(const MeridianGrid& grid, const MeridianBody& body,
                   const std::vector<SectionPlane>& planes, UnitResponses& responses);

  /// Adds the harmonic m: resultants and rigid motion of the planes from the stress of their cells, and mean
  /// shear around. Only m = 0 and 1 have any.
  /// @param displacement  a column per part
  /// @param amplitudes    of the result points
  void add(int m, const std::vector<HarmonicPart>& parts, const Eigen::MatrixXd& displacement,
           const Amplitudes& amplitudes, UnitResponses& responses) const;

private:
  void add_resultants(std::size_t plane, int m, const std::vector<HarmonicPart>& parts,
                      const Eigen::MatrixXd& displacement, UnitResponses& responses) const;
  void add_shear(const std::vector<HarmonicPart>& parts, const Amplitudes& amplitudes,
                 UnitResponses& responses) const;

  const MeridianGrid* grid_;
  Material material_;
  std::vector<int> rim_points_;   // by plane
  std::vector<int> ring_points_;  // by ring
};

}  // namespace fem
