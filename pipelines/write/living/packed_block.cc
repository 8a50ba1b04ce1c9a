#include "pipelines/write/living/packed_block.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace pipelines {

template <typename Number>
void PackedBlock::append(const std::string& name, const char* kind, const std::vector<Number>& values) {
  index_[name] = summary::Json::array({kind, bytes_.size(), values.size()});
  const auto first = bytes_.size();
  bytes_.resize(first + values.size() * sizeof(Number));
  for (std::size_t i = 0; i < values.size(); ++i) {
    char own[sizeof(Number)];
    std::memcpy(own, &values[i], sizeof(Number));  // little-endian, as all machines that this is built for
    for (std::size_t plane = 0; plane < sizeof(Number); ++plane)
      bytes_[first + plane * values.size() + i] = own[plane];
  }
}

void PackedBlock::add(const std::string& name, const std::vector<std::int16_t>& values) {
  append(name, "i16", values);
}

void PackedBlock::add(const std::string& name, const std::vector<std::uint16_t>& values) {
  append(name, "u16", values);
}

void PackedBlock::add(const std::string& name, const std::vector<std::uint32_t>& values) {
  append(name, "u32", values);
}

void PackedBlock::add(const std::string& name, const std::vector<float>& values) {
  append(name, "f32", values);
}

void PackedBlock::add(const std::string& name, const std::vector<std::uint8_t>& values) {
  append(name, "u8", values);
}

summary::Json PackedBlock::add_range(const std::string& name, const std::vector<double>& values) {
  constexpr double steps = 65535;
  if (values.empty()) {
    add(name, std::vector<std::uint16_t>());
    return summary::Json::array({0.0, 0.0});
  }
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double span = *most > *least ? *most - *least : 1;
  std::vector<std::uint16_t> rounded(values.size());
  std::transform(values.begin(), values.end(), rounded.begin(), [&, low = *least](double value) {
    return std::uint16_t(std::lround((value - low) / span * steps));
  });
  add(name, rounded);
  return summary::Json::array({summary::number(*least), summary::number(*least + span)});
}

std::string PackedBlock::deflated() const {
  auto size = compressBound(bytes_.size());
  std::string bytes(size, '\0');
  constexpr int level = 6;  // 9 takes four times as long for a hundredth
  if (compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(bytes_.data()),
                bytes_.size(), level) != Z_OK)
    throw std::runtime_error("zlib does not compress the data of report.html");
  bytes.resize(size);
  return bytes;
}

}  // namespace pipelines
