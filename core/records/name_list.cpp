#include "core/records/name_list.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/records/limits.hpp"
#include "core/records/text_input.hpp"

namespace mapproof {

Eigen::Index NameList::add(std::string_view name, std::size_t line) {
  if (const auto other = index_.find(name); other != index_.end())
    throw IoError(source_, fmt::format("line {}", line),
                  fmt::format("landmark {} is already on {}", in_quotes(name),
                              places_[static_cast<std::size_t>(other->second)]));
  return find_or_add(name, line);
}

Eigen::Index NameList::find_or_add(std::string_view name, std::size_t line) {
  if (const auto known = index_.find(name); known != index_.end()) return known->second;
  const std::string place = fmt::format("line {}", line);
  if (name.empty()) throw IoError(source_, place, "a landmark without a name");
  if (name.size() > kLongestName)
    throw IoError(source_, place,
                  fmt::format("a name of {} bytes; at most {}", name.size(), kLongestName));
  if (names_.size() == kMostLandmarks)
    throw IoError(source_, place, fmt::format("more than {} landmarks", kMostLandmarks));
  const auto index = static_cast<Eigen::Index>(names_.size());
  index_.emplace(std::string(name), index);
  names_.emplace_back(name);
  places_.push_back(place);
  return index;
}

}  // namespace mapproof
