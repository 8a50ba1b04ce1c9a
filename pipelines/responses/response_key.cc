#include "pipelines/responses/response_key.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <sstream>
#include <stdexcept>

#include "pipelines/files/content_hash.h"
#include "pipelines/files/csv.h"

namespace pipelines {
namespace {

/// Writes values as text that reads back to the same bits, separated by blanks.
class KeyText {
public:
  template <typename... Values>
  KeyText& line(const Values&... values) {
    ((append(values), text_ << ' '), ...);
    text_ << '\n';
    return *this;
  }
  std::string text() const { return text_.str(); }

private:
  void append(double value) { text_ << shortest(value); }
  template <typename Value>
  void append(const Value& value) {
    text_ << value;
  }
  std::ostringstream text_;
};

void describe(KeyText& key, const fem::LoadSurface& surface) {
  key.line("surface", int(surface.kind), surface.boundary_id, surface.centre_m[0], surface.centre_m[1],
           surface.centre_m[2], surface.radius_m, surface.length_m);
  for (const double value : surface.axial_profile) key.line("profile", value);
}

struct Describe {
  KeyText& key;
  void operator()(const fem::SurfaceResultant& load) const {
    key.line("resultant", int(load.component));
    describe(key, load.surface);
  }
  void operator()(const fem::SeatPressure& load) const {
    key.line("pressure", load.harmonic, int(load.phase), load.coefficient, load.keeps_resultants);
    describe(key, load.surface);
  }
  void operator()(const fem::BodyForce& load) const {
    key.line("body_force", int(load.field));
    for (const int id : load.volume_ids) key.line("in", id);
  }
};

}  // namespace

const std::string& program_fingerprint() {
  static const std::string fingerprint = content_hash("/proc/self/exe");
  return fingerprint;
}

namespace {

/// Of the cells that are cut in each cycle; empty if there is none.
std::string hash_of(const std::vector<fem::RefinementCycle>& refinements) {
  std::string text;
  for (const auto& [cells, again_at_m] : refinements)
    text += fmt::format("{:016x}{:016x}", XXH3_64bits(cells.data(), sizeof(std::int32_t) * cells.size()),
                        XXH3_64bits(again_at_m.data(), sizeof(again_at_m[0]) * again_at_m.size()));
  return text;
}

void describe(KeyText& key, const fem::Body& body, const std::string& mesh_hash) {
  if (mesh_hash.empty()) throw std::logic_error("the mesh of " + body.mesh.string() + " has no hash");
  key.line("program", program_fingerprint())
      .line("mesh", mesh_hash)
      .line("degree", body.degree)
      .line("refinements", hash_of(body.refinements))
      .line("material", body.material.youngs_modulus_Pa, body.material.poisson_ratio,
            body.material.density_kg_m3);
  for (const auto& [volume, material] : body.material_of_volume)
    key.line("material of", volume, material.youngs_modulus_Pa, material.poisson_ratio,
             material.density_kg_m3);
  for (const auto& c : body.cylinders)
    key.line("cylinder", c.volume_id, c.shift_x_m, c.shift_y_m, c.inner_radius_m, c.outer_radius_m,
             c.axis_x_m, c.axis_y_m);
  for (const auto& t : body.tori)
    key.line("torus", t.boundary_id, t.centre_z_m, t.centre_radius_m, t.radius_m);
}

}  // namespace

std::string body_key(const fem::Body& body, const std::string& mesh_hash) {
  KeyText key;
  describe(key, body, mesh_hash);
  return key.text();
}

std::string response_key(const fem::Body& body, const std::string& mesh_hash,
                         const std::vector<fem::UnitLoad>& loads,
                         const std::vector<fem::SectionPlane>& planes, fem::Solver solver, int n_threads) {
  KeyText key;
  describe(key, body, mesh_hash);
  key.line("threads", n_threads).line("solver", int(solver));
  for (const auto& support : body.elastic_supports) {
    key.line("springs", support.stiffness_N_m[0], support.stiffness_N_m[1], support.stiffness_N_m[2]);
    describe(key, support.surface);
  }
  for (const auto& clamp : body.clamps)
    key.line("clamp", clamp.boundary_id, clamp.fixed[0], clamp.fixed[1], clamp.fixed[2],
             clamp.only_at_z_m ? shortest(*clamp.only_at_z_m) : "");
  for (const auto& load : loads) {
    key.line("load", load.channel);
    std::visit(Describe{key}, load.shape);
  }
  for (const auto& p : planes) key.line("plane", p.z_m, p.radius_m, p.axis_x_m, p.axis_y_m, p.inner_radius_m);
  return key.text();
}

}  // namespace pipelines
