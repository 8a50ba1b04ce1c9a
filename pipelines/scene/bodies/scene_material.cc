#include "pipelines/scene/bodies/scene_material.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "pipelines/base/names/nearest_name.h"
#include "pipelines/scene/materials/material_library.h"

namespace pipelines {
namespace {

constexpr double not_read = std::numeric_limits<double>::quiet_NaN();

/// A quantity of the material table.
struct MaterialKey {
  const char* name;
  const char* unit;
  Range range;
};

const MaterialKey modulus_key{"youngs_modulus", "Pa", between(1e8, 2e12)};
const MaterialKey poisson_key{"poisson_ratio", "1", between(0, 0.4999)};
const MaterialKey density_key{"density", "kg/m3", between(100, 30000)};
const MaterialKey yield_key{"yield_strength", "Pa", between(1e6, 1e10)};
const MaterialKey tensile_key{"tensile_strength", "Pa", between(1e7, 3e9)};

/// Size of the body by which the library's strengths are chosen.
struct GoverningSize {
  double size_m = 0;  ///< 0: not known
  std::string text;   ///< "largest section 60 mm"
};

GoverningSize size_of(const ShaftShape& shaft) {
  GoverningSize size;
  for (const auto& segment : shaft.geometry.segments)
    size.size_m = std::max(size.size_m, segment.diameter_m - segment.bore_m);
  size.text = fmt::format("largest section {:.4g} mm", 1e3 * size.size_m);
  return size;
}

GoverningSize size_of(const ChamberShape& chamber) {
  const auto& g = chamber.geometry;
  const double housing_m = g.housing.outer_radius_m - g.housing.bore_radius_m,
               pad_m = std::min({g.pads.size_x_m, g.pads.size_y_m, g.pads.size_z_m});
  const double size_m = std::max(
      {g.tube.wall_m, g.flanges.thickness_m, g.webs.thickness_m, g.lugs.thickness_m, housing_m, pad_m});
  return {size_m, fmt::format("thickest member {:.4g} mm", 1e3 * size_m)};
}

GoverningSize size_of(const meshes::Import&) {
  return {};
}

GoverningSize read_size(SceneTable& material, const BodyScene& body) {
  if (!material.is_given("thickness"))
    return std::visit([](const auto& shape) { return size_of(shape); }, body.shape);
  const double size_m = material.quantity("thickness", "m", positive(10));
  return {size_m, fmt::format("thickness {:.4g} mm", 1e3 * size_m)};
}

/// Reads one material: what the scene leaves out comes from the library, if that has its name.
class MaterialReader {
public:
  /// @param place  reports what is wrong with the name, at `key`
  MaterialReader(SceneTable& material, SceneTable& place, std::string key, BodyScene& body)
      : material_(material), place_(place), key_(std::move(key)), body_(body) {
    entry_ = find_material(body.material_name);
    const auto size = read_size(material_, body_);
    if (entry_ != nullptr) choose_range(size);
  }

  KnownStrength read() {
    if (entry_ == nullptr && !body_.material_name.empty()) refuse_if_incomplete();
    body_.material.youngs_modulus_Pa =
        constant(modulus_key, entry_ ? entry_->youngs_modulus_Pa : 0, 1e9, "GPa");
    body_.material.poisson_ratio = constant(poisson_key, entry_ ? entry_->poisson_ratio : 0, 1, "");
    body_.material.density_kg_m3 = constant(density_key, entry_ ? entry_->density_kg_m3 : 0, 1, "kg/m3");
    body_.yield_strength_Pa = yield();
    KnownStrength strength;
    strength.group = group();
    read_tensile(strength);
    return strength;
  }

private:
  void choose_range(const GoverningSize& size) {
    if (size.size_m > 0)
      range_ = range_of(*entry_, size.size_m);
    else
      range_ = &weakest_range(*entry_);
    if (range_ == nullptr) {
      too_thick_ =
          fmt::format("{} has strengths up to {:g} mm in {}, and the body is larger ({})", entry_->name,
                      1e3 * entry_->ranges.back().up_to_m, entry_->standard, size.text);
      return;
    }
    source_ = fmt::format("{}, {}, {}", entry_->name, range_text(*entry_, *range_), entry_->standard);
    chosen_by_ = size.size_m > 0 ? size.text : "the weakest of all sizes: thickness is not given";
  }

