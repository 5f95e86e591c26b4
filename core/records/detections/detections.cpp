#include "core/records/detections/detections.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/detections/detection_rows.hpp"
#include "core/records/detections/mrclam.hpp"
#include "core/records/detections/scan_grouping.hpp"
#include "core/records/detections/scan_rows.hpp"
#include "core/records/limits.hpp"
#include "core/records/observations/input_kind.hpp"
#include "core/records/observations/observation_json.hpp"
#include "core/records/tables/cells.hpp"
#include "core/records/tables/respelling.hpp"
#include "core/records/tables/table_stream.hpp"
#include "core/records/tables/time_text.hpp"

namespace mapproof {
namespace {

/// Rows of one scan, one behind the other.
struct RowRun {
  double key;
  int robot;
  std::uint32_t line;  ///< Of its first row.

  ScanKey scan() const { return {robot, key}; }
};

/// Gathers rows into scans. A detection's step is at first the number of its run.
class LongDetections {
 public:
  LongDetections(TableStream& stream, const TableFormat& format)
      : stream_(stream), rows_(stream.source(), format), scan_window_s_(format.scan_window_s) {}

  DetectionSource read() && {
    TableRow row;
    if (!stream_.next(row)) throw IoError(stream_.source(), "holds no rows");
    if (!rows_.begin(row)) add(row);
    while (stream_.next(row)) add(row);
    if (log_.detections.empty()) throw IoError(stream_.source(), "holds a header and no rows");
    last_ = {};
    scale_times();
    require_stamps(rows_.scans(), scan_window_s_);
    order();
    unknown_ = remark_on_unknown();
    std::vector<std::string> locations = rows_.names().locations();
    log_.names = std::move(rows_).take_names();
    return {.log = std::move(log_),
            .ground_truth_m = std::nullopt,
            .remarks = remarks(),
            .locations = std::move(locations),
            .path = stream_.source(),
            .reading = reading()};
  }

 private:
  void add(const TableRow& row) {
    if (log_.detections.size() == kMostDetections)
      rows_.scans().fail(row.line, fmt::format("more than {} rows", kMostDetections));
    const ScanKey scan = rows_.scan_of(row);
    if (runs_.empty() || runs_.back().scan() != scan)
      runs_.push_back({scan.key, scan.robot, static_cast<std::uint32_t>(row.line)});
    log_.detections.push_back(rows_.detection_of(row));
    Detection& seen = log_.detections.back();
    seen.step = static_cast<int>(runs_.size()) - 1;
    const auto landmark = static_cast<std::size_t>(seen.landmark);
    if (landmark >= last_.size()) last_.resize(landmark + 1);
    if (last_[landmark].run == seen.step)
      refuse_repeat(fmt::format("line {}", row.line), landmark,
                    fmt::format("on line {}", last_[landmark].line));
    last_[landmark] = {seen.step, static_cast<std::uint32_t>(row.line)};
    reserve(row);
  }

  /// Estimates the number of rows from the file's size after some of them.
  void reserve(const TableRow& row) {
    constexpr std::size_t kSample = 20'000;
    if (log_.detections.size() > kSample) return;
    for (const std::string_view cell : row.cells) bytes_ += cell.size() + 1;
    if (log_.detections.size() < kSample) return;
    const double rows =
        stream_.expected_size().value_or(0.0) / static_cast<double>(bytes_) * kSample;
    log_.detections.reserve(static_cast<std::size_t>(
        std::clamp(1.05 * rows, double{kSample}, static_cast<double>(kMostDetections))));
  }

  /// Brings times to seconds whose size shows another unit.
  void scale_times() {
    if (!rows_.scans().is_timed()) return;
    std::vector<double> times;
    std::ranges::transform(runs_, std::back_inserter(times), &RowRun::key);
    scale_ = time_scale(times);
    for (RowRun& run : runs_) run.key *= scale_.seconds;
  }

  TableReading reading() const {
    TableReading reading = rows_.scans().reading();
    reading.form = "detections";
    reading.packing = stream_.packing();
    reading.separator = stream_.separator();
    reading.has_decimal_commas = stream_.has_decimal_commas();
    if (scale_.words != nullptr) reading.times = scale_.words;
    return reading;
  }

  /// Numbers the scans by robot and step, and sorts the detections by scan and landmark.
  void order() {
    std::vector<ScanKey> distinct;
    distinct.reserve(runs_.size());
    std::ranges::transform(runs_, std::back_inserter(distinct), &RowRun::scan);
    std::ranges::sort(distinct);
    const auto rest = std::ranges::unique(distinct);
    distinct.erase(rest.begin(), rest.end());
    number_runs(distinct);
    if (rows_.scans().is_timed()) group(distinct);
    if (distinct.size() > static_cast<std::size_t>(kMostSteps))
      throw IoError(stream_.source(), "as a whole",
                    fmt::format("{} scans; at most {}", distinct.size(), kMostSteps));
    log_.steps = static_cast<int>(distinct.size());
    log_.scans = distinct;
    log_.robots = rows_.scans().robots();
    if (rows_.scans().is_timed())
      for (const ScanKey& scan : distinct) log_.times_s.push_back(scan.key);
  }

