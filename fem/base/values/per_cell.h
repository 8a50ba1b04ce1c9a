/// A value of each cell. Internal to fem.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace fem {

/// One value for all cells, or a few of them and which one each cell has. Copies share the latter.
template <typename T>
class PerCell {
public:
  PerCell(const T& everywhere) : values_{everywhere} {}  // NOLINT(google-explicit-constructor)
  PerCell(std::vector<T> values, std::shared_ptr<const std::vector<std::int32_t>> which)
      : values_(std::move(values)), which_(std::move(which)) {}

  const T& operator[](std::size_t cell) const { return values_[which_ ? (*which_)[cell] : 0]; }

private:
  std::vector<T> values_;
  std::shared_ptr<const std::vector<std::int32_t>> which_;
};

}  // namespace fem