  /// Refuses a material's name that the library does not have, unless all keys are given.
  void refuse_if_incomplete() {
    std::vector<std::string> missing;
    for (const auto* key : {&modulus_key, &poisson_key, &density_key, &yield_key}) {
      if (!material_.is_given(key->name)) missing.emplace_back(key->name);
    }
    const auto written = material_.names();
    missing.erase(std::remove_if(missing.begin(), missing.end(),
                                 [&](const auto& name) { return is_misspelt(name, written); }),
                  missing.end());
    if (missing.empty()) return;
    is_told_ = true;
    const auto near = near_materials(body_.material_name);
    place_.refuse(key_, "is not in the library of materials" +
                            (near.empty() ? std::string(" (millstress materials lists it)")
                                          : "; the nearest of it: " + listed(near)) +
                            "; write one of its names, or add " + listed(missing));
  }

  /// Whether the key is written with a wrong name, by which it is reported.
  static bool is_misspelt(const std::string& name, const std::vector<std::string>& written) {
    return std::any_of(written.begin(), written.end(), [&](const auto& other) {
      return other != "thickness" && other != "tensile_strength" && nearest_name(other, {name}) == name;
    });
  }

  double constant(const MaterialKey& key, double of_library, double shown_in, const char* unit) {
    if (material_.has(key.name)) return material_.quantity(key.name, key.unit, key.range);
    if (entry_ == nullptr) return missing(key);
    material_.know(key.name);
    material_.record_default(
        key.name, fmt::format("{:g}{}{}", of_library / shown_in, *unit == 0 ? "" : " ", unit), entry_->name);
    return of_library;
  }

  double missing(const MaterialKey& key) {
    return is_told_ ? not_read : material_.quantity(key.name, key.unit, key.range);
  }

  double yield() {
    if (material_.has(yield_key.name)) return material_.quantity(yield_key.name, "Pa", yield_key.range);
    if (entry_ == nullptr) return missing(yield_key);
    material_.know(yield_key.name);
    if (range_ == nullptr) {
      place_.refuse(key_, too_thick_ + "; add yield_strength, and tensile_strength for its fatigue");
      return not_read;
    }
    record_strength(yield_key, range_->yield_Pa, "R_e");
    return range_->yield_Pa;
  }

  void record_strength(const MaterialKey& key, double value_Pa, const char* symbol) {
    body_.strength_source = source_;
    material_.record_default(key.name, fmt::format("{:g} MPa", value_Pa / 1e6),
                             fmt::format("{} of {}; {}", symbol, source_, chosen_by_));
  }

  MaterialGroup group() {
    if (!material_.is_given("group")) return entry_ == nullptr ? MaterialGroup::steel : entry_->group;
    const auto name = material_.text("group");
    std::vector<std::string> names;
    for (const auto& group : material_groups()) {
      if (name == group.name) return group.group;
      names.emplace_back(group.name);
    }
    if (!name.empty()) material_.refuse("group", "is no material group; write one of " + listed(names));
    return MaterialGroup::steel;
  }

  void read_tensile(KnownStrength& strength) {
    if (material_.is_given(tensile_key.name)) {
      strength.tensile_Pa = material_.quantity(tensile_key.name, "Pa", tensile_key.range);
      if (strength.tensile_Pa < body_.yield_strength_Pa)
        material_.refuse(tensile_key.name, "is below the material's yield_strength; correct one of them");
      return;
    }
    const auto remedy = fmt::format("; add it: [{}] tensile_strength = \"... MPa\"", material_.key());
    if (range_ == nullptr)
      strength.why_none =
          entry_ == nullptr ? "the tensile strength of \"" + body_.material_name + "\" is not known" + remedy
                            : too_thick_ + remedy;
    else if (body_.yield_strength_Pa > range_->tensile_Pa)
      strength.why_none =
          fmt::format("yield_strength = {:.4g} MPa is above the tensile strength of {}, {:.4g} MPa{}",
                      body_.yield_strength_Pa / 1e6, source_, range_->tensile_Pa / 1e6, remedy);
    else {
      strength.tensile_Pa = range_->tensile_Pa;
      strength.source = source_;
      record_strength(tensile_key, range_->tensile_Pa, "R_m");
    }
  }

  SceneTable& material_;
  SceneTable& place_;
  std::string key_;
  BodyScene& body_;
  const LibraryMaterial* entry_ = nullptr;
  const StrengthRange* range_ = nullptr;
  std::string source_, chosen_by_, too_thick_;
  bool is_told_ = false;
};

}  // namespace

KnownStrength read_material(SceneTable& table, BodyScene& body, SceneFindings& findings) {
  static const TomlNode no_keys;
  if (table.has_text("material")) {
    body.material_name = table.text("material");
    SceneTable material(no_keys, table.key() + ".material", findings);
    return MaterialReader(material, table, "material", body).read();
  }
  auto material = table.table("material");
  body.material_name = material.text("name");
  const auto strength = MaterialReader(material, material, "name", body).read();
  material.finish();
  return strength;
}

}  // namespace pipelines
