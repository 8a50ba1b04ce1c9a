#include "pipelines/scene/machines/load_table_reader.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "pipelines/base/common/constants.h"
#include "pipelines/base/names/name_fault.h"
#include "pipelines/scene/tables/load_file.h"
#include "pipelines/scene/tables/load_name.h"

namespace pipelines {
namespace {

std::optional<LoadName> read_load_name(SceneTable& entry) {
  const std::string name = entry.text("load");
  auto load = parse_load(name);
  if (!load && !name.empty() && cell_fault(name).empty()) entry.refuse("load", not_a_load(name));
  return load;
}

void read_harmonic(SceneTable& entry, kinetics::LoadTable& loads) {
  const std::string effect = entry.name("effect");
  const auto load = read_load_name(entry);
  const std::string unit = load ? load->unit : "N";
  kinetics::HarmonicCourse harmonic;
  harmonic.mean = entry.quantity_or("mean", unit, loads_within(), 0, "the harmonic alone");
  harmonic.amplitude = entry.quantity("amplitude", unit, loads_within());
  harmonic.order = entry.quantity_or("order", "1", not_negative(1e4), 1, "once per turn of the drive");
  harmonic.phase_rad = entry.quantity_or("phase", "rad", any_angle(), 0, "largest at the first instant");
  entry.finish();
  loads.loads.push_back(load ? kinetics::TableLoad{effect, load->port, load->component, load->unit, harmonic}
                             : nothing_of(effect));
}

void read_constant(SceneTable& entry, kinetics::LoadTable& loads) {
  const std::string effect = entry.name("effect");
  const auto load = read_load_name(entry);
  const double value = entry.quantity("value", load ? load->unit : "N", loads_within());
  entry.finish();
  loads.loads.push_back(load ? kinetics::TableLoad{effect, load->port, load->component, load->unit,
                                                   kinetics::HarmonicCourse{value}}
                             : nothing_of(effect));
}

template <typename Read>
void read_list(SceneTable& machine, const std::string& name, Read&& read) {
  for (SceneTable& entry : machine.tables_if_any(name)) read(entry);
}

}  // namespace

std::string SamplesRead::text() const {
  return effect + ": " + std::to_string(n) + " rows over the drive's angle from " + shown(from_deg) + " to " +
         shown(to_deg) + " deg" + (origin.empty() ? "" : "; " + origin) +
         (n_instants == 0 ? "" : "; resampled to " + std::to_string(n_instants) + " instants");
}

std::vector<SamplesRead> samples_read(const Machine& machine, const kinetics::TimeGrid& grid) {
  std::vector<SamplesRead> all;
  if (const auto* table = std::get_if<kinetics::LoadTable>(&machine))
    for (const auto& load : table->loads) {
      const auto* course = std::get_if<kinetics::SampledCourse>(&load.course);
      if (course == nullptr || course->angle_rad.size() == 0) continue;
      const auto in_deg = [](double angle_rad) { return std::round(angle_rad * 180 / pi * 1e6) / 1e6; };
      const auto& at = course->angle_rad;
      const SamplesRead read{load.effect,    std::size_t(at.size()),
                             in_deg(at[0]),  in_deg(at[at.size() - 1]),
                             course->origin, grid.turns * grid.instants_per_turn};
      const auto is_same = [&](const SamplesRead& other) {
        return other.effect == read.effect && other.n == read.n && other.to_deg == read.to_deg &&
               other.origin == read.origin;
      };
      if (std::none_of(all.begin(), all.end(), is_same)) all.push_back(read);
    }
  return all;
}

kinetics::LoadTable read_load_table(SceneTable& machine, const std::filesystem::path& folder,
                                    int window_turns, SceneFindings& findings) {
  kinetics::LoadTable loads;
  std::vector<std::size_t> mean_turns;  // by index of their loads
  loads.speed_rad_s = machine.quantity("speed", "rad/s", positive(1e4));
  read_list(machine, "files", [&](SceneTable& entry) {
    const std::size_t first = loads.loads.size();
    if (read_load_file(entry, folder, window_turns, findings, loads))
      for (std::size_t i = first; i < loads.loads.size(); ++i) mean_turns.push_back(i);
  });
  repeat_mean_turns(mean_turns, window_turns > 0 ? window_turns : loads.turns, loads);
  read_list(machine, "harmonics", [&](SceneTable& entry) { read_harmonic(entry, loads); });
  read_list(machine, "constants", [&](SceneTable& entry) { read_constant(entry, loads); });
  if (!machine.has("files") && !machine.has("harmonics") && !machine.has("constants"))
    machine.refuse_missing("files",
                           "is missing, and so are harmonics and constants; add a table [[machine.files]], "
                           "[[machine.harmonics]] or [[machine.constants]] with a load");
  machine.finish();
  return loads;
}

}  // namespace pipelines
