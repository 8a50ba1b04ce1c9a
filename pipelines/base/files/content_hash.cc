#include "pipelines/base/files/content_hash.h"

#include <xxhash.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>

#include "pipelines/base/common/errors.h"

namespace pipelines {
namespace {

constexpr auto to_the_end = std::numeric_limits<std::uintmax_t>::max();

std::string digits_of(const XXH128_hash_t& hash) {
  char digits[33];
  std::snprintf(digits, sizeof digits, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return digits;
}

}  // namespace

std::string content_hash(const std::filesystem::path& file) {
  return content_hash(file, to_the_end);
}

std::string content_hash(const std::filesystem::path& file, std::uintmax_t n_bytes) {
  std::ifstream stream(file, std::ios::binary);
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
  if (!stream || !state) throw FileError(file.string() + ": cannot be read");
  XXH3_128bits_reset(state.get());
  std::string buffer(1 << 20, '\0');
  std::uintmax_t left = n_bytes;
  while (left > 0) {
    stream.read(buffer.data(), std::streamsize(std::min<std::uintmax_t>(buffer.size(), left)));
    if (stream.gcount() <= 0) break;
    XXH3_128bits_update(state.get(), buffer.data(), std::size_t(stream.gcount()));
    left -= std::uintmax_t(stream.gcount());
  }
  if (stream.bad() || (left > 0 && n_bytes != to_the_end))
    throw FileError(file.string() + ": cannot be read to its end");
  return digits_of(XXH3_128bits_digest(state.get()));
}

std::string text_hash(std::string_view text) {
  return digits_of(XXH3_128bits(text.data(), text.size()));
}

}  // namespace pipelines
