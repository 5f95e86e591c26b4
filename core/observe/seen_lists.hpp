#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/model/detection_log.hpp"
#include "core/model/histories/history_blocks.hpp"

namespace mapproof {

/// What was seen of M landmarks in N steps, as lists both ways: of each landmark its steps, of each
/// step its landmarks. For visibility of which all but a small share is "not seen".
class SeenLists {
 public:
  /// @param history  Of visibility; above 0 is seen, all else not.
  /// @note 8 bytes for each that was seen.
  SeenLists(const HistoryBlocks& history, Eigen::Index steps);

  /// @throws InvalidInput if a detection names no landmark or no step.
  explicit SeenLists(const DetectionLog& log);

  Eigen::Index landmarks() const { return std::ssize(steps_.first) - 1; }
  Eigen::Index steps() const { return std::ssize(landmarks_.first) - 1; }

  /// At which steps a landmark was seen, ascending; and the landmarks of a step.
  std::span<const std::int32_t> steps_of(std::size_t landmark) const {
    return steps_.of(landmark);
  }
  std::span<const std::int32_t> landmarks_of(std::size_t step) const {
    return landmarks_.of(step);
  }

  /// How many groups the landmarks fall into if those of a step belong to one.
  int groups() const;

 private:
  /// The lists of some keys, one behind the other.
  struct Lists {
    std::vector<std::size_t> first;  ///< One more at the end.
    std::vector<std::int32_t> members;

    std::span<const std::int32_t> of(std::size_t key) const {
      return {members.data() + first[key], first[key + 1] - first[key]};
    }
  };

  template <typename ForEachSeen>
  void fill(Eigen::Index landmarks, Eigen::Index steps, const ForEachSeen& for_each_seen);

  Lists steps_, landmarks_;
};

/// Whether the first `steps` observations are visibility without missing entries of which lists are
/// counted faster than bits: at shares seen below 6 %, if that is the share everywhere.
bool is_sparse_visibility(const HistoryBlocks& history, Eigen::Index steps);

}  // namespace mapproof
