#pragma once

#include <map>
#include <string>

namespace mapproof {

/// What a study itself calls its setups and methods, by their ids.
struct StudyLabels {
  std::map<std::string, std::string> setups = {};
  /// Of every method that is not one of mapproof's own, its id where the study has no other word
  /// for it.
  std::map<std::string, std::string> methods = {};

  bool operator==(const StudyLabels&) const = default;
};

}  // namespace mapproof
