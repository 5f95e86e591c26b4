// Arrays of NumPy, times, files beside ranges, and the folders of MRCLAM.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/json/text_input.hpp"
#include "core/records/detections/mrclam.hpp"
#include "core/records/observations/observations.hpp"
#include "core/records/ranges/range_companions.hpp"
#include "core/records/ranges/range_log_g2o.hpp"
#include "core/records/tables/npy.hpp"
#include "core/records/tables/time_text.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::fuzz {
namespace {

/// An array of two dimensions becomes as many rows, each of as many cells.
void read_array(std::string_view bytes) {
  const NpyArray array(bytes, kSource);
  std::string text;
  array.append_rows(text, kSource);
  const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
  if (lines != array.shape()[0]) found("a line for each row", text);
  const std::size_t cells = lines + static_cast<std::size_t>(std::ranges::count(text, ','));
  if (lines > 0 && cells != lines * std::max<std::size_t>(array.shape()[1], 1))
    found("a cell for each column", text);
}
const Added kNpy({.name = "npy",
                  .run = read_array,
                  .seeds = {"foreign/numpy.npy", "foreign/numpy_fortran.npy"}});

/// A time is finite, or refused in one line.
void read_time(std::string_view bytes) {
  const std::optional<double> time = time_in(bytes), date = date_in(bytes);
  if (time && !std::isfinite(*time)) found("a time is finite", fmt::format("{}", *time));
  // Digits alone are a number in a column of times, a date in one of dates.
  if (date && time && !number_in(bytes) && *date != *time)
    found("a date is a time", fmt::format("{} {}", *date, *time));
  if (!time && time_problem(bytes).find('\n') != std::string::npos)
    found("a problem is one line", time_problem(bytes));
}
const Added kTime({.name = "times", .run = read_time});

std::string text_of(const CompanionSummary& read) {
  return fmt::format("{} {} {} {} {} {} {} {}", read.kind, read.rows, read.duration_s, read.way_m,
                     read.turned_rad, read.has_headings, read.columns, read.remarks);
}

/// A file as what its first row shows, or as odometry, as a path or as landmarks, as its size says.
void read_beside_ranges(std::string_view bytes) {
  constexpr std::array kKinds = {Companion::kOdometry, Companion::kPath, Companion::kLandmarks};
  const std::size_t kind = bytes.size() % (kKinds.size() + 1);
  read_in_any_way(bytes, [&](ByteSource& source) {
    return text_of(kind < kKinds.size() ? read_companion(source, kKinds[kind], {})
                                        : read_companion(source));
  });
}
const Added kCompanions({.name = "ranges-companions",
                         .run = read_beside_ranges,
                         .seeds = {"foreign"}});

const Added kG2oLandmarks({.name = "g2o-landmarks",
                           .run =
                               [](auto bytes) {
                                 read_in_any_way(bytes, [](ByteSource& source) {
                                   const NamedPoints read = read_g2o_landmarks(source);
                                   const Points& at = read.positions_m;
                                   return fmt::format("{} {}", read.names,
                                                      fmt::join(at.reshaped().eval(), " "));
                                 });
                               },
                           .seeds = {"foreign/slam.g2o"}});

/// Bytes as a file of a data set whose other files are right.
void read_data_set(std::string_view bytes) {
  static const test::TemporaryFolder folder;
  static std::map<std::string, std::string> held;
  const auto put = [](const char* name, std::string_view text) {
    const auto [file, is_new] = held.try_emplace(name);
    if (!is_new && file->second == text) return;
    file->second = text;
    std::ofstream(folder / name, std::ios::binary) << text;
  };
  static constexpr std::string_view kBarcodes = "1 5\n6 63\n7 25\n8 45\n";
  static constexpr std::string_view kMeasured = "1.5 63 2.5 0.1\n1.5 25 3.5 0.2\n2.5 45 1.0 0.3\n";
  static constexpr std::string_view kGroundTruth =
      "6 1.0 2.0 0.1 0.1\n7 3.0 4.0 0.1 0.1\n8 5.0 6.0 0 0\n";
  const std::size_t which = bytes.empty() ? 0 : static_cast<unsigned char>(bytes.front()) % 3;
  const std::string_view given = bytes.substr(std::min<std::size_t>(1, bytes.size()));
  put("Barcodes.dat", which == 1 ? given : kBarcodes);
  put("Robot1_Measurement.dat", which == 0 ? given : kMeasured);
  put("Landmark_Groundtruth.dat", which == 2 ? given : kGroundTruth);
  const DetectionSource read = read_mrclam_detections(folder.path());
  for (const Detection& seen : read.log.detections)
    if (seen.landmark < 0 || seen.landmark >= std::ssize(read.log.names) || seen.step < 0 ||
        seen.step >= read.log.steps)
      found("a detection is of a landmark in a scan",
            fmt::format("{} {}", seen.landmark, seen.step));
}
const Added kMrclam({.name = "mrclam", .run = read_data_set});

}  // namespace
}  // namespace mapproof::fuzz
