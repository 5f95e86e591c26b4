#include "app/map_words.hpp"

namespace mapproof {

std::string observed_words(const OwnMap& map) {
  return map.observed.empty() ? observed(map.record) : map.observed;
}

std::string method_words(const OwnMap& map) {
  return map.made_by.empty() ? made_by(map.record) : map.made_by;
}

std::string what_words(const OwnMap& map) {
  return map.made_by.empty() && !map.record.of_pairs
             ? std::string()
             : method_words(map) + ", " + observed_words(map);
}

}  // namespace mapproof
