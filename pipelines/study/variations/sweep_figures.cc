#include "pipelines/study/variations/sweep_figures.h"

#include <limits>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace pipelines {

/// Names of figures. They do not change once they are shared, but for the places by name, which are found
/// when they are asked for.
class SweepFigures::Names {
public:
  struct Column {
    std::string name, unit;
  };

  Names() = default;
  /// The first n of another one's.
  Names(const Names& other, std::size_t n)
      : columns(other.columns.begin(), other.columns.begin() + std::ptrdiff_t(n)) {}

  /// columns.size() if there is none of that name.
  std::size_t place_of(const std::string& name) const {
    const std::lock_guard lock(placing_);
    for (; n_placed_ < columns.size(); ++n_placed_) places_.emplace(columns[n_placed_].name, n_placed_);
    const auto found = places_.find(name);
    return found == places_.end() ? columns.size() : found->second;
  }

  std::vector<Column> columns;

private:
  mutable std::mutex placing_;
  mutable std::size_t n_placed_ = 0;
  mutable std::unordered_map<std::string, std::size_t> places_;
};

namespace {

bool is_joined_of(std::string_view whole, std::initializer_list<std::string_view> parts) {
  for (const auto part : parts) {
    if (whole.substr(0, part.size()) != part) return false;
    whole.remove_prefix(part.size());
  }
  return whole.empty();
}

std::string joined_parts(std::initializer_list<std::string_view> parts) {
  std::string whole;
  for (const auto part : parts) whole += part;
  return whole;
}

}  // namespace

SweepFigures::SweepFigures(std::initializer_list<SweepFigure> figures) {
  for (const auto& figure : figures) add({figure.name}, figure.unit, figure.value);
}

SweepFigures SweepFigures::like(const SweepFigures& other) {
  SweepFigures figures;
  figures.names_ = other.names_;
  if (other.names_) figures.values_.reserve(other.names_->columns.size());
  return figures;
}

SweepFigures::Item SweepFigures::operator[](std::size_t i) const {
  const auto& column = names_->columns[i];
  return {column.name, column.unit, values_[i]};
}

void SweepFigures::add(std::initializer_list<std::string_view> name, std::string_view unit, double value) {
  const std::size_t n = values_.size();
  const bool is_known = names_ && n < names_->columns.size() && is_joined_of(names_->columns[n].name, name) &&
                        names_->columns[n].unit == unit;
  if (!is_known) {
    const bool is_own = names_ && names_.use_count() == 1 && n == names_->columns.size();
    if (!is_own) names_ = names_ ? std::make_shared<Names>(*names_, n) : std::make_shared<Names>();
    names_->columns.push_back({joined_parts(name), std::string(unit)});
  }
  values_.push_back(value);
}

double SweepFigures::value(const std::string& name) const {
  const std::size_t i = names_ ? names_->place_of(name) : 0;
  return i < values_.size() ? values_[i] : std::numeric_limits<double>::quiet_NaN();
}

bool SweepFigures::share_names(const SweepFigures& other) const noexcept {
  return names_ == other.names_ && values_.size() == other.values_.size();
}

}  // namespace pipelines
