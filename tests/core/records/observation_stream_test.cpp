#include "core/records/observations/observation_stream.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/records/observations/observations.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

using test::error_of;

constexpr const char* kText =
    "landmark,step,value\n"
    "door,0,0.5\n"
    "desk,0,-1\n"
    "\n"
    "door,2,0.25\n"
    "# a remark\n"
    "lamp,2,nan\n"
    "desk,3,1e-1";

/// All steps of a text that comes in pieces of so many bytes.
std::vector<StreamedStep> streamed(const std::string& text, std::size_t piece,
                                   ObservationStream& stream) {
  std::vector<StreamedStep> steps;
  const auto take = [&] {
    for (StreamedStep& step : stream.steps()) steps.push_back(std::move(step));
  };
  for (std::size_t at = 0; at < text.size(); at += piece) {
    stream.take(std::string_view(text).substr(at, piece));
    take();
  }
  stream.end();
  take();
  return steps;
}

TEST(ObservationStream, GivesTheStepsOfTheFileHoweverItsBytesCome) {
  test::TemporaryFolder folder;
  const std::string path = folder.file("long.csv", kText);
  const ObservationHistory whole =
      read_observations(path, Sensor::kBearing, {.layout = Layout::kLong}).history;
  for (std::size_t piece = 1; piece < 80; ++piece) {
    ObservationStream stream("long.csv", Sensor::kBearing);
    const auto steps = streamed(kText, piece, stream);
    ASSERT_EQ(static_cast<Eigen::Index>(steps.size()), whole.steps());
    EXPECT_EQ(stream.names(), whole.names);
    for (std::size_t t = 0; t < steps.size(); ++t) {
      Eigen::VectorXd column =
          Eigen::VectorXd::Constant(whole.landmarks(), std::numeric_limits<double>::quiet_NaN());
      for (const auto& [row, value] : steps[t].values) column(row) = value;
      for (Eigen::Index i = 0; i < column.size(); ++i) {
        const double expected = whole.values(i, static_cast<Eigen::Index>(t));
        EXPECT_TRUE(column(i) == expected || (std::isnan(column(i)) && std::isnan(expected)));
      }
    }
  }
}

TEST(ObservationStream, HoldsAStepBackUntilALaterOneBegins) {
  ObservationStream stream("f", Sensor::kVisibility);
  stream.take("0,a,1\n0,b,1\n");
  EXPECT_TRUE(stream.steps().empty());
  stream.take("1,a,");
  EXPECT_TRUE(stream.steps().empty());  // The line may still become one of step 0.
  stream.take("1\n");
  EXPECT_EQ(stream.steps().size(), 1U);
  stream.take("1,b,0.");
  stream.drop_half_line();
  stream.end();
  EXPECT_EQ(stream.steps().size(), 1U);
}

TEST(ObservationStream, SeparatesCellsByWhatTheFirstRowHolds) {
  ObservationStream stream("f", Sensor::kVisibility);
  stream.take("# x;y\nstep,landmark,value\n2,x;y,1\n2,\ttab,1\n");
  stream.end();
  EXPECT_EQ(stream.names(), (std::vector<std::string>{"x;y", "tab"}));
  ObservationStream semicolons("f", Sensor::kRange);
  semicolons.take("0;a,b;2.5\n");
  semicolons.end();
  EXPECT_EQ(semicolons.names(), (std::vector<std::string>{"a,b"}));
}

TEST(ObservationStream, RemarksThatTheLastLineHasNoEnd) {
  const auto remarks = [](const std::string& text) {
    ObservationStream stream("f", Sensor::kRange);
    stream.take(text);
    stream.end();
    return stream.remarks();
  };
  EXPECT_TRUE(remarks("0,a,86.98746\n").empty());
  EXPECT_TRUE(remarks("0,a,86.98746\n# no row").empty());
  EXPECT_EQ(remarks("0,a,86.987"), std::vector<std::string>{kCutRemark});
}

TEST(ObservationStream, LeavesALastLineOutThatIsCutAndNoRow) {
  ObservationStream stream("f", Sensor::kVisibility);
  stream.take("0,a,1\n0,b,1\n1,a,1\n1,");
  stream.end();
  EXPECT_EQ(stream.remarks(), (std::vector<std::string>{kCutOffRemark}));
  EXPECT_EQ(stream.steps().size(), 2U);
}

TEST(ObservationStream, RemarksWhichColumnsItDoesNotRead) {
  ObservationStream stream("f", Sensor::kVisibility);
  stream.take("step,weather,landmark,value\n0,dry,a,1\n");
  stream.end();
  EXPECT_EQ(stream.remarks(), (std::vector<std::string>{"Columns that are not read: \"weather\""}));
}

