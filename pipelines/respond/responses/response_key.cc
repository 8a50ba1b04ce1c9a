#include "pipelines/respond/responses/response_key.h"

#include <fmt/core.h>
#include <xxhash.h>

#include <sstream>
#include <stdexcept>

#include "pipelines/base/files/content_hash.h"
#include "pipelines/base/files/csv.h"

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

template <typename Value>
std::string hash_of(const std::vector<Value>& values) {
  return fmt::format("{:016x}", XXH3_64bits(values.data(), sizeof(Value) * values.size()));
}

std::string hash_of(const fem::CoarseMesh& mesh) {
  return std::to_string(int(mesh.kind)) + hash_of(mesh.points_m) + hash_of(mesh.cells) +
         hash_of(mesh.volume_id) + hash_of(mesh.faces) + hash_of(mesh.face_id);
}

/// Hash of the cells that are cut in each cycle; empty if there is none.
std::string hash_of(const std::vector<fem::RefinementCycle>& refinements) {
  std::string text;
  for (const auto& [cells, again_at_m] : refinements) text += hash_of(cells) + hash_of(again_at_m);
  return text;
}

void describe(KeyText& key, const fem::Body& body) {
  if (!body.mesh) throw std::logic_error("a body without a mesh has no key");
  key.line("program", program_fingerprint())
      .line("mesh", hash_of(*body.mesh))
      .line("degree", body.degree)
      .line("refinements", hash_of(body.refinements))
      .line("material", body.material.youngs_modulus_Pa, body.material.poisson_ratio,
            body.material.density_kg_m3);
  for (const auto& c : body.cylinders)
    key.line("cylinder", c.volume_id, c.shift_x_m, c.shift_y_m, c.inner_radius_m, c.outer_radius_m,
             c.axis_x_m, c.axis_y_m);
  for (const auto& t : body.tori)
    key.line("torus", t.boundary_id, t.centre_z_m, t.centre_radius_m, t.radius_m);
}

void describe(KeyText& key, const fem::UnitLoad& load) {
  key.line("load", load.channel);
  std::visit(Describe{key}, load.shape);
}

}  // namespace

std::string load_key(const fem::UnitLoad& load) {
  KeyText key;
  describe(key, load);
  return key.text();
}

std::string response_key(const fem::Body& body, const std::vector<fem::UnitLoad>& loads,
                         const std::vector<fem::SectionPlane>& planes, fem::Solver solver, int n_threads) {
  KeyText key;
  describe(key, body);
  key.line("threads", n_threads).line("solver", int(solver));
  for (const auto& support : body.elastic_supports) {
    key.line("springs", support.stiffness_N_m[0], support.stiffness_N_m[1], support.stiffness_N_m[2]);
    describe(key, support.surface);
  }
  for (const auto& clamp : body.clamps)
    key.line("clamp", clamp.boundary_id, clamp.fixed[0], clamp.fixed[1], clamp.fixed[2],
             clamp.only_at_z_m ? shortest(*clamp.only_at_z_m) : "");
  for (const auto& load : loads) describe(key, load);
  for (const auto& p : planes) key.line("plane", p.z_m, p.radius_m, p.axis_x_m, p.axis_y_m, p.inner_radius_m);
  return key.text();
}

}  // namespace pipelines
