#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "core/records/observations/sources.hpp"

namespace mapproof {

/// Whether a header's cell names the column of names: name, landmark, object or id, in any case.
bool is_word_for_names(std::string_view cell);

/// The names of landmarks as a table is read: not empty, at most kLongestName bytes, at most
/// kMostLandmarks of them (see limits.hpp).
class NameList {
 public:
  explicit NameList(const std::string& source) : source_(source) {}

  /// Adds a name that must be new. @throws IoError at `line`, naming the other line too.
  Eigen::Index add(std::string_view name, std::size_t line);

  /// The index of a name, added if it is new. @throws IoError as add().
  Eigen::Index find_or_add(std::string_view name, std::size_t line);

  const std::vector<std::string>& names() const { return names_; }
  /// "line 7", of each name.
  const std::vector<std::string>& locations() const { return locations_; }

 private:
  /// Of names that are not copied to be looked up: each row of a long table has one.
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view name) const {
      return std::hash<std::string_view>()(name);
    }
  };

  const std::string& source_;
  std::vector<std::string> names_;
  std::vector<std::string> locations_;
  std::unordered_map<std::string, Eigen::Index, Hash, std::equal_to<>> index_;
};

/// The landmarks of a whole table. @param coordinates  x and y of each name in turn.
/// @throws IoError if there are none.
NamedPoints named_points(const NameList& names, const std::vector<double>& coordinates,
                         const std::string& source);

}  // namespace mapproof