TEST(ObservationStream, TakesWhatItsSensorSawOfDetections) {
  const std::string text = "time,landmark,range,bearing\n0.5,a,2,1\n0.5,b,3,\n0.75,b,4,-1\n";
  const auto all = [&](Sensor sensor) {
    ObservationStream stream("f", sensor);
    const auto steps = streamed(text, 5, stream);
    std::vector<std::vector<std::pair<Eigen::Index, double>>> values;
    for (const StreamedStep& step : steps) values.push_back(step.values);
    return values;
  };
  using Values = std::vector<std::vector<std::pair<Eigen::Index, double>>>;
  EXPECT_EQ(all(Sensor::kRange), (Values{{{0, 2.0}, {1, 3.0}}, {{1, 4.0}}}));
  EXPECT_EQ(all(Sensor::kBearing), (Values{{{0, 1.0}}, {{1, -1.0}}}));
  EXPECT_EQ(all(Sensor::kVisibility), (Values{{{0, 1.0}, {1, 1.0}}, {{1, 1.0}}}));
}

TEST(ObservationStream, RefusesDetectionsThatItsSensorDidNotMeasureAsTheFileIs) {
  test::TemporaryFolder folder;
  const auto refused = [&](const std::string& text, Sensor sensor) {
    const std::string path = folder.file("seen.csv", text);
    const std::string of_file = error_of([&] { read_observations(path, sensor); });
    const std::string of_stream = error_of([&] {
      ObservationStream stream(path, sensor);
      stream.take(text);
      stream.end();
    });
    EXPECT_EQ(of_stream, of_file);
    return of_file.substr(of_file.find(": ") + 2);
  };
  // One row with decimal commas: at 1.1, a landmark was seen. Found by the fuzzer.
  EXPECT_EQ(refused("1,1;,\"ash\"oStep,Valu,1\n", Sensor::kRange), "holds no range");
  EXPECT_EQ(refused("time,landmark\n0.5,a\n0.75,b\n", Sensor::kBearing), "holds no bearing");
  EXPECT_EQ(refused("time,landmark,range\n0.5,a,\n0.75,b,\n", Sensor::kRange), "holds no range");
  // Without such a column nothing can follow; with one, a measurement still may.
  ObservationStream list("f", Sensor::kRange);
  EXPECT_EQ(error_of([&] { list.take("0.5,a\n"); }), "f: holds no range");
  ObservationStream empty("f", Sensor::kRange);
  empty.take("time,landmark,range\n0.5,a,\n0.75,b,\n1,a,2\n");
  empty.end();
  EXPECT_EQ(empty.steps().size(), 3U);
}

TEST(ObservationStream, NamesTheLineOfWhatIsWrong) {
  const auto error = [](const std::string& text) {
    return error_of([&] {
      ObservationStream stream("f", Sensor::kVisibility);
      stream.take(text);
      stream.end();
    });
  };
  EXPECT_EQ(error("step,landmark,value\n0,a,1\n0,a,0\n"),
            "f: line 3: landmark \"a\" is already listed at step 0");
  EXPECT_EQ(error("5,a,1\n4,a,0\n"),
            "f: line 2: step 4 after step 5: a streamed file lists its scans in ascending "
            "order");
  EXPECT_EQ(error("0,a,1\n0,?,1\n"),
            "f: line 2: a measurement without a landmark ID (?): the data association is estimated "
            "for whole files");
  EXPECT_EQ(error("0,1"), "f: line 1: has 2 cells, expected 3");
  EXPECT_EQ(error("0,1\n"), "f: line 1: has 2 cells, expected 3");
  EXPECT_EQ(error("time,landmark,value\n0.5,a,1\n0.25,a,1\n"),
            "f: line 3: time 0.25 after time 0.5: a streamed file lists its scans in "
            "ascending order");
  EXPECT_EQ(error("step,landmark,strength\n"),
            "f: line 1: no column is named range or bearing; there is \"strength\": --columns "
            "ROLE=HEADER names them; a list of times and landmarks alone is read as visibility");
  EXPECT_EQ(error("step,landmark,value,robot\n"), "f: line 1: a streamed file is of one robot");
  EXPECT_EQ(error("0,a,1\n0,\"b,1\n"),
            "f: line 2: its quotes are broken, or a cell goes over its end");
  EXPECT_EQ(error("0,a\xff,1\n"), "f: line 1: is not UTF-8 text, or holds a NUL byte");
  EXPECT_TRUE(error("0,a,0.5\n").starts_with("f: line 1: "));
  EXPECT_EQ(error(std::string((1 << 20) + 1, 'x')), "f: line 1: is longer than 1 MiB");
}

}  // namespace
}  // namespace mapproof
