/// The headline figures of a sweep's point, by name. Points mostly have the same figures, some two hundred of
/// them: rows share the list of names and hold their values.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace pipelines {

struct SweepFigure {
  std::string name, unit;  ///< as in summary.json: "bodies.shaft.governing", "Pa"
  double value = 0;
};

/// Copies may be read and changed in several threads, each its own.
class SweepFigures {
public:
  /// A name may be there twice: the first counts.
  class Names;
  /// One figure, as long as its list is there.
  struct Item {
    const std::string& name;
    const std::string& unit;
    double value;
  };
  class Iterator;

  SweepFigures() = default;
  SweepFigures(std::initializer_list<SweepFigure> figures);
  /// Empty; takes the names of another one as long as what is added has them.
  static SweepFigures like(const SweepFigures& other);

  std::size_t size() const noexcept { return values_.size(); }
  bool empty() const noexcept { return values_.empty(); }
  Item operator[](std::size_t i) const;
  Iterator begin() const;
  Iterator end() const;

  /// @param name  in parts, which are not joined if another row has it
  void add(std::initializer_list<std::string_view> name, std::string_view unit, double value);

  /// NaN if there is none.
  double value(const std::string& name) const;
  /// Surely the same names and units, in the same order; false: they may be the same still.
  bool share_names(const SweepFigures& other) const noexcept;

private:
  std::shared_ptr<Names> names_;  ///< may go on behind the last value; null: no figure
  std::vector<double> values_;
};

class SweepFigures::Iterator {
public:
  using iterator_category = std::input_iterator_tag;
  using value_type = Item;
  using difference_type = std::ptrdiff_t;
  using pointer = void;
  using reference = Item;

  Iterator(const SweepFigures& figures, std::size_t at) : figures_(&figures), at_(at) {}
  Item operator*() const { return (*figures_)[at_]; }
  Iterator& operator++() {
    ++at_;
    return *this;
  }
  bool operator==(const Iterator& other) const { return at_ == other.at_; }
  bool operator!=(const Iterator& other) const { return at_ != other.at_; }

private:
  const SweepFigures* figures_;
  std::size_t at_;
};

inline SweepFigures::Iterator SweepFigures::begin() const {
  return {*this, 0};
}
inline SweepFigures::Iterator SweepFigures::end() const {
  return {*this, size()};
}

}  // namespace pipelines
