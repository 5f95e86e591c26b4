#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace mapproof {

/// Which set each of n elements is of, as sets are merged step by step [tarjan1984].
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  /// The element that stands for the set of another.
  std::size_t of(std::size_t element) {
    while (parent_[element] != element)
      element = parent_[element] = parent_[parent_[element]];
    return element;
  }

  /// Makes one set of those of `a` and `b`: what stands for that of `b` stands for it.
  /// @return Whether they were two.
  bool merge(std::size_t a, std::size_t b) {
    const std::size_t from = of(a), to = of(b);
    parent_[from] = to;
    return from != to;
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace mapproof