  /// Replaces the number of each detection's run by that of its scan, and sorts the detections.
  void number_runs(const std::vector<ScanKey>& distinct) {
    std::vector<int> step;
    for (const RowRun& run : runs_)
      step.push_back(
          static_cast<int>(std::ranges::lower_bound(distinct, run.scan()) - distinct.begin()));
    const auto location = [&](const Detection& seen) {
      return std::pair(step[static_cast<std::size_t>(seen.step)], seen.landmark);
    };
    if (!std::ranges::is_sorted(log_.detections, {}, location))
      std::ranges::sort(log_.detections, {}, location);
    const auto repeat = std::ranges::adjacent_find(log_.detections, {}, location);
    if (repeat != log_.detections.end()) refuse_repeat(*repeat, *std::next(repeat));
    for (Detection& seen : log_.detections) seen.step = step[static_cast<std::size_t>(seen.step)];
  }

  /// Groups the time stamps of rows into scans.
  void group(std::vector<ScanKey>& stamps) {
    ScanGrouping grouping = group_stamps(stamps, log_.detections, scan_window_s_);
    grouping_ = grouping_remark(grouping, stamps.size());
    if (grouping_.empty()) return;
    for (Detection& seen : log_.detections)
      seen.step = grouping.scan_of[static_cast<std::size_t>(seen.step)];
    sort_detections(log_.detections);
    stamps = std::move(grouping.scans);
  }

  /// Two detections of one landmark in different runs of one scan.
  [[noreturn]] void refuse_repeat(const Detection& first, const Detection& second) {
    const auto [one, other] = std::minmax(first.step, second.step);
    // The lines within a run are not kept.
    const auto where = [&](int run, const char* exact) {
      const auto rows = std::ranges::count(log_.detections, run, &Detection::step);
      return fmt::format(fmt::runtime(rows == 1 ? exact : "from line {} on"),
                         runs_[static_cast<std::size_t>(run)].line);
    };
    refuse_repeat(where(other, "line {}"), static_cast<std::size_t>(first.landmark),
                  where(one, "on line {}"));
  }

  [[noreturn]] void refuse_repeat(const std::string& location, std::size_t landmark,
                                  const std::string& first) {
    throw IoError(stream_.source(), location,
                  fmt::format("landmark {} is in that scan already, {}",
                              in_quotes(rows_.names().names()[landmark]), first));
  }

  /// On the number by which detectors mark what they could not identify; empty: it does not occur,
  /// or the IDs are no numbers.
  std::string remark_on_unknown() const {
    const std::vector<std::string>& names = rows_.names().names();
    const auto unknown = std::ranges::find(names, "-1");
    const auto negative = std::ranges::count_if(
        names, [](const std::string& name) { return !number_in(name) || name.starts_with('-'); });
    if (unknown == names.end() || negative != 1) return "";
    const auto rows = std::ranges::count(log_.detections, static_cast<int>(unknown - names.begin()),
                                         &Detection::landmark);
    return fmt::format(
        "{} of a landmark \"-1\", which is mapped like any other. Detectors mark by it what they "
        "could not identify: leave such rows out",
        counted(rows, "detection"));
  }

  std::vector<std::string> remarks() const {
    std::vector<std::string> remarks = rows_.scans().remarks();
    if (!grouping_.empty()) remarks.push_back(grouping_);
    if (!unknown_.empty()) remarks.push_back(unknown_);
    if (stream_.is_cut()) remarks.emplace_back(kCutRemark);
    return remarks;
  }

  TableStream& stream_;
  DetectionRows rows_;
  std::optional<double> scan_window_s_;
  std::string grouping_;  ///< A remark.
  std::string unknown_;   ///< Another one.
  DetectionLog log_;
  TimeScale scale_;
  std::vector<RowRun> runs_;
  /// Where a landmark was seen last.
  struct LastRow {
    int run = -1;
    std::uint32_t line = 0;
  };
  std::vector<LastRow> last_;  ///< By landmark.
  std::size_t bytes_ = 0;      ///< Of the first rows.
};

constexpr const char* kDetectionsSchema = "mapproof.detections";

}  // namespace

DetectionSource read_long_detections(ByteSource& source, const TableFormat& format) {
  TableStream stream(source);
  return LongDetections(stream, format).read();
}

bool is_detections(ByteSource& source, const TableFormat& format) {
  respell(source);
  if (is_json(source)) return json_schema(source) == kDetectionsSchema;
  return first_row_is(source, [&](const TableRow& row) {
    return names_detection_columns(row, format.columns) || starts_detection_list(row);
  });
}

MeasuredColumns measured_in(ByteSource& source, const TableFormat& format) {
  MeasuredColumns measured{.range = true, .bearing = true};
  if (is_json(source)) return measured;
  first_row_is(source, [&](const TableRow& row) {
    measured = measured_columns(row, format.columns);
    return true;
  });
  return measured;
}

bool is_large_long_table(ByteSource& source, const TableFormat& format) {
  respell(source);
  constexpr std::size_t kLarge = 64'000'000;
  if (is_json(source)) return false;
  const auto is_long = [&](const TableRow& row) {
    return names_detection_columns(row, format.columns) || starts_detection_list(row) ||
           names_value_columns(row, format.columns);
  };
  return first_row_is(source, is_long) && source.holds_more_than(kLarge);
}

DetectionSource read_detections(ByteSource& source, const TableFormat& format) {
  respell(source);
  if (!is_json(source)) return read_long_detections(source, format);
  if (format.scan_window_s) refuse_window(source.name());
  require_columns({}, format.columns, source.name());
  const std::string bytes = source.rest();
  return parse_detections(checked_text(bytes, source.name()), source.name());
}

DetectionSource read_detections(const std::filesystem::path& path, const TableFormat& format) {
  if (is_folder(path)) return read_mrclam_detections(path, format.scan_window_s);
  ByteSource source(path);
  return read_detections(source, format);
}

}  // namespace mapproof
