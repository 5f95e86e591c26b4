#include "core/records/detections/mrclam.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/not_finite.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "core/records/observations/name_list.hpp"
#include "core/records/tables/cells.hpp"
#include "core/records/tables/number_rows.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr int kLastRobot = 5;

std::map<int, int> read_barcodes(const fs::path& path) {
  const std::string source = path.string();
  const std::string bytes = read_input(path);
  std::map<int, int> subject_of;
  NumberRows rows(checked_text(bytes, source), source, 2);
  while (rows.next())
    if (!subject_of.emplace(rows.id(1), rows.id(0)).second)
      rows.fail(fmt::format("barcode {} is there twice", rows.id(1)));
  return subject_of;
}

/// RobotN_Measurement.dat of every N, ascending.
std::vector<fs::path> measurement_files(const fs::path& folder) {
  constexpr std::string_view kStart = "Robot";
  constexpr std::string_view kEnd = "_Measurement.dat";
  std::map<int, fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = unpacked_name(entry->path().filename()).string();
    if (!name.starts_with(kStart) || !name.ends_with(kEnd)) continue;
    int robot = 0;
    const char* digits_end = name.data() + name.size() - kEnd.size();
    const auto [stop, problem] = std::from_chars(name.data() + kStart.size(), digits_end, robot);
    if (problem == std::errc() && stop == digits_end)
      files.emplace(robot, plain_or_packed(folder / name));
  }
  if (error) throw IoError(folder.string(), "cannot be listed: " + error.message());
  std::vector<fs::path> ordered;
  for (const auto& [robot, path] : files) ordered.push_back(path);
  return ordered;
}

/// "3" of Robot3_Measurement.dat.
std::string robot_in(const fs::path& path) {
  const std::string name = unpacked_name(path.filename()).string();
  const std::size_t first = std::string_view("Robot").size();
  return name.substr(first, name.find('_') - first);
}

/// One row of a robot's file.
struct Row {
  double time_s;
  int subject;  ///< 0: unknown barcode.
  double range_m;
  double bearing_rad;
};

/// Gathers the scans of all robots, and counts what is left out.
class Scans {
 public:
  /// @param window_s  Between time stamps of one scan.
  Scans(const std::map<int, int>& subject_of, double window_s)
      : subject_of_(subject_of), window_s_(window_s) {
    for (const auto& [barcode, subject] : subject_of)
      if (subject > kLastRobot) index_.emplace(subject, 0);
    int landmark = 0;
    for (auto& [subject, index] : index_) {
      index = landmark++;
      log_.names.push_back(fmt::format("{}", subject));
    }
  }

  const DetectionLog& log() const { return log_; }

  void add_robot(const fs::path& path) {
    const std::string source = path.string();
    const std::string bytes = read_input(path);
    if (bytes.empty()) {
      empty_files_.push_back(path.filename().string());
      return;
    }
    log_.robots.push_back(robot_in(path));
    std::vector<Row> detections;
    NumberRows rows(checked_text(bytes, source), source, 4);
    while (rows.next()) detections.push_back(row_of(rows));
    std::ranges::stable_sort(detections, {}, &Row::time_s);
    for (auto first = detections.begin(); first != detections.end();) {
      auto last = std::next(first);
      while (last != detections.end() && last->time_s - std::prev(last)->time_s <= window_s_)
        ++last;
      add_scan({first, last});
      first = last;
    }
    if (log_.steps > kMostSteps)
      throw IoError(source, "as a whole",
                    fmt::format("{} steps; at most {}", log_.steps, kMostSteps));
  }

  std::vector<std::string> remarks() const {
    std::vector<std::string> remarks;
    const auto add = [&](std::string_view what, std::size_t count, const std::string& detail = "") {
      if (count > 0) remarks.push_back(fmt::format("{}: {}{}", what, count, detail));
    };
    if (!empty_files_.empty())
      remarks.push_back(fmt::format("Empty files: {}", fmt::join(empty_files_, ", ")));
    add("Rows dropped with unknown barcodes", of_nobody_, " (" + unknown_barcodes() + ")");
    add("Rows dropped that show other robots", of_robots_);
    add("Rows dropped that show a landmark a second time in one scan", repeated_);
    add("Scans dropped that show no landmark", empty_scans_);
    return remarks;
  }

 private:
  /// "barcodes 34, 43": the first ten, so that the remark stays a line.
  std::string unknown_barcodes() const {
    constexpr std::size_t kShown = 10;
    std::vector<int> shown;
    for (const int barcode : unknown_barcodes_)
      if (shown.size() < kShown) shown.push_back(barcode);
    const std::string_view rest = unknown_barcodes_.size() > kShown ? ", ..." : "";
    return fmt::format("barcodes {}{}", fmt::join(shown, ", "), rest);
  }

