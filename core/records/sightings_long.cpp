#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/name_list.hpp"
#include "core/records/observation_values.hpp"
#include "core/records/sighting_columns.hpp"
#include "core/records/sighting_values.hpp"
#include "core/records/table_stream.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostRows = 50'000'000;

/// One look: the rows of one robot at one step or time.
struct Look {
  int robot;
  double key;
  auto operator<=>(const Look&) const = default;
};

/// Gathers rows into looks. A sighting's step is at first the number of its run of rows.
class LongSightings {
 public:
  LongSightings(TableStream& stream, const SightingFormat& format)
      : stream_(stream), format_(format), names_(stream.source()), robots_(stream.source()) {}

  SightingSource read() && {
    TableRow row;
    if (!stream_.next(row)) throw IoError(stream_.source(), "holds no rows");
    const bool has_header = !row.cells.empty() && !number_in(row.cells.front()) &&
                            std::ranges::none_of(row.cells, [](std::string_view cell) {
                              return number_in(cell).has_value();
                            });
    columns_ = has_header ? sighting_columns(row, stream_.source())
                          : usual_sighting_columns(row, stream_.source());
    if (!has_header) add(row);
    while (stream_.next(row)) add(row);
    if (log_.sightings.empty()) throw IoError(stream_.source(), "holds a header and no rows");
    order();
    log_.names = names_.names();
    return {.log = std::move(log_),
            .truth_m = std::nullopt,
            .remarks = remarks(),
            .places = names_.places(),
            .path = stream_.source()};
  }

 private:
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw IoError(stream_.source(), fmt::format("line {}", line), what);
  }

  void add(const TableRow& row) {
    if (row.cells.size() != columns_.width)
      fail(row.line, fmt::format("has {} cells, expected {}", row.cells.size(), columns_.width));
    if (log_.sightings.size() == kMostRows)
      fail(row.line, fmt::format("more than {} rows", kMostRows));
    const Look look = look_of(row);
    if (looks_.empty() || looks_.back() != look) looks_.push_back(look);
    const std::string_view label = row.cells[*columns_[SightingColumn::kLandmark]];
    if (label.empty())
      fail(row.line,
           "a sighting without a label: which landmark it shows is not told from looks; leave such "
           "rows out");
    Sighting seen;
    seen.step = static_cast<int>(looks_.size()) - 1;
    seen.landmark = static_cast<int>(names_.find_or_add(label, row.line));
    if (const auto cell = columns_[SightingColumn::kRange])
      seen.range_m = value(row, *cell, Sensor::kRange);
    if (const auto cell = columns_[SightingColumn::kBearing])
      seen.bearing_rad = value(row, *cell, Sensor::kBearing);
    if (const auto cell = columns_[SightingColumn::kValue]) take_value(row, *cell, seen);
    log_.sightings.push_back(seen);
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
        std::clamp(1.05 * rows, double{kSample}, static_cast<double>(kMostRows))));
  }

  /// The column that says which rows are one look.
  SightingColumn key_column() const {
    return columns_[SightingColumn::kStep] ? SightingColumn::kStep : SightingColumn::kTime;
  }

  Look look_of(const TableRow& row) {
    Look look{.robot = 0, .key = 0.0};
    if (const auto cell = columns_[SightingColumn::kRobot])
      look.robot = static_cast<int>(robots_.find_or_add(row.cells[*cell], row.line));
    const std::string_view cell = row.cells[*columns_[key_column()]];
    const std::optional<double> key = number_in(cell);
    if (!key || !std::isfinite(*key))
      fail(row.line, fmt::format("{}: {}", key_column() == SightingColumn::kStep ? "step" : "time",
                                 number_problem(cell)));
    look.key = *key;
    return look;
  }

  double value(const TableRow& row, std::size_t cell, Sensor sensor) const {
    const AngleUnit unit = columns_.unit.value_or(format_.unit);
    const std::optional<double> value = sighting_value(row.cells[cell], sensor, unit);
    if (!value) fail(row.line, sighting_problem(row.cells[cell], sensor, unit));
    return *value;
  }

  /// What the column `value` holds was said beforehand.
  void take_value(const TableRow& row, std::size_t cell, Sighting& seen) const {
    if (!format_.value)
      fail(row.line, "a column of values does not say what they are: range or bearing?");
    if (*format_.value == Sensor::kRange)
      seen.range_m = value(row, cell, Sensor::kRange);
    else if (*format_.value == Sensor::kBearing)
      seen.bearing_rad = value(row, cell, Sensor::kBearing);
    else if (row.cells[cell] != "1")
      fail(row.line, "a table of sightings lists what was seen: a visibility of 1");
  }

  /// Numbers the looks by robot and step, and sorts the sightings by look and landmark.
  void order() {
    std::vector<Look> distinct = looks_;
    std::ranges::sort(distinct);
    const auto rest = std::ranges::unique(distinct);
    distinct.erase(rest.begin(), rest.end());
    if (distinct.size() > static_cast<std::size_t>(kMostSteps))
      throw IoError(stream_.source(), "as a whole",
                    fmt::format("{} looks; at most {}", distinct.size(), kMostSteps));
    std::vector<int> step;
    for (const Look& look : looks_)
      step.push_back(static_cast<int>(std::ranges::lower_bound(distinct, look) - distinct.begin()));
    for (Sighting& seen : log_.sightings) seen.step = step[static_cast<std::size_t>(seen.step)];
    const auto place = [](const Sighting& seen) { return std::tuple(seen.step, seen.landmark); };
    if (!std::ranges::is_sorted(log_.sightings, {}, place))
      std::ranges::sort(log_.sightings, {}, place);
    const auto repeat = std::ranges::adjacent_find(log_.sightings, {}, place);
    if (repeat != log_.sightings.end())
      refuse_repeat(distinct[static_cast<std::size_t>(repeat->step)],
                    names_.names()[static_cast<std::size_t>(repeat->landmark)]);
    log_.steps = static_cast<int>(distinct.size());
    if (key_column() == SightingColumn::kTime)
      for (const Look& look : distinct) log_.times_s.push_back(look.key);
  }

  /// Reads the file again to find the lines, which are not kept.
  [[noreturn]] void refuse_repeat(const Look& look, const std::string& name) {
    TableStream again(stream_.source());
    TableRow row;
    std::size_t first = 0;
    while (again.next(row)) {
      const bool is_it = row.cells.size() == columns_.width &&
                         row.cells[*columns_[SightingColumn::kLandmark]] == name &&
                         number_in(row.cells[*columns_[key_column()]]) && look_of(row) == look;
      if (is_it && first > 0)
        fail(row.line, fmt::format("landmark {} is in that look already, on line {}",
                                   in_quotes(name), first));
      if (is_it) first = row.line;
    }
    throw IoError(stream_.source(), "changed while it was read");
  }

  std::vector<std::string> remarks() const {
    if (columns_.unread.empty()) return {};
    return {fmt::format("Columns that are not read: {}", fmt::join(columns_.unread, ", "))};
  }

  TableStream& stream_;
  SightingFormat format_;
  SightingColumns columns_;
  NameList names_;
  NameList robots_;
  SightingLog log_;
  std::vector<Look> looks_;  ///< A run of rows each.
  std::size_t bytes_ = 0;    ///< Of the first rows.
};

}  // namespace

SightingSource read_long_sightings(const std::filesystem::path& path,
                                   const SightingFormat& format) {
  TableStream stream(path);
  return LongSightings(stream, format).read();
}

}  // namespace mapproof
