// Observations, detections and landmarks, as files and as streams.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/records/detections/detection_stream.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/evaluations/space_path_text.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "core/records/observations/observation_json.hpp"
#include "core/records/observations/observation_stream.hpp"
#include "core/records/observations/observations.hpp"
#include "core/records/observations/trajectories.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/support/byte_sources.hpp"

namespace mapproof::fuzz {
namespace {

std::string text_of(const ObservationSource& read) {
  std::string text =
      observations_json(read.history) + fmt::format("{} {}", read.remarks, read.locations);
  for (const UnassociatedMeasurement& one : read.unassociated)
    text += fmt::format("\n{} {} {} {}", one.step, one.number, one.value, one.line);
  return text;
}

/// A table of a sensor and a unit that its size chooses: what they refuse differs.
void read_table(std::string_view bytes, Layout layout) {
  constexpr std::array kSensors = {Sensor::kVisibility, Sensor::kBearing, Sensor::kRange};
  const Sensor sensor = kSensors[bytes.size() / 2 % kSensors.size()];
  const TableFormat format{
      .unit = bytes.size() % 2 == 0 ? AngleUnit::kRadians : AngleUnit::kDegrees, .layout = layout};
  read_in_any_way(bytes, [&](ByteSource& source) {
    return text_of(read_observations(source, sensor, format));
  });
}

const Added kWide({.name = "observations-wide",
                   .run = [](auto bytes) { read_table(bytes, Layout::kWide); },
                   .seeds = {"observations"}});
const Added kLong({.name = "observations-long",
                   .run = [](auto bytes) { read_table(bytes, Layout::kLong); },
                   .seeds = {"observations"}});
const Added kAny({.name = "observations-any",
                  .run = [](auto bytes) { read_table(bytes, Layout::kAuto); },
                  .seeds = {"observations", "foreign"}});
const Added kJson({.name = "observations-json",
                   .run =
                       [](auto bytes) {
                         round_trip(
                             bytes,
                             [](auto text, auto& source) {
                               return parse_observations(text, source, {}).history;
                             },
                             observations_json);
                       },
                   .seeds = {"observations/observations.json"}});

std::string text_of(const DetectionSource& read) {
  std::string text = detections_json(read.log) + fmt::format("{} {}", read.remarks, read.locations);
  for (const ScanKey& scan : read.log.scans) text += fmt::format("\n{} {}", scan.robot, scan.key);
  return text + fmt::format("{} {}", read.log.times_s, read.log.robots);
}

const Added kDetections({.name = "detections",
                         .run =
                             [](auto bytes) {
                               read_in_any_way(bytes, [](ByteSource& source) {
                                 return text_of(read_detections(source));
                               });
                             },
                         .seeds = {"observations", "foreign"}});
const Added kDetectionsJson({.name = "detections-json", .run = [](auto bytes) {
                               round_trip(
                                   bytes,
                                   [](auto text, auto& source) {
                                     return parse_detections(text, source).log;
                                   },
                                   detections_json);
                             }});

/// All scans of a stream that is given its bytes in pieces.
std::string streamed_detections(std::string_view bytes, std::size_t piece) {
  DetectionStream stream(kSource, {});
  std::string text;
  const auto take_scans = [&] {
    for (const StreamedScan& scan : stream.scans()) {
      text += fmt::format("\n{} {}:", scan.scan.robot, scan.scan.key);
      for (const Detection& seen : scan.detections)
        text += fmt::format(" {} {} {}", seen.landmark, seen.range_m, seen.bearing_rad);
    }
  };
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    stream.take(bytes.substr(at, piece));
    take_scans();
  }
  stream.end();
  take_scans();
  return text + fmt::format("{}", stream.names());
}

/// One step of an ObservationStream as text.
std::string text_of(const StreamedStep& step) {
  std::string text = fmt::format("\n{}:", step.step);
  for (const auto& [landmark, value] : step.values) text += fmt::format(" {} {}", landmark, value);
  return text;
}

std::string streamed_observations(std::string_view bytes, std::size_t piece) {
  ObservationStream stream(kSource, Sensor::kRange);
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += piece) {
    stream.take(bytes.substr(at, piece));
    for (const StreamedStep& step : stream.steps()) text += text_of(step);
  }
  stream.end();
  for (const StreamedStep& step : stream.steps()) text += text_of(step);
  return text + fmt::format("{}", stream.names());
}

