#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// The names of landmarks as a table is read: not empty, at most 10,000 bytes, at most 5000.
class NameList {
 public:
  explicit NameList(const std::string& source) : source_(source) {}

  /// Adds a name that must be new. @throws IoError at `line`, naming the other line too.
  Eigen::Index add(std::string_view name, std::size_t line);

  /// The place of a name, added if it is new. @throws IoError as add().
  Eigen::Index find_or_add(std::string_view name, std::size_t line);

  const std::vector<std::string>& names() const { return names_; }
  /// "line 7", of each name.
  const std::vector<std::string>& places() const { return places_; }

 private:
  const std::string& source_;
  std::vector<std::string> names_;
  std::vector<std::string> places_;
  std::map<std::string, Eigen::Index, std::less<>> index_;
};

}  // namespace mapproof
