/// What the meshes of a search tell of the error at each place of a body: by how much its stress moved when
/// one direction of the mesh became finer, direction by direction, and what a second model says of it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipelines/judge/estimates/place_stress.h"
#include "pipelines/judge/figures/diagrams.h"

namespace pipelines {

/// What of a mesh a step makes finer.
enum class MeshPart {
  fillets,  ///< cells on the quarters of a shaft's fillets
  around,   ///< sectors of a shaft
  along,    ///< cells along a shaft, away from fillets
  through,  ///< rows of cells through a bored shaft's wall
  local,    ///< cells that contribute most to the error
  all       ///< the whole mesh, or what leads of it: chambers, tetrahedra
};

std::string to_string(MeshPart part);

/// One refinement of a mesh.
struct MeshStep {
  MeshPart part = MeshPart::all;
  double ratio = 1;  ///< of cell sizes, before : after
  double order = 2;  ///< with which stress converges at least: of fillets, and of all where `part` is all
  std::vector<std::string> features{};  ///< where cells became smaller; empty: everywhere
  std::vector<std::string> coarse{};    ///< fillets whose cells were too few for that order: 1 there
};

/// Another model's stresses at the same places.
struct SecondModel {
  std::vector<PlaceStress> places;  ///< with the errors of its own discretisation
  /// What the model itself may be off by, relative; 0: it solves the same problem, and a difference is an
  /// error of either.
  double model_error = 0;
  LargestTorsion torsion{};  ///< with what that model may be off by, too
};

/// How far a search believes its meshes. The values here hold for places that a second model of the same
/// problem has, too.
struct TrustInMeshes {
  /// The share of what one mesh tells by itself of an error that later meshes cannot take back, since two
  /// meshes may agree by chance: after the first change of a stress that every part of the mesh has told of,
  /// and after more.
  double kept_after_one = 0.1, kept_after_more = 0.1;
  /// The share of a stress that is open at least where no finer mesh has been compared: cells may be too
  /// large to show that they miss something. Fillets of fine cells (PlaceStress) are known without.
  double open_on_one_mesh = 0;
};

class PlaceHistory {
public:
  /// @param parts  that have to be varied before the error of a place is known from changes alone
  explicit PlaceHistory(std::vector<MeshPart> parts, TrustInMeshes trust = {})
      : parts_(std::move(parts)), trust_(trust) {}

  /// The places on the next mesh.
  /// @param now   values, and as errors what the mesh tells by itself
  /// @param step  from the mesh before; none: the first mesh, or the same mesh with other loads
  void add(const std::vector<PlaceStress>& now, const std::optional<MeshStep>& step);
  void compare_with(SecondModel model) { second_ = std::move(model); }
  const std::optional<SecondModel>& second_model() const { return second_; }

  /// The places of the last mesh with all that is known of their errors:
  /// - from changes: for each part |change| / (ratio^order - 1), added up, times 1.25 (Roache's safety factor
  ///   for series of meshes). The order is the step's on fillets and 1 elsewhere: ends of loads and of
  ///   exclusion distances. While a part has not been varied, at least what the mesh tells by itself, before
  ///   the first change, but on fillets of fine cells, at least the share of the stress that is open on one
  ///   mesh; later at least the kept
  ///   share of what the mesh tells. Away from fillets, the fillets beside the place are a part as well:
  ///   their rows of cells run through to it.
  /// - from a second model of the same problem: at least the difference, at most that with the model's error;
  /// and
  ///   the latter where the models differ by more than both state. A model with an error of its own bounds
  ///   the error from below only, where its stress is larger.
  std::vector<PlaceStress> judged() const;

  /// The parts by what their refinement promises at a place: those that were never varied, then by their
  /// share of the error, largest first. Where a second model of the same problem knows the error of a place
  /// away from fillets, the cells of those beside it and the rows through the wall come last, unless the
  /// others do not explain what that model finds.
  std::vector<MeshPart> by_promise(const std::string& feature) const;

private:
  struct Record {
    PlaceStress now;
    std::map<MeshPart, double> missing_Pa;  ///< by the last change of each part
    int n_changes = 0;                      ///< that were learnt from
  };
  double from_changes(const Record& record) const;
  /// From all changes so far, with their safety factor.
  static double missing_Pa(const Record& record);
  /// Whether a second model of the same problem finds no more of an error than the changes do.
  bool is_explained(const Record& record) const;

  std::vector<MeshPart> parts_;
  TrustInMeshes trust_;
  std::vector<std::string> order_;
  std::map<std::string, Record> records_;
  std::optional<SecondModel> second_;
};

}  // namespace pipelines