  Row row_of(const NumberRows& rows) {
    const int barcode = rows.id(1);
    for (const auto& [sensor, value] :
         {std::pair(Sensor::kRange, rows[2]), std::pair(Sensor::kBearing, rows[3])})
      if (const std::string problem = observation_problem(sensor, value); !problem.empty())
        rows.fail(problem);
    const auto known = subject_of_.find(barcode);
    if (known == subject_of_.end()) {
      ++of_nobody_;
      unknown_barcodes_.insert(barcode);
    }
    return {.time_s = rows[0],
            .subject = known == subject_of_.end() ? 0 : known->second,
            .range_m = rows[2],
            .bearing_rad = rows[3]};
  }

  void add_scan(std::span<const Row> rows) {
    std::map<int, Detection> scan;
    for (const Row& seen : rows) {
      const auto known = index_.find(seen.subject);
      if (known == index_.end()) {
        if (seen.subject != 0) ++of_robots_;
      } else if (const Detection detection{.step = log_.steps,
                                           .landmark = known->second,
                                           .range_m = seen.range_m,
                                           .bearing_rad = seen.bearing_rad};
                 !scan.emplace(known->second, detection).second) {
        ++repeated_;
      }
    }
    if (scan.empty()) {
      ++empty_scans_;
      return;
    }
    for (const auto& [landmark, detection] : scan) log_.detections.push_back(detection);
    log_.times_s.push_back(rows.front().time_s);
    log_.scans.push_back({static_cast<int>(log_.robots.size()) - 1, rows.front().time_s});
    ++log_.steps;
  }

  const std::map<int, int>& subject_of_;
  double window_s_;
  std::map<int, int> index_;  ///< Among the landmarks, of each one's subject number.
  DetectionLog log_;
  std::vector<std::string> empty_files_;
  std::set<int> unknown_barcodes_;
  std::size_t of_nobody_ = 0;
  std::size_t of_robots_ = 0;
  std::size_t repeated_ = 0;
  std::size_t empty_scans_ = 0;
};

/// The ground truth in the order of `names`; NaN rows for those that the file does not hold.
std::optional<Points> read_ground_truth(const fs::path& path, const std::vector<std::string>& names,
                                        std::vector<std::string>& remarks) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    remarks.push_back("No Landmark_Groundtruth.dat: the true positions are not known");
    return std::nullopt;
  }
  const std::string source = path.string();
  const std::string bytes = read_input(path);
  const NamedPoints ground_truth = parse_groundtruth(checked_text(bytes, source), source);
  Points positions = Points::Constant(static_cast<Eigen::Index>(names.size()), 2, kNaN);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::ranges::find(ground_truth.names, names[i]);
    if (found == ground_truth.names.end())
      remarks.push_back("No true position of landmark " + names[i]);
    else
      positions.row(static_cast<Eigen::Index>(i)) =
          ground_truth.positions_m.row(found - ground_truth.names.begin());
  }
  return positions;
}

}  // namespace

bool is_mrclam(const fs::path& folder) { return !measurement_files(folder).empty(); }

DetectionSource read_mrclam_detections(const fs::path& folder,
                                       std::optional<double> scan_window_s) {
  const std::vector<fs::path> robots = measurement_files(folder);
  if (robots.empty())
    throw IoError(folder.string(), "is a folder without MRCLAM's RobotN_Measurement.dat");
  const fs::path barcodes = plain_or_packed(folder / "Barcodes.dat");
  const std::map<int, int> subject_of = read_barcodes(barcodes);
  Scans scans(subject_of, scan_window_s.value_or(0.0));
  const std::size_t landmarks = scans.log().names.size();
  if (landmarks == 0)
    throw IoError(barcodes.string(), fmt::format("names no landmark: none above {}", kLastRobot));
  check_size(barcodes.string(), "as a whole", landmarks, 1);
  for (const fs::path& robot : robots) scans.add_robot(robot);

  DetectionSource result{.log = scans.log(),
                         .ground_truth_m = std::nullopt,
                         .remarks = scans.remarks(),
                         .locations = {},
                         .path = folder.string()};
  if (result.log.steps == 0) throw IoError(folder.string(), "no scan shows a landmark");
  for (const std::string& name : result.log.names) result.locations.push_back("subject " + name);
  result.ground_truth_m = read_ground_truth(plain_or_packed(folder / "Landmark_Groundtruth.dat"),
                                            result.log.names, result.remarks);
  return result;
}

ObservationSource read_mrclam(const fs::path& folder, Sensor sensor,
                              std::optional<double> scan_window_s) {
  return observations_of(read_mrclam_detections(folder, scan_window_s), sensor);
}

}  // namespace mapproof
