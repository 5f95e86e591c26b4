#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/records/observations/sources.hpp"

namespace mapproof {

/// Whether a header's cell names the column of names: name, landmark, object or id, in any case.
bool is_word_for_names(std::string_view cell);

/// The names of landmarks as a table is read: not empty, at most kLongestName bytes, at most
/// kMostLandmarks of them (see limits.hpp).
/// @note A name takes its string, and 4 bytes for its line and some 16 to find it.
class NameList {
 public:
  explicit NameList(const std::string& source) : source_(source) {}

  /// Adds a name that must be new. @throws IoError at `line`, naming the other line too.
  Eigen::Index add(std::string_view name, std::size_t line);

  /// The index of a name, added if it is new. @throws IoError as add().
  Eigen::Index find_or_add(std::string_view name, std::size_t line);

  const std::vector<std::string>& names() const { return names_; }
  /// "line 7", of each name.
  std::vector<std::string> locations() const;

  /// The names, without a copy of them; the list is empty then.
  std::vector<std::string> take() &&;

 private:
  static constexpr std::uint32_t kFree = UINT32_MAX;

  /// Where the table has the name, or would have it. @pre The table has a free place.
  std::size_t place_of(std::string_view name) const;
  void enlarge();

  const std::string& source_;
  std::vector<std::string> names_;
  std::vector<std::uint32_t> lines_;  ///< Of each name.
  std::vector<std::uint32_t> table_;  ///< Names by their hash, by index, kFree: none; half full.
};

/// The landmarks of a whole table. @param coordinates  x and y of each name in turn.
/// @throws IoError if there are none.
NamedPoints named_points(NameList names, const std::vector<double>& coordinates,
                         const std::string& source);

}  // namespace mapproof
