#include "core/records/observations/name_list.hpp"

#include <algorithm>
#include <functional>
#include <utility>

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

std::size_t NameList::place_of(std::string_view name) const {
  const std::size_t mask = table_.size() - 1;
  std::size_t place = std::hash<std::string_view>()(name) & mask;
  while (table_[place] != kFree && names_[table_[place]] != name) place = (place + 1) & mask;
  return place;
}

/// Keeps the table half full at most. Its size is a power of two.
void NameList::enlarge() {
  constexpr std::size_t kFirst = 16;
  if (2 * (names_.size() + 1) <= table_.size()) return;
  table_.assign(std::max(kFirst, 2 * table_.size()), kFree);
  for (std::size_t i = 0; i < names_.size(); ++i)
    table_[place_of(names_[i])] = static_cast<std::uint32_t>(i);
}

Eigen::Index NameList::add(std::string_view name, std::size_t line) {
  const std::size_t known = names_.size();
  const Eigen::Index index = find_or_add(name, line);
  if (names_.size() == known)
    throw IoError(source_, fmt::format("line {}", line),
                  fmt::format("landmark {} is already on line {}", in_quotes(name),
                              lines_[static_cast<std::size_t>(index)]));
  return index;
}

Eigen::Index NameList::find_or_add(std::string_view name, std::size_t line) {
  enlarge();
  const std::size_t place = place_of(name);
  if (table_[place] != kFree) return table_[place];
  const std::string location = fmt::format("line {}", line);
  if (name.empty()) throw IoError(source_, location, "a landmark without a name");
  if (name.size() > kLongestName)
    throw IoError(source_, location,
                  fmt::format("a name of {} bytes; at most {}", name.size(), kLongestName));
  if (names_.size() == kMostLandmarks)
    throw IoError(source_, location, fmt::format("more than {} landmarks", kMostLandmarks));
  table_[place] = static_cast<std::uint32_t>(names_.size());
  names_.emplace_back(name);
  lines_.push_back(static_cast<std::uint32_t>(line));
  return static_cast<Eigen::Index>(table_[place]);
}

std::vector<std::string> NameList::locations() const {
  std::vector<std::string> locations;
  locations.reserve(lines_.size());
  for (const std::uint32_t line : lines_) locations.push_back(fmt::format("line {}", line));
  return locations;
}

std::vector<std::string> NameList::take() && {
  table_ = {};
  return std::exchange(names_, {});
}

NamedPoints named_points(NameList names, const std::vector<double>& coordinates,
                         const std::string& source) {
  if (coordinates.empty()) throw IoError(source, "holds no landmarks");
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> positions_m(
      coordinates.data(), static_cast<Eigen::Index>(names.names().size()), 2);
  std::vector<std::string> locations = names.locations();
  return {.names = std::move(names).take(),
          .positions_m = positions_m,
          .locations = std::move(locations)};
}

}  // namespace mapproof
