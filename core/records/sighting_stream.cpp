#include "core/records/sighting_stream.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"

namespace mapproof {

void LookGatherer::end() {
  for (StreamedLook& look : open_) close(look);
}

void LookGatherer::close(StreamedLook& look) {
  if (look.sightings.empty()) return;
  std::ranges::sort(look.sightings, {}, &Sighting::landmark);
  complete_.push_back(std::move(look));
  look.sightings.clear();
}

/// The robot's look that the row is of: the one that is open, or a new one.
void LookGatherer::open(const LookKey& look, const TableRow& row) {
  const auto robot = static_cast<std::size_t>(look.robot);
  if (robot >= open_.size()) open_.resize(robot + 1);
  StreamedLook& last = open_[robot];
  if (!last.sightings.empty() && last.look == look) return;
  if (!last.sightings.empty() && look.key < last.look.key)
    throw IoError(source_, fmt::format("line {}", row.line),
                  fmt::format("{} after {}: a file that is followed lists a robot's looks in "
                              "ascending order",
                              rows_.looks().words(look.key), rows_.looks().words(last.look.key)));
  close(last);
  last.look = look;
  if (++looks_ > static_cast<std::size_t>(kMostSteps))
    throw IoError(source_, fmt::format("line {}", row.line),
                  fmt::format("more than {} looks", kMostSteps));
}

void LookGatherer::take(const TableRow& row) {
  if (!std::exchange(begun_, true) && rows_.begin(row)) return;
  const LookKey look = rows_.look_of(row);
  open(look, row);
  const Sighting seen = rows_.sighting_of(row);
  std::vector<Sighting>& sightings = open_[static_cast<std::size_t>(look.robot)].sightings;
  if (std::ranges::find(sightings, seen.landmark, &Sighting::landmark) != sightings.end())
    throw IoError(
        source_, fmt::format("line {}", row.line),
        fmt::format("landmark {} is in that look already",
                    in_quotes(rows_.names().names()[static_cast<std::size_t>(seen.landmark)])));
  if (++sightings_ > kMostSightings)
    throw IoError(source_, fmt::format("line {}", row.line),
                  fmt::format("more than {} rows", kMostSightings));
  sightings.push_back(seen);
}

std::vector<std::string> SightingStream::remarks() const {
  std::vector<std::string> remarks = gatherer_.rows().looks().remarks();
  if (table_.cut_remark() != nullptr) remarks.emplace_back(table_.cut_remark());
  return remarks;
}

}  // namespace mapproof
