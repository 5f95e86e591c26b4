// Whatever bytes a person feeds the readers: a value, or an IoError of one short line.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cctype>
#include <filesystem>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/records/experiments/experiment_json.hpp"
#include "core/records/experiments/profiles.hpp"
#include "core/records/maps/map_json.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "core/records/observations/observations.hpp"
#include "core/records/ranges/range_log_forms.hpp"
#include "core/records/studies/run_json.hpp"
#include "core/records/studies/timings_jsonl.hpp"
#include "core/studies/validate.hpp"
#include "tests/core/records/samples.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct Input {
  std::string name;
  std::string bytes;
  std::function<void(const std::string& bytes)> read;
  bool is_whole_json;  ///< So that no truncated form of it is any good.
};

/// Hands the bytes to a reader of files.
std::function<void(const std::string&)> as_file(const std::string& name,
                                                const std::function<void(const fs::path&)>& read) {
  return [=](const std::string& bytes) {
    const test::TemporaryFolder folder;
    read(folder.file(name, bytes));
  };
}

Input table(const std::string& file, Sensor sensor, Layout layout) {
  return {
      file, read_file(test::data_file(file)),
      as_file("t.csv",
              [=](const fs::path& path) { read_observations(path, sensor, {.layout = layout}); }),
      false};
}

std::vector<Input> make_inputs() {
  const RunResult result = test::made_up_result({1, 1});
  const auto experiment = [](const std::string& text) {
    parse_experiment(text, "e");
    for (const std::string& name : profile_names(text, "e", "mapproof.experiment"))
      parse_experiment(text, "e", name);
  };
  return {
      {"experiment", read_file(test::data_file("experiments/small.json")), experiment, true},
      {"study", study_json(test::small_experiment(), test::made_up_provenance()),
       [](const std::string& text) { parse_study(text, "s"); }, true},
      {"run", run_json(result.run), [](const std::string& text) { parse_run(text, "r"); }, true},
      {"maps", maps_json({.run = {1, 1}, .maps = result.maps}),
       [](const std::string& text) { parse_maps(text, "m"); }, true},
      {"map", read_file(test::data_file("maps/map.json")),
       [](const std::string& text) { parse_map(text, "m"); }, true},
      {"observations", read_file(test::data_file("observations/observations.json")),
       as_file("o.json", [](const fs::path& path) { read_observations(path, std::nullopt); }),
       true},
      {"timings", timing_line(result.timings[0]) + session_line(test::made_up_session()),
       [](const std::string& text) { parse_timings(text, "t"); }, false},
      table("observations/wide_named.csv", Sensor::kVisibility, Layout::kAuto),
      table("observations/wide_semicolon.csv", Sensor::kBearing, Layout::kAuto),
      table("observations/wide_tabs.tsv", Sensor::kRange, Layout::kWide),
      table("observations/long.csv", Sensor::kBearing, Layout::kAuto),
      table("observations/long_detections.csv", Sensor::kVisibility, Layout::kLong),
      table("foreign/pandas_datetime.csv", Sensor::kBearing, Layout::kAuto),
      table("foreign/pandas_german.csv", Sensor::kBearing, Layout::kAuto),
      table("foreign/r_table.txt", Sensor::kBearing, Layout::kAuto),
      table("foreign/numpy.npy", Sensor::kBearing, Layout::kAuto),
      table("foreign/numpy_columns.npz", Sensor::kRange, Layout::kAuto),
      table("foreign/pandas_records.jsonl", Sensor::kBearing, Layout::kAuto),
      table("foreign/pandas_split.json", Sensor::kBearing, Layout::kAuto),
      table("foreign/aruco.jsonl", Sensor::kRange, Layout::kAuto),
      table("foreign/slam.g2o", Sensor::kRange, Layout::kAuto),
      {"path", "0 0 0 0 0 0 0 1\n1 2 0 0 0 0 .6 .8\n2 2 3 0 0 0 .6 .8\n",
       as_file("p.tum",
               [](const fs::path& path) {
                 ByteSource source(path);
                 if (!is_path_text(source)) throw IoError("p", "is not a path");
                 read_path_text(source, {});
               }),
       false},
      {"landmarks", read_file(test::data_file("landmarks/groundtruth.csv")),
       as_file("l.csv", [](const fs::path& path) { read_landmarks(path); }), false},
      {"measurements", read_file(test::data_file("mrclam/Robot1_Measurement.dat")),
       [](const std::string& bytes) {
         const test::TemporaryFolder folder;
         fs::copy(test::data_file("mrclam"), folder / "set");
         folder.file("set/Robot1_Measurement.dat", bytes);
         read_observations(folder / "set", Sensor::kRange);
       },
       false},
      {"anything", read_file(test::data_file("observations/long.csv")),
       as_file("v.csv",
               [](const fs::path& path) {
                 const std::string problem = validate(path).at(0).problem;
                 if (!problem.empty()) throw IoError("v", problem);
               }),
       false},
  };
}

