/// The scene: one TOML file read into values, checked, in SI units. Everything the stages need and nothing
/// else.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinetics/run_up.h"
#include "pipelines/base/common/errors.h"
#include "pipelines/scene/values/bearing_scene.h"
#include "pipelines/scene/values/body_scene.h"
#include "pipelines/scene/values/duty_scene.h"
#include "pipelines/scene/values/limits_scene.h"
#include "pipelines/scene/values/method.h"
#include "pipelines/scene/values/requested_accuracy.h"
#include "pipelines/scene/whole/key_form.h"
#include "pipelines/scene/whole/machine.h"

namespace pipelines {

/// Where a zone begins: a share of the peak or of the yield strength.
struct ZoneRule {
  enum class Reference { peak, yield };
  Reference reference = Reference::peak;
  double share = 0.5;  ///< in (0, 1]
};

/// The room that the charge has. Mass and offset of the charge are checked against it; no load depends on it.
struct MillingSpace {
  double inner_radius_m = 0;
  double inner_length_m = 0;
};

/// What `millstress torsion` looks at beside the operating point.
struct TorsionScene {
  double slowest_rad_s = 0, fastest_rad_s = 0;  ///< speeds of the reference shaft in the Campbell table
  int n_speeds = 16;
  std::vector<double> orders;  ///< orders by the reference shaft's speed, beside those of the excitations
  /// Torques over time on single inertias, and how long they are followed; empty: no transient is computed.
  struct Torque {
    std::string inertia;
    std::vector<double> time_s, torque_Nm;  ///< straight lines in between, constant outside
  };
  std::optional<kinetics::TransientRun> transient;  ///< its loads are made from `torques`
  std::vector<Torque> torques;
  bool published_tables = false;  ///< the paper's own tables, errata included, beside the mechanics
};

/// A value the user did not give; printed by `check`.
struct DefaultUsed {
  std::string key, value, reason;
};

/// A load of the load stage, "<role>.force", "<role>.torque", and how much it changes.
struct LoadChange {
  double share = 0;  ///< largest change over the cycle over its largest magnitude
  std::string load;
};

/// What `effects = "auto"` has come to.
struct EffectChoice {
  struct Dropped {
    std::string effect;
    /// Share of the loads that changes when it and `with` are switched off (effect_choice.h).
    double share = 0;
    std::vector<std::string> with{};  ///< effects that went with it, since they need each other
  };
  std::vector<std::string> offered;  ///< in order; empty: the scene names its effects
  bool open = false;                 ///< nothing is switched off yet: all that are offered are on
  double limit = 0;                  ///< limit of what may change: a tenth of the tolerance
  std::vector<Dropped> dropped;      ///< from the least to the most important
  double share = 0;                  ///< share of the loads that changes by all of these together
  LoadChange load_change;            ///< change of the load that changes most, whether a body feels it or not
  /// Effects dropped at first whose bound after the solve was too large.
  std::vector<std::string> taken_back;
};

/// The key `effects` of a scene, for what comes to light after reading.
struct EffectsKey {
  int line = 0, column = 0;  ///< 1-based
  std::string as_written;
  std::vector<std::string> offered;  ///< every effect that the scene has data for
};

/// What a run leaves in its directory.
enum class Keep {
  all,      ///< results, the bodies' unit responses, and the loads as a table
  results,  ///< all but these, which are in the user's cache
  report    ///< summary.json and report.html
};

struct Scene {
  std::filesystem::path file;
  std::vector<std::string> settings;        ///< "KEY=VALUE" of the command line, which the file does not have
  std::map<std::string, std::string> keys;  ///< every value as a text by its key, settings included
  std::string title;
  std::string machine_origin;   ///< "file:line:column: machine", named by errors that come after reading
  std::string machine_type_at;  ///< "file:line:column: machine.type = ..."
  Machine machine;
  std::optional<MillingSpace> milling_space;  ///< empty if the scene does not give it
  std::vector<std::string> effects;           ///< effects that are on; each known, none twice
  EffectsKey effects_key;
  EffectChoice effect_choice;  ///< choice of effects = "auto"
  kinetics::TimeGrid sampling;
  std::vector<BodyScene> bodies;          ///< none: the load stage only
  TorsionScene torsion;                   ///< for a drive train
  std::optional<kinetics::RunUp> run_up;  ///< run-up of a vibratory mill, instead of steady running
  /// Whether a planetary mill's trunnions have their load also in axes that turn with the drum.
  bool drum_axes = false;
  std::vector<BearingScene> bearings;
  LimitsScene limits;                 ///< what the verdict asks for
  std::vector<DutyBlock> duty;        ///< none: the scene's own running alone, for ever
  Method method = Method::automatic;  ///< the model of every body
  RequestedAccuracy accuracy;         ///< how well the stresses are to be known, and in what time
  ZoneRule zones;
  int snapshots = 12;    ///< over the turn that contains the peak; 0: none
  bool pictures = true;  ///< pictures of the envelope, as PNG
  Keep keep = Keep::results;
  std::vector<DefaultUsed> defaults;
  std::vector<std::string> warnings;  ///< sentences for the user: legal, but worth a look
  /// Every key that the reader knows in this scene, whether it is there or not: dotted, items counted from 1.
  std::vector<std::string> known_keys;
  KeyForms key_forms;  ///< what may stand under them

  /// Masses that the scene leaves to the mesh: "structure", "exciter", "drum", or the name of a train's
  /// inertia.
  std::vector<std::string> masses_from_mesh;

  // Defined in the .cc file: else every file that copies one compiles the copies of all members anew.
  Scene();
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  /// The scene's effects that kinetics evaluates: all but those that the bodies add.
  std::vector<std::string> kinetics_effects() const;
  bool has_effect(const std::string& name) const;
  /// Null if the scene has no body of that name.
  const BodyScene* body(const std::string& name) const;
  /// @throws std::bad_variant_access if the machine is another
  const kinetics::VibratoryMill& vibratory_mill() const { return std::get<kinetics::VibratoryMill>(machine); }
};

/// Reads and checks a scene. pipelines/scenes/vibratory_mill.toml shows every key with its meaning.
/// @param settings  "KEY=VALUE", which stand for what the file says (set_keys)
/// @throws SceneError with every error found, in the order of the file
/// @throws FileError if the unit database of udunits2 is not installed
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings = {});

}  // namespace pipelines
