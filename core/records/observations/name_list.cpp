#include "core/records/observations/name_list.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"

namespace mapproof {

bool is_word_for_names(std::string_view cell) {
  const std::string word = lower_case(cell);
  return word == "name" || word == "landmark" || word == "object" || word == "id";
}

Eigen::Index NameList::add(std::string_view name, std::size_t line) {
  if (const auto other = index_.find(name); other != index_.end())
    throw IoError(source_, fmt::format("line {}", line),
                  fmt::format("landmark {} is already on {}", in_quotes(name),
                              locations_[static_cast<std::size_t>(other->second)]));
  return find_or_add(name, line);
}

Eigen::Index NameList::find_or_add(std::string_view name, std::size_t line) {
  if (const auto known = index_.find(name); known != index_.end()) return known->second;
  const std::string location = fmt::format("line {}", line);
  if (name.empty()) throw IoError(source_, location, "a landmark without a name");
  if (name.size() > kLongestName)
    throw IoError(source_, location,
                  fmt::format("a name of {} bytes; at most {}", name.size(), kLongestName));
  if (names_.size() == kMostLandmarks)
    throw IoError(source_, location, fmt::format("more than {} landmarks", kMostLandmarks));
  const auto index = static_cast<Eigen::Index>(names_.size());
  index_.emplace(std::string(name), index);
  names_.emplace_back(name);
  locations_.push_back(location);
  return index;
}

NamedPoints named_points(const NameList& names, const std::vector<double>& coordinates,
                         const std::string& source) {
  if (coordinates.empty()) throw IoError(source, "holds no landmarks");
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
  return {.names = names.names(),
          .positions_m = Eigen::Map<const RowMajor>(
              coordinates.data(), static_cast<Eigen::Index>(names.names().size()), 2),
          .locations = names.locations()};
}

}  // namespace mapproof
