#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>

namespace mapproof {

/// xoshiro256** [blackman2021] with transforms of our own: the same numbers with every standard
/// library, since those of std differ between them.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  std::uint64_t next();
  /// In [0, 1), 53 bits.
  double uniform();
  /// In [low, high).
  double uniform(double low, double high);
  /// Standard normal, by the polar method.
  double normal();

 private:
  std::array<std::uint64_t, 4> state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

/// A seed for one part of a whole: different for different `keys`, in any number.
std::uint64_t derive_seed(std::uint64_t seed, std::initializer_list<std::uint64_t> keys);

}  // namespace mapproof
