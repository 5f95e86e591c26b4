// What every reader owes: the same result of the same bytes, however they come and are packed.
#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "core/records/observations/observation_json.hpp"
#include "core/records/observations/observations.hpp"
#include "core/records/ranges/range_logs.hpp"
#include "core/records/studies/timings_jsonl.hpp"
#include "core/studies/validate.hpp"
#include "tests/core/range_slam/sample_log.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/support/byte_sources.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/samples/scans.hpp"

namespace mapproof {
namespace {

using test::data_file;
using test::source_of;

/// A reader with bytes that it takes. What it read is given as text.
struct Reader {
  std::string name;
  std::string bytes;
  std::function<std::string(ByteSource&)> read;
};

[[maybe_unused]] std::ostream& operator<<(std::ostream& out, const Reader& reader) {
  return out << reader.name;
}

std::string text_of(const Eigen::MatrixXd& values) {
  return fmt::format("{}", fmt::join(values.reshaped().eval(), " "));
}

std::string text_of(const RangeLog& log) {
  std::string text = fmt::format("{} {} {}", log.name, log.landmarks, log.remarks);
  for (const RangeMeasurement& range : log.ranges)
    text += fmt::format("\n{} {} {}", range.time_s, range.landmark, range.range_m);
  for (const Motion& motion : log.odometry)
    text += fmt::format("\n{} {} {}", motion.time_s, motion.distance_m, motion.heading_change_rad);
  if (log.ground_truth) text += text_of(log.ground_truth->positions_m);
  if (log.true_landmarks) text += text_of(*log.true_landmarks);
  return text;
}

Reader observations(const std::string& name, std::string bytes, std::optional<Sensor> sensor,
                    Layout layout = Layout::kAuto) {
  return {name, std::move(bytes), [=](ByteSource& source) {
            const ObservationSource read = read_observations(source, sensor, {.layout = layout});
            return fmt::format("{} {}", observations_json(read.history), read.remarks);
          }};
}

Reader detections(const std::string& name, std::string bytes) {
  return {name, std::move(bytes), [](ByteSource& source) {
            EXPECT_TRUE(is_detections(source));
            EXPECT_FALSE(is_large_long_table(source));
            return detections_json(read_detections(source).log);
          }};
}

Reader landmarks(const std::string& name, std::string bytes) {
  return {name, std::move(bytes), [](ByteSource& source) {
            const NamedPoints read = read_landmarks(source);
            return fmt::format("{} {}", read.names, text_of(read.positions_m));
          }};
}

Reader range_log(const std::string& name, std::string bytes) {
  return {name, std::move(bytes),
          [](ByteSource& source) { return text_of(read_range_log(source)); }};
}

Reader validated(const Reader& reader, const std::string& kind) {
  return {"validate_" + reader.name, reader.bytes, [=](ByteSource& source) {
            const Finding finding = validate(source);
            if (!finding.problem.empty()) throw std::runtime_error(finding.problem);
            EXPECT_EQ(finding.kind, kind);
            return finding.kind;
          }};
}

std::string mat_bytes() {
  const test::TemporaryFolder folder;
  test::write_mat(test::sample_log(), folder / "a.mat", true);
  return read_file(folder / "a.mat");
}

/// Longer than what is read first, so that much of it is not.
std::string long_table() {
  std::string text = "step,landmark,value\n";
  for (int step = 0; step < 9000; ++step)
    for (const char* name : {"oak", "elm", "ash"})
      text += fmt::format("{},{},{:.3f}\n", step, name, std::sin(step + name[0]));
  return text;
}

std::vector<Reader> make_readers() {
  const RangeLog log = test::sample_log();
  Points locations(9, 2);
  for (Eigen::Index i = 0; i < 9; ++i)
    locations.row(i) << static_cast<double>(i % 3), 0.1 * static_cast<double>(i);
  const DetectionLog scans = test::scans_at(locations, 4000, 4, 3);
  std::string rows = "step,landmark,range,bearing\n";
  for (const Detection& seen : scans.detections)
    rows += fmt::format("{},{},{},{}\n", seen.step,
                        scans.names[static_cast<std::size_t>(seen.landmark)], seen.range_m,
                        seen.bearing_rad);
  const auto file = [](const char* name) { return read_file(data_file(name)); };
  const Reader wide =
      observations("wide", file("observations/wide_named.csv"), Sensor::kVisibility);
  const Reader semicolons =
      observations("semicolons", file("observations/wide_semicolon.csv"), Sensor::kBearing);
  const Reader tabs = observations("tabs", file("observations/wide_tabs.tsv"), Sensor::kRange);
  const Reader longs = observations("long", long_table(), Sensor::kBearing);
  const Reader bare =
      observations("long_bare", "0,oak,1\n0,elm,0\n1,oak,1\n", Sensor::kVisibility, Layout::kLong);
  const Reader json = observations("json", file("observations/observations.json"), std::nullopt);
  const Reader ranges_seen = observations("ranges_seen", rows, Sensor::kRange);
  const Reader seen = detections("detections", rows);
  const Reader seen_json = detections("detections_json", detections_json(scans));
  const Reader anchors = landmarks("anchors", file("landmarks/anchors.csv"));
  const Reader survey = landmarks("survey", file("mrclam/Landmark_Groundtruth.dat"));
  const Reader csv_log = range_log("range_csv", test::ranges_csv_of(log));
  const Reader mat_log = range_log("range_mat", mat_bytes());
  const Reader pyfg_log = range_log("range_pyfg", test::pyfg_of(log));
  const Reader text_log = range_log("range_text", test::td_text_of(log));
  const Reader map{"map", file("maps/map.json"), {}};
  const Reader experiment{"experiment", file("experiments/small.json"), {}};
  const Reader timings{"timings", timings_header() + session_line(test::made_up_session()), {}};
  return {wide,
          semicolons,
          tabs,
          longs,
          bare,
          json,
          ranges_seen,
          seen,
          seen_json,
          anchors,
          survey,
          csv_log,
          mat_log,
          pyfg_log,
          text_log,
          validated(wide, "wide CSV observations"),
          validated(longs, "long CSV observations"),
          validated(json, "mapproof.observations 1"),
          validated(seen, "detections"),
          validated(seen_json, "mapproof.detections 1"),
          validated(anchors, "landmarks with positions"),
          validated(csv_log, "range log"),
          validated(mat_log, "range log"),
          validated(pyfg_log, "range log"),
          validated(map, "mapproof.map 1"),
          validated(experiment, "mapproof.experiment 1"),
          validated(timings, "timings")};
}

const std::vector<Reader>& readers() {
  static const std::vector<Reader> all = make_readers();
  return all;
}

class EveryReader : public ::testing::TestWithParam<std::size_t> {
 protected:
  const Reader& reader() const { return readers()[GetParam()]; }
  std::string read(const std::string& bytes, std::size_t piece) const {
    ByteSource source = source_of(bytes, piece);
    return reader().read(source);
  }
};

TEST_P(EveryReader, ReadsTheSameHoweverTheBytesComeAndArePacked) {
  const std::string& bytes = reader().bytes;
  const std::string whole = read(bytes, bytes.size());
  EXPECT_FALSE(whole.empty());
  for (const std::string& packed : {bytes, test::gzipped(bytes), test::xzipped(bytes)})
    for (const std::size_t piece : {1UL, 13UL, 4096UL, 1UL << 20})
      EXPECT_TRUE(read(packed, piece) == whole) << piece;
}

TEST_P(EveryReader, NamesWhatIsCutOff) {
  const std::string gz = test::gzipped(reader().bytes), xz = test::xzipped(reader().bytes);
  for (const auto& [packed, name] : {std::pair(&gz, "gzip"), std::pair(&xz, "xz")})
    for (const std::size_t size : {packed->size() - 1, packed->size() / 2}) {
      std::string problem;
      try {
        read(packed->substr(0, size), 1000);
      } catch (const std::runtime_error& error) {
        problem = error.what();
      }
      EXPECT_EQ(problem, fmt::format("source: the {}'ed file is cut off", name));
    }
}

INSTANTIATE_TEST_SUITE_P(OfBytes, EveryReader, ::testing::Range(std::size_t{0}, readers().size()),
                         [](const auto& test) { return readers()[test.param].name; });

}  // namespace
}  // namespace mapproof
