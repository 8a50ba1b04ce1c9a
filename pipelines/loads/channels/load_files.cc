#include "pipelines/loads/channels/load_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "pipelines/base/common/errors.h"
#include "pipelines/base/fields/shown_unit.h"
#include "pipelines/base/files/atomic_file.h"
#include "pipelines/base/files/csv.h"
#include "pipelines/base/files/hdf5_file.h"

namespace pipelines {
namespace {

/// One number per instant, and what both kinds of file call it.
struct Series {
  std::string path;   ///< in HDF5
  std::string title;  ///< in CSV, without the unit
  Hdf5Label label;
  std::vector<double> values;
};

/// Shares of effects are nine in ten of the numbers. With the digits of 32 bits the file is half as large;
/// that is not for loads which are too large or too small for them.
Hdf5Compression compression_of(const Series& series) {
  if (series.path.rfind("/effects/", 0) != 0) return Hdf5Compression::deflate;
  double largest = 0;
  for (const double value : series.values) largest = std::max(largest, std::abs(value));
  using Single = std::numeric_limits<float>;
  const bool fits =
      largest == 0 || (largest < double(Single::max()) && largest > 1e6 * double(Single::min()));
  return fits ? Hdf5Compression::deflate_single : Hdf5Compression::deflate;
}

template <class Values>
std::vector<double> to_vector(const Values& values) {
  std::vector<double> result(static_cast<std::size_t>(values.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) result[static_cast<std::size_t>(i)] = values(i);
  return result;
}

const std::string& checked(const std::string& name) {
  if (name.empty() || name == "." || name.find('/') != std::string::npos)
    throw StageRefused("the name \"" + name + "\" in a load history must not be empty nor hold a \"/\"");
  return name;
}

void add_resultant(std::vector<Series>& all, const std::string& group, const std::string& title,
                   const std::string& description, const Eigen::Array3Xd& load) {
  constexpr std::array<std::pair<const char*, const char*>, 3> components = {
      {{"fx", "N"}, {"fy", "N"}, {"torque", "N m"}}};
  for (int c = 0; c < 3; ++c)
    all.push_back({group + "/" + components[c].first,
                   title + "." + components[c].first,
                   {components[c].second, description},
                   to_vector(load.row(c))});
}

void check_channels(const ChannelHistory& channels, Eigen::Index n_instants) {
  const auto fits = [&](const Eigen::ArrayXXd& values) {
    return values.cols() == n_instants &&
           values.rows() == static_cast<Eigen::Index>(channels.channels.size());
  };
  bool good = fits(channels.values) && channels.effects.size() == channels.by_effect.size();
  for (const auto& part : channels.by_effect) good = good && fits(part);
  if (!good)
    throw std::invalid_argument(
        "the channels of \"" + channels.body +
        "\" do not have the instants of the load history, or not one row per channel");
}

/// Everything both files hold, in their order.
std::vector<Series> series_of(const kinetics::LoadHistory& loads, const BodyChannels& bodies) {
  std::vector<Series> all = {
      {"/time", "time", {"s", "instants"}, to_vector(loads.time_s)},
      {"/phi", "phi", {"rad", "drive angle"}, to_vector(loads.phi_rad)},
      {"/speed", "speed", {"rad/s", "d phi / dt"}, to_vector(loads.speed_rad_s)},
      {"/acceleration", "acceleration", {"rad/s2", "d2 phi / dt2"}, to_vector(loads.acceleration_rad_s2)}};
  for (const auto& quantity : loads.quantities)
    all.push_back({"/quantities/" + checked(quantity.name),
                   quantity.name,
                   {quantity.unit, quantity.description},
                   to_vector(quantity.values)});
  for (const auto& resultant : loads.resultants)
    add_resultant(all, "/resultants/" + checked(resultant.role), resultant.role, resultant.description,
                  resultant.total);
  for (const auto* body : bodies)
    for (std::size_t k = 0; k < body->channels.size(); ++k) {
      const auto& channel = body->channels[k];
      const std::string name = checked(body->body) + "/" + checked(channel.name);
      all.push_back({"/channels/" + name,
                     name,
                     {channel.unit, ""},
                     to_vector(body->values.row(static_cast<Eigen::Index>(k)))});
    }
  for (const auto& resultant : loads.resultants)
    for (const auto& part : resultant.contributions)
      add_resultant(all, "/effects/" + checked(loads.effects[part.effect]) + "/" + resultant.role,
                    loads.effects[part.effect] + "/" + resultant.role, resultant.description, part.load);
  for (const auto* body : bodies)
    for (std::size_t e = 0; e < body->effects.size(); ++e)
      for (std::size_t k = 0; k < body->channels.size(); ++k) {
        const auto& channel = body->channels[k];
        const std::string name = checked(body->effects[e]) + "/" + body->body + "/" + channel.name;
        all.push_back({"/effects/" + name,
                       name,
                       {channel.unit, ""},
                       to_vector(body->by_effect[e].row(static_cast<Eigen::Index>(k)))});
      }
  for (const auto& series : all)
    if (series.values.size() != all.front().values.size())
      throw std::invalid_argument(series.path + " has " + std::to_string(series.values.size()) +
                                  " instants, /time has " + std::to_string(all.front().values.size()));
  return all;
}

/// Datasets by label and values.
using WrittenSeries = std::map<std::tuple<std::string, std::string, std::vector<double>>, std::string>;

/// One dataset has the names of all series that are equal, as where one effect alone makes a channel.
void write_series(Hdf5Writer& out, Series& series, WrittenSeries& written) {
  const auto found = written.find({series.label.unit, series.label.description, series.values});
  if (found != written.end()) return out.link(series.path, found->second);
  out.write(series.path, series.values.data(), {series.values.size()}, series.label, compression_of(series));
  written.emplace(std::tuple(series.label.unit, series.label.description, std::move(series.values)),
                  series.path);
}

}  // namespace

void write_loads_h5(const std::filesystem::path& path, const kinetics::LoadHistory& loads,
                    const BodyChannels& bodies) {
  for (const auto* body : bodies) check_channels(*body, loads.n_instants());
  auto all = series_of(loads, bodies);
  WrittenSeries written;
  AtomicFile file(path);
  Hdf5Writer out(file.temporary());
  out.attribute("/", "machine", loads.machine);
  out.attribute("/", "convention", loads.convention);
  out.attribute(
      "/", "phases",
      "amplitude cos(n angle - phase), of a drive train's excitations cos(w t - phase): a lag is positive");
  for (auto& series : all) write_series(out, series, written);
  out.write("/effect_names", loads.effects,
            {"", "effects evaluated by the machine, in the order of summation"});
  out.write("/warnings", loads.warnings);
  for (const auto* body : bodies) out.make_group("/channels/" + body->body);
  out.close();
  file.commit();
}

bool is_loads_file(const std::filesystem::path& path) {
  const std::string titles = "time [s],phi [deg],speed [rad/s],acceleration [rad/s2]";
  std::string start(titles.size(), '\0');
  std::ifstream(path, std::ios::binary).read(start.data(), std::streamsize(start.size()));
  if (start == titles) return true;
  if (start.compare(0, 8, "\x89HDF\r\n\x1a\n") != 0) return false;
  try {
    const Hdf5Reader in(path);
    return in.has("/time") && in.has("/effect_names") && !in.text_attribute("/", "convention").empty();
  } catch (const FileError&) {
    return false;
  }
}

void write_loads_csv(const std::filesystem::path& path, const kinetics::LoadHistory& loads,
                     const BodyChannels& bodies, int n_threads) {
  for (const auto* body : bodies) check_channels(*body, loads.n_instants());
  std::vector<CsvColumn> columns;
  for (auto& series : series_of(loads, bodies))
    columns.push_back(in_shown_unit({series.title, series.label.unit, std::move(series.values)}));
  write_csv(path, columns, n_threads);
}

}  // namespace pipelines
