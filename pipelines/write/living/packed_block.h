/// Arrays of numbers as one block inside a page.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipelines/base/fields/json_values.h"

namespace pipelines {

/// Sections of 8 to 32 bits a number. Each is split into planes, the lowest bytes of all numbers first: small
/// numbers then have planes that are nearly empty, which deflates to half.
class PackedBlock {
public:
  void add(const std::string& name, const std::vector<std::int16_t>& values);
  void add(const std::string& name, const std::vector<std::uint16_t>& values);
  void add(const std::string& name, const std::vector<std::uint32_t>& values);
  void add(const std::string& name, const std::vector<float>& values);
  void add(const std::string& name, const std::vector<std::uint8_t>& values);

  /// Adds numbers in 16 bits between their smallest and largest.
  /// @return [smallest, largest]
  summary::Json add_range(const std::string& name, const std::vector<double>& values);

  /// By name: [kind, first byte, count]; kinds are i16, u16, u32, f32 and u8.
  const summary::Json& index() const { return index_; }

  /// All sections, deflated (zlib, RFC 1950).
  std::string deflated() const;

private:
  template <typename Number>
  void append(const std::string& name, const char* kind, const std::vector<Number>& values);

  std::string bytes_;
  summary::Json index_ = summary::Json::object();
};

}  // namespace pipelines