/// A stream gives the same in any pieces, and of what it takes the reader of files makes as many
/// landmarks.
template <typename Stream, typename Names>
void stream(std::string_view bytes, const Stream& streamed, const Names& names_in_file) {
  std::string whole, error;
  const auto tried = [&](std::size_t piece) {
    try {
      return streamed(bytes, piece);
    } catch (const IoError& thrown) {
      return std::string("error: ") + thrown.what();
    }
  };
  whole = tried(std::max<std::size_t>(1, bytes.size()));
  expect_equal("the same stream in pieces", whole, tried(1 + bytes.size() % 7));
  // Of a stream that ends within a line, all before it counts, and it may hold nothing yet; such
  // files are refused.
  const bool has_steps = whole.starts_with('\n');
  // To a stream these are remarks and a rule, not a point cloud, a bag of ROS 1 and YAML.
  for (const char* other : {"# .PCD", "#ROSBAG", "---"})
    if (bytes.starts_with(other)) return;
  // Tabs in front of the first row are cells where tabs separate, which a stream does not yet know.
  if (const std::size_t row = bytes.find_first_not_of(" \t\r\n");
      row != std::string_view::npos && bytes.substr(0, row).find('\t') != std::string_view::npos)
    return;
  if (!has_steps || whole.ends_with("[]") || !bytes.ends_with('\n')) return;
  std::string names;
  try {
    names = names_in_file(bytes);
  } catch (const IoError& thrown) {
    found("a file is read as its stream", thrown.what());
  }
  if (!whole.ends_with(names)) found("a file is read as its stream", whole + "\n---\n" + names);
}

const Added kDetectionStream({.name = "detections-stream",
                              .run =
                                  [](auto bytes) {
                                    stream(bytes, streamed_detections, [](auto text) {
                                      ByteSource source = test::source_of(
                                          std::string(text), ByteSource::kPeek, kSource);
                                      return fmt::format(
                                          "{}", read_long_detections(source, {}).log.names);
                                    });
                                  },
                              .seeds = {"observations"}});
const Added kObservationStream(
    {.name = "observations-stream",
     .run =
         [](auto bytes) {
           stream(bytes, streamed_observations, [](auto text) {
             ByteSource source = test::source_of(std::string(text), ByteSource::kPeek, kSource);
             const Layout layout = is_detections(source) ? Layout::kAuto : Layout::kLong;
             return fmt::format(
                 "{}", read_observations(source, Sensor::kRange, {.layout = layout}).history.names);
           });
         },
     .seeds = {"observations"}});

const Added kLandmarks({.name = "landmarks",
                        .run =
                            [](auto bytes) {
                              read_in_any_way(bytes, [](ByteSource& source) {
                                const NamedPoints read = read_landmarks(source);
                                const Points& at = read.positions_m;
                                return fmt::format("{} {} {}", read.names, read.locations,
                                                   fmt::join(at.reshaped().eval(), " "));
                              });
                            },
                        .seeds = {"landmarks", "mrclam", "foreign"}});

/// A path is read back as it was written; its headings, which are quaternions there, to 1e-12.
void read_path(std::string_view bytes) {
  const Trajectory path = parse_trajectory_tum(bytes, kSource);
  const Trajectory again = parse_trajectory_tum(trajectory_tum(path), kSource);
  if (again.time_s != path.time_s || again.positions_m != path.positions_m)
    found("a path is read back as it was written", trajectory_tum(again));
  for (Eigen::Index i = 0; i < path.heading_rad.size(); ++i)
    if (std::abs(std::remainder(again.heading_rad(i) - path.heading_rad(i),
                                2.0 * std::numbers::pi)) > 1e-12)
      found("headings are read back as they were written", trajectory_tum(again));
}
const Added kSpacePaths({.name = "paths-space", .run = [](auto bytes) {
                           read_in_any_way(bytes, [](ByteSource& source) {
                             const SpacePath path = read_space_path(source);
                             std::string text =
                                 fmt::format("{} {} {}", path.has_times,
                                             fmt::join(path.time_s.reshaped().eval(), " "),
                                             fmt::join(path.positions_m.reshaped().eval(), " "));
                             for (const Eigen::Matrix3d& R : path.orientations)
                               text += fmt::format(" {}", fmt::join(R.reshaped().eval(), " "));
                             return text;
                           });
                         }});
const Added kPaths({.name = "paths-tum", .run = read_path});

}  // namespace
}  // namespace mapproof::fuzz
