#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/sighting_rows.hpp"
#include "core/records/sighting_values.hpp"
#include "core/records/table_stream.hpp"

namespace mapproof {
namespace {

/// Gathers rows into looks. A sighting's step is at first the number of its run of rows.
class LongSightings {
 public:
  LongSightings(TableStream& stream, const SightingFormat& format)
      : stream_(stream), rows_(stream.source(), format) {}

  SightingSource read() && {
    TableRow row;
    if (!stream_.next(row)) throw IoError(stream_.source(), "holds no rows");
    if (!rows_.begin(row)) add(row);
    while (stream_.next(row)) add(row);
    if (log_.sightings.empty()) throw IoError(stream_.source(), "holds a header and no rows");
    order();
    log_.names = rows_.names().names();
    return {.log = std::move(log_),
            .truth_m = std::nullopt,
            .remarks = remarks(),
            .places = rows_.names().places(),
            .path = stream_.source()};
  }

 private:
  void add(const TableRow& row) {
    if (log_.sightings.size() == kMostSightings)
      rows_.looks().fail(row.line, fmt::format("more than {} rows", kMostSightings));
    const LookKey look = rows_.look_of(row);
    if (looks_.empty() || looks_.back() != look) looks_.push_back(look);
    log_.sightings.push_back(rows_.sighting_of(row));
    log_.sightings.back().step = static_cast<int>(looks_.size()) - 1;
    reserve(row);
  }

  /// After some rows the file's size tells about how many there will be.
  void reserve(const TableRow& row) {
    constexpr std::size_t kSample = 20'000;
    if (log_.sightings.size() > kSample) return;
    for (const std::string_view cell : row.cells) bytes_ += cell.size() + 1;
    if (log_.sightings.size() < kSample) return;
    const double rows = stream_.expected_size() / static_cast<double>(bytes_) * kSample;
    log_.sightings.reserve(static_cast<std::size_t>(
        std::clamp(1.05 * rows, double{kSample}, static_cast<double>(kMostSightings))));
  }

  /// Numbers the looks by robot and step, and sorts the sightings by look and landmark.
  void order() {
    std::vector<LookKey> distinct = looks_;
    std::ranges::sort(distinct);
    const auto rest = std::ranges::unique(distinct);
    distinct.erase(rest.begin(), rest.end());
    if (distinct.size() > static_cast<std::size_t>(kMostSteps))
      throw IoError(stream_.source(), "as a whole",
                    fmt::format("{} looks; at most {}", distinct.size(), kMostSteps));
    std::vector<int> step;
    for (const LookKey& look : looks_)
      step.push_back(static_cast<int>(std::ranges::lower_bound(distinct, look) - distinct.begin()));
    for (Sighting& seen : log_.sightings) seen.step = step[static_cast<std::size_t>(seen.step)];
    const auto place = [](const Sighting& seen) { return std::tuple(seen.step, seen.landmark); };
    if (!std::ranges::is_sorted(log_.sightings, {}, place))
      std::ranges::sort(log_.sightings, {}, place);
    const auto repeat = std::ranges::adjacent_find(log_.sightings, {}, place);
    if (repeat != log_.sightings.end())
      refuse_repeat(distinct[static_cast<std::size_t>(repeat->step)],
                    rows_.names().names()[static_cast<std::size_t>(repeat->landmark)]);
    log_.steps = static_cast<int>(distinct.size());
    log_.looks = distinct;
    log_.robots = rows_.looks().robots();
    if (rows_.looks().is_timed())
      for (const LookKey& look : distinct) log_.times_s.push_back(look.key);
  }

  /// Reads the file again to find the lines, which are not kept.
  [[noreturn]] void refuse_repeat(const LookKey& look, const std::string& name) {
    TableStream again(stream_.source());
    TableRow row;
    std::size_t first = 0;
    bool is_first = true;
    while (again.next(row)) {
      if (std::exchange(is_first, false) && rows_.begin(row)) continue;
      const bool is_it = rows_.look_of(row) == look && rows_.looks().label(row) == name;
      if (is_it && first > 0)
        rows_.looks().fail(row.line, fmt::format("landmark {} is in that look already, on line {}",
                                                 in_quotes(name), first));
      if (is_it) first = row.line;
    }
    throw IoError(stream_.source(), "changed while it was read");
  }

  std::vector<std::string> remarks() const {
    std::vector<std::string> remarks = rows_.looks().remarks();
    if (stream_.is_cut()) remarks.emplace_back(kCutRemark);
    return remarks;
  }

  TableStream& stream_;
  SightingRows rows_;
  SightingLog log_;
  std::vector<LookKey> looks_;  ///< A run of rows each.
  std::size_t bytes_ = 0;       ///< Of the first rows.
};

}  // namespace

SightingSource read_long_sightings(const std::filesystem::path& path,
                                   const SightingFormat& format) {
  TableStream stream(path);
  return LongSightings(stream, format).read();
}

}  // namespace mapproof
