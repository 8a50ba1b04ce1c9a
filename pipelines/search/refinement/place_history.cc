#include "pipelines/search/refinement/place_history.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "pipelines/base/names/name_lists.h"

namespace pipelines {
namespace {

/// P. J. Roache, Verification and Validation in Computational Science and Engineering (1998), 5.6.
constexpr double safety_of_changes = 1.25;

bool is_fillet(const std::string& feature) {
  return feature.rfind("fillet ", 0) == 0;
}

double order_at(const std::string& feature, const MeshStep& step) {
  if (contains(step.coarse, feature)) return 1;
  if (step.part == MeshPart::all) return step.order;
  return is_fillet(feature) ? step.order : 1;
}

bool refines(const MeshStep& step, const std::string& feature) {
  return step.ratio > 1 && (step.features.empty() || contains(step.features, feature));
}

const PlaceStress* find(const std::vector<PlaceStress>& places, const std::string& feature) {
  const auto place =
      std::find_if(places.begin(), places.end(), [&](const auto& p) { return p.feature == feature; });
  return place == places.end() ? nullptr : &*place;
}

/// What a second model makes of an error.
double bounded_by(const SecondModel& model, const PlaceStress& place, double error_Pa) {
  const auto* other = find(model.places, place.feature);
  if (other == nullptr) return error_Pa;
  if (model.model_error > 0)
    return std::max(error_Pa, (1 - model.model_error) * other->value_Pa - other->error_Pa - place.value_Pa);
  const double difference_Pa = std::abs(place.value_Pa - other->value_Pa),
               most_Pa = difference_Pa + other->error_Pa;
  const bool agree = difference_Pa <= error_Pa + other->error_Pa;
  return agree ? std::clamp(error_Pa, difference_Pa, most_Pa) : most_Pa;
}

}  // namespace

std::string to_string(MeshPart part) {
  switch (part) {
    case MeshPart::fillets:
      return "fillets";
    case MeshPart::around:
      return "around";
    case MeshPart::along:
      return "along";
    case MeshPart::through:
      return "through";
    case MeshPart::local:
      return "local";
    case MeshPart::all:
      return "all";
  }
  throw std::logic_error("unknown part of a mesh");
}

void PlaceHistory::add(const std::vector<PlaceStress>& now, const std::optional<MeshStep>& step) {
  order_.clear();
  for (const auto& place : now) {
    order_.push_back(place.feature);
    const auto known = records_.find(place.feature);
    if (known == records_.end()) {
      records_[place.feature].now = place;
      continue;
    }
    auto& record = known->second;
    if (step && refines(*step, place.feature)) {
      record.missing_Pa[step->part] = std::abs(place.value_Pa - record.now.value_Pa) /
                                      (std::pow(step->ratio, order_at(place.feature, *step)) - 1);
      ++record.n_changes;
    }
    record.now = place;
  }
}

double PlaceHistory::missing_Pa(const Record& record) {
  double sum_Pa = 0;
  for (const auto& [part, part_Pa] : record.missing_Pa) sum_Pa += part_Pa;
  return safety_of_changes * sum_Pa;
}

double PlaceHistory::from_changes(const Record& record) const {
  const bool all_varied = std::all_of(parts_.begin(), parts_.end(),
                                      [&](MeshPart part) { return record.missing_Pa.count(part) > 0; });
  const bool is_solved_twice =
      second_ && second_->model_error == 0 && find(second_->places, record.now.feature) != nullptr;
  const TrustInMeshes trust = is_solved_twice ? TrustInMeshes{} : trust_;
  const double kept = !all_varied || record.now.is_resolved   ? 1
                      : record.n_changes > int(parts_.size()) ? trust.kept_after_more
                                                              : trust.kept_after_one;
  const bool is_known = record.n_changes > 0 || record.now.is_resolved || record.now.has_fine_cells;
  const double open_Pa = is_known ? 0 : trust.open_on_one_mesh * record.now.value_Pa;
  return std::max({missing_Pa(record), kept * record.now.error_Pa, record.now.least_error_Pa, open_Pa});
}

std::vector<PlaceStress> PlaceHistory::judged() const {
  std::vector<PlaceStress> places;
  for (const auto& feature : order_) {
    const Record& record = records_.at(feature);
    places.push_back(record.now);
    places.back().error_Pa = from_changes(record);
    if (second_) places.back().error_Pa = bounded_by(*second_, record.now, places.back().error_Pa);
  }
  return places;
}

bool PlaceHistory::is_explained(const Record& record) const {
  if (!second_ || second_->model_error > 0) return false;
  return bounded_by(*second_, record.now, from_changes(record)) <= missing_Pa(record);
}

std::vector<MeshPart> PlaceHistory::by_promise(const std::string& feature) const {
  const auto found = records_.find(feature);
  auto parts = parts_;
  if (found == records_.end()) return parts;
  const Record& record = found->second;
  const auto is_varied = [&](MeshPart part) { return record.missing_Pa.count(part) > 0; };
  // Seldom the cause: tried once the others do not explain what the second model finds.
  const auto comes_last = [&](MeshPart part) {
    return part == MeshPart::through || (part == MeshPart::fillets && !is_fillet(feature));
  };
  const bool others_varied = std::all_of(parts.begin(), parts.end(),
                                         [&](MeshPart part) { return comes_last(part) || is_varied(part); });
  const bool has_second = second_ && second_->model_error == 0;
  const bool can_wait = has_second && (!others_varied || is_explained(record));
  const auto worth = [&](MeshPart part) {
    if (is_varied(part)) return record.missing_Pa.at(part);
    return comes_last(part) && can_wait ? -1.0 : std::numeric_limits<double>::infinity();
  };
  std::stable_sort(parts.begin(), parts.end(), [&](MeshPart a, MeshPart b) { return worth(a) > worth(b); });
  return parts;
}

}  // namespace pipelines
