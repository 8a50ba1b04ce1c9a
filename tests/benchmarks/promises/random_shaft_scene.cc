#include "tests/benchmarks/promises/random_shaft_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <random>
#include <vector>

namespace promises {
namespace {

struct Segment {
  std::string name;
  double diameter_mm = 0, length_mm = 0;
  bool is_port = false;
};

/// The shaft as it is drawn: fillet_mm[i] stands between segments i and i + 1.
struct Drawing {
  std::vector<Segment> segments;
  std::vector<double> fillets_mm;
  double bore_mm = 0;  ///< through the whole shaft
};

class Draw {
public:
  explicit Draw(unsigned seed) : random_(seed) {}

  // Not the library's distributions: their numbers differ between libraries.
  double between(double low, double high) { return low + (high - low) * (double(random_()) / 4294967296.0); }
  bool happens(double probability) { return between(0, 1) < probability; }
  int count(int low, int high) { return low + int(between(0, high - low + 1)); }

private:
  std::mt19937 random_;
};

double rounded(double value_mm) {
  return std::max(0.1, std::round(10 * value_mm) / 10);
}

/// A fillet at the shoulder between two diameters, or none.
double draw_fillet_mm(Draw& draw, const Segment& a, const Segment& b) {
  const double step_mm = std::abs(a.diameter_mm - b.diameter_mm) / 2;
  const auto& small = a.diameter_mm < b.diameter_mm ? a : b;
  if (step_mm == 0 || draw.happens(0.12)) return 0;
  const double wanted_mm = draw.between(0.025, 0.15) * small.diameter_mm;
  return rounded(std::min({wanted_mm, 0.85 * step_mm, 0.25 * small.length_mm}));
}

void draw_segments(Draw& draw, Drawing& shaft) {
  const int n = draw.count(3, 7);
  const double scale_mm = draw.between(20, 60);
  double before_mm = 0;
  for (int i = 0; i < n; ++i) {
    Segment segment;
    segment.name = fmt::format("s{}", i + 1);
    const bool flush = i > 0 && draw.happens(0.2);
    segment.diameter_mm = flush ? before_mm : rounded(scale_mm * draw.between(0.7, 1.4));
    if (i > 0 && !flush && std::abs(segment.diameter_mm - before_mm) < 0.08 * before_mm)
      segment.diameter_mm = rounded(before_mm * (draw.happens(0.5) ? 1.15 : 0.87));
    segment.length_mm = rounded(segment.diameter_mm * draw.between(0.4, 1.8));
    before_mm = segment.diameter_mm;
    shaft.segments.push_back(segment);
  }
  if (draw.happens(0.3)) {
    double smallest_mm = before_mm;
    for (const auto& segment : shaft.segments) smallest_mm = std::min(smallest_mm, segment.diameter_mm);
    shaft.bore_mm = rounded(draw.between(0.25, 0.6) * smallest_mm);
  }
}

/// A relief groove at the left end of segment i, if there is room.
void cut_groove(Draw& draw, std::size_t i, Drawing& shaft) {
  Segment& host = shaft.segments[i];
  Segment groove = host;
  groove.name = "groove";
  groove.diameter_mm = rounded(host.diameter_mm * draw.between(0.82, 0.93));
  groove.length_mm = rounded(host.diameter_mm * draw.between(0.12, 0.25));
  groove.is_port = false;
  if (shaft.segments[i - 1].diameter_mm <= 1.02 * groove.diameter_mm ||
      groove.length_mm > 0.4 * host.length_mm)
    return;
  host.length_mm = rounded(host.length_mm - groove.length_mm);
  shaft.segments.insert(shaft.segments.begin() + std::ptrdiff_t(i), groove);
}

std::string contour(const Drawing& shaft) {
  std::string text;
  for (std::size_t i = 0; i < shaft.segments.size(); ++i) {
    const auto& s = shaft.segments[i];
    text += fmt::format("  {{ {} = \"{}\", diameter = \"{} mm\", length = \"{} mm\"{} }},\n",
                        s.is_port ? "port" : "name", s.name, s.diameter_mm, s.length_mm,
                        shaft.bore_mm > 0 ? fmt::format(", bore = \"{} mm\"", shaft.bore_mm) : "");
    if (i < shaft.fillets_mm.size() && shaft.fillets_mm[i] > 0)
      text += fmt::format("  {{ fillet = \"{} mm\" }},\n", shaft.fillets_mm[i]);
  }
  return text;
}

std::string load(const std::string& port, const char* component, double value, const char* unit) {
  return fmt::format("[[machine.constants]]\neffect = \"load\"\nload = \"{}.{}\"\nvalue = \"{:.4g} {}\"\n",
                     port, component, value, unit);
}

/// Loads that bring about 100 MPa in the thinnest section, by beam formulas.
std::string draw_loads(Draw& draw, const Drawing& shaft, const std::string& loaded) {
  double d_m = 1, length_m = 0;
  for (const auto& s : shaft.segments) {
    d_m = std::min(d_m, s.diameter_mm / 1000);
    length_m += s.length_mm / 1000;
  }
  const double area_m2 = 0.785 * d_m * d_m, modulus_m3 = 0.0982 * d_m * d_m * d_m, stress_Pa = 50e6;
  const auto one = [&](int kind) -> std::string {
    const double share = draw.between(0.5, 1.5);
    switch (kind) {
      case 0: {  // bending in any direction
        const double force_N = share * stress_Pa * modulus_m3 / (0.25 * length_m),
                     angle = draw.between(0, 6.283);
        return load(loaded, "fx", force_N * std::cos(angle), "N") +
               load(loaded, "fy", force_N * std::sin(angle), "N");
      }
      case 1:
        return load(loaded, "torque", share * stress_Pa * modulus_m3, "N m");
      case 2:
        return load(loaded, "fz", share * stress_Pa * area_m2, "N");
      default:
        return load("volume", "spin", share * stress_Pa / (0.41 * 7850 * d_m * d_m), "rad2/s2");
    }
  };
  const int first = draw.happens(0.45) ? 0 : draw.count(0, 3);
  std::string text = one(first);
  if (draw.happens(0.4)) {
    const int second = (first + draw.count(1, 2)) % 3;
    if (second != first) text += one(second);
  }
  return text;
}

}  // namespace

std::string random_shaft_scene(unsigned seed) {
  Draw draw(seed);
  Drawing shaft;
  draw_segments(draw, shaft);
  // Overhung: the load at the left end, bearings behind it; else the load between the bearings.
  const std::size_t n = shaft.segments.size();
  const bool is_overhung = draw.happens(0.5);
  const std::size_t loaded = is_overhung ? 0 : 1 + std::size_t(draw.count(0, int(n) - 3));
  const std::size_t left = is_overhung ? 1 + std::size_t(draw.count(0, int(n) - 3)) : 0, right = n - 1;
  for (const auto i : {loaded, left, right}) shaft.segments[i].is_port = true;
  const std::string names[] = {shaft.segments[loaded].name, shaft.segments[left].name,
                               shaft.segments[right].name};
  if (draw.happens(0.3)) cut_groove(draw, 1 + std::size_t(draw.count(0, int(n) - 2)), shaft);
  for (std::size_t i = 0; i + 1 < shaft.segments.size(); ++i)
    shaft.fillets_mm.push_back(draw_fillet_mm(draw, shaft.segments[i], shaft.segments[i + 1]));
  return fmt::format(R"(title = "random shaft {}"
effects = ["load"]
[machine]
type = "load_table"
speed = "100 rpm"
{}[sampling]
instants_per_turn = 8
turns = 1
[results]
pictures = false
snapshots = 0
[shaft]
contour = [
{}]
bearings = ["{}", "{}"]
axial_support = "{}"
torque_support = "{}"
[shaft.material]
name = "steel"
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m3"
yield_strength = "305 MPa"
)",
                     seed, draw_loads(draw, shaft, names[0]), contour(shaft), names[1], names[2], names[2],
                     names[2]);
}

}  // namespace promises
