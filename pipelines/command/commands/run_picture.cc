#include "pipelines/command/commands/run_picture.h"

#include <fmt/core.h>

#include <array>
#include <optional>
#include <vector>

#include "pipelines/base/common/process_limits.h"
#include "pipelines/base/common/several_ranks.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/names/typography.h"
#include "pipelines/judge/analysis/error_text.h"
#include "pipelines/judge/analysis/exclusion_border.h"
#include "pipelines/judge/analysis/governing_stress.h"
#include "pipelines/judge/texts/life_text.h"
#include "pipelines/judge/verdict/verdict_text.h"
#include "pipelines/write/files/envelope_files.h"
#include "pipelines/write/pictures/picture.h"

namespace pipelines {
namespace {

const std::vector<DutyPlace>* places_of(const DutyResult& duty, const std::string& body) {
  const auto found = duty.places.find(body);
  return found == duty.places.end() ? nullptr : &found->second;
}

/// The weld toes that last least, each by its row in the terminal's ranking and its life: over all operating
/// blocks, or without blocks in the scene's own running; none where the scene does not ask for fatigue.
void note_lives_of_toes(const Judged& analysis, const DutyResult* duty, PictureOptions& options) {
  constexpr std::size_t most = 4;
  const auto note = [&](std::size_t row, const std::array<double, 3>& toe_m,
                        const std::optional<double>& life_s, const LifeCertainty& certainty) {
    const bool may_end = life_s || (certainty.range && certainty.range->least_s);
    if (may_end && options.notes.size() < most)
      options.notes.push_back({toe_m, fmt::format("{}: {}", row + 1, life_text(life_s, certainty))});
  };
  if (!analysis.fatigue) return;
  if (const auto places = duty == nullptr ? nullptr : places_of(*duty, analysis.scene.name)) {
    options.notes_are = "weld toes by rank,\nlives over all blocks";
    for (std::size_t i = 0; i < places->size(); ++i)
      if ((*places)[i].is_weld) note(i, (*places)[i].position_m, (*places)[i].life_s, (*places)[i].certainty);
    return;
  }
  options.notes_are = "weld toes by rank, lives";
  const auto& welds = analysis.fatigue->welds;
  for (std::size_t i = 0; i < welds.size(); ++i) note(i, welds[i].toe_m, welds[i].life_s, welds[i].certainty);
}

/// "NOT OK: welds at web 2, lower edge"
std::string verdict_on(const SceneRun& run, const std::string& body, const DutyResult* duty) {
  const auto verdict =
      judge({run.loaded.scene, run.loaded.loads, run.analyses, {}, {}, run.loaded.bearings, duty});
  for (const auto& part : verdict.parts)
    if (part.name == body) return headline(part);
  return to_string(Judgement::not_judged);
}

PictureOptions picture_options(const SceneRun& run, const Judged& analysis, const DutyResult* duty) {
  const auto stress = governing_stress(analysis);
  PictureOptions options;
  options.scale = 1e-6;
  options.excluded = excluded_field;
  options.beyond = beyond_field;
  if (const double border_Pa = largest_at_border_Pa(analysis); border_Pa > 0)
    options.excluded_is =
        fmt::format("left out beside sharp edges,\n{} MPa at its border", fixed(border_Pa / 1e6, 1));
  options.mark = PictureMark{stress.position_m,
                             fmt::format("{}\n{} {} MPa\n{}", verdict_on(run, analysis.scene.name, duty),
                                         stress.name(), fixed(stress.value_Pa / 1e6, 1), stress.place)};
  note_lives_of_toes(analysis, duty, options);
  return options;
}

}  // namespace

std::string draw_envelope(const std::filesystem::path& place, const SceneRun& run, const Judged& analysis,
                          const DutyResult* duty) {
  const auto draw = [&](const std::filesystem::path& envelope) {
    return write_picture(
        envelope, von_mises_field,
        run.loaded.scene.title + ", " + analysis.scene.name + ": largest von Mises stress over the cycle",
        "MPa", place / "envelope.png", picture_options(run, analysis, duty));
  };
  bool is_drawn = false;
  if (n_ranks_of_a_body() == 1) {
    is_drawn = draw(place / "envelope.vtu");
  } else {
    const AtomicFile whole(place / "envelope_whole.vtu");  // not kept
    write_whole_envelope(whole.temporary(), run.loaded.scene, run.loaded.loads, analysis);
    is_drawn = draw(whole.temporary());
  }
  return is_drawn ? "" : "no picture: " + why_nothing_draws() + "; envelope.vtu opens in ParaView";
}

}  // namespace pipelines
