/// Damage to files by chance, of the kinds that editors, disks, mail, exporters and people do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace fuzz {

/// What a damaged text is in. Most damage to scenes and tables is to their numbers, so that they stay
/// readable and the stages behind the reader are met.
enum class Grammar { toml, csv, json, step, msh, bytes };

/// The same seed gives the same damage, on any machine.
class Mutator {
public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  /// A number below n; 0 if n is 0.
  std::size_t below(std::size_t n) { return n == 0 ? 0 : std::size_t(random_() % n); }
  bool one_in(std::size_t n) { return below(n) == 0; }
  /// In [0, 1).
  double share() { return double(random_() >> 11) * 0x1p-53; }
  template <typename List>
  const auto& one_of(const List& list) {
    return list[below(list.size())];
  }

  /// One damage or several, most often one.
  /// @param other  a text of the same grammar: some damage puts the end of it behind the beginning of `text`
  std::string damage(std::string text, Grammar grammar, const std::string& other);

  /// What has been done to texts so far: "bit flipped, line missing".
  const std::string& deeds() const { return deeds_; }

private:
  std::mt19937_64 random_;
  std::string deeds_;
};

}  // namespace fuzz