const std::vector<Input>& inputs() {
  static const std::vector<Input> all = make_inputs();
  return all;
}

/// Empty if the reader took the bytes, else its message. Any other exception passes through.
std::string said(const Input& input, const std::string& bytes) {
  try {
    input.read(bytes);
    return {};
  } catch (const IoError& error) {
    return error.what();
  }
}

class AnyReader : public ::testing::TestWithParam<std::size_t> {
 protected:
  const Input& input() const { return inputs()[GetParam()]; }
};

TEST_P(AnyReader, TakesItsSample) { EXPECT_EQ(said(input(), input().bytes), ""); }

TEST_P(AnyReader, RefusesOrTakesEveryTruncatedForm) {
  const std::string& bytes = input().bytes;
  const std::size_t whole = bytes.rfind('}');
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const std::string error = said(input(), bytes.substr(0, length));
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    if (!input().is_whole_json || length > whole) continue;
    EXPECT_TRUE(error.find("is truncated") != std::string::npos ||
                error.find("is empty") != std::string::npos)
        << length << ": " << error;
  }
}

TEST_P(AnyReader, SaysOneShortLineAboutRandomDamage) {
  const std::vector<std::string> pieces = {"",
                                           "\n",
                                           ",",
                                           "\"",
                                           "{",
                                           "}",
                                           "[",
                                           "]",
                                           "-",
                                           "1e999",
                                           "nan",
                                           "inf",
                                           "null",
                                           "\xFF",
                                           "1e-400",
                                           "00",
                                           "\t",
                                           ";",
                                           "#",
                                           "true",
                                           "\\",
                                           "99999999999999999999",
                                           ":",
                                           "\r",
                                           "-1",
                                           "0.5",
                                           "\"K\"",
                                           "4",
                                           "\xE2\x80\xAE",
                                           std::string(1, '\0'),
                                           std::string(5000, '7'),
                                           std::string(200, '[')};
  rc::check([&] {
    std::string bytes = input().bytes;
    const int cuts = *rc::gen::inRange(1, 4);
    for (int i = 0; i < cuts; ++i) {
      const auto at = *rc::gen::inRange<std::size_t>(0, bytes.size() + 1);
      const auto length = *rc::gen::inRange<std::size_t>(0, 12);
      const auto piece = *rc::gen::inRange<std::size_t>(0, pieces.size());
      bytes.replace(at, std::min(length, bytes.size() - at), pieces[piece]);
    }
    const std::string error = said(input(), bytes);
    RC_ASSERT(error.find('\n') == std::string::npos);
    RC_ASSERT(error.size() < 700U);
  });
}

TEST_P(AnyReader, SaysOneShortLineAboutRandomBytes) {
  rc::check([&] {
    const std::string error = said(input(), *rc::gen::string<std::string>());
    RC_ASSERT(error.find('\n') == std::string::npos);
  });
}

INSTANTIATE_TEST_SUITE_P(OfEveryFormat, AnyReader,
                         ::testing::Range(std::size_t{0}, inputs().size()),
                         [](const auto& instance) {
                           std::string name = inputs()[instance.param].name;
                           for (char& c : name)
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           return name;
                         });

}  // namespace
}  // namespace mapproof
