/// A list whose copies are one list until one of them is changed: copies cost nothing.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace pipelines {

/// Reads like a constant std::vector. T may be incomplete where the list is a member.
/// Copies may be read and changed in several threads, each its own.
template <typename T>
class SharedList {
public:
  std::size_t size() const { return items_ ? items_->size() : 0; }
  bool empty() const { return size() == 0; }
  const T* begin() const { return items_ ? items_->data() : nullptr; }
  const T* end() const { return begin() + size(); }
  const T& operator[](std::size_t i) const { return (*items_)[i]; }
  /// @throws std::out_of_range
  const T& at(std::size_t i) const { return i < size() ? (*this)[i] : throw std::out_of_range("SharedList"); }
  const T& front() const { return items_->front(); }
  const T& back() const { return items_->back(); }

  /// The items of this copy alone, to be changed.
  std::vector<T>& own() {
    if (!items_)
      items_ = std::make_shared<std::vector<T>>();
    else if (items_.use_count() > 1)
      items_ = std::make_shared<std::vector<T>>(*items_);
    return *items_;
  }
  void push_back(T item) { own().push_back(std::move(item)); }

private:
  std::shared_ptr<std::vector<T>> items_;  ///< null: empty
};

}  // namespace pipelines
