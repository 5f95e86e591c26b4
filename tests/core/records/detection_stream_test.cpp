#include "core/records/detections/detection_stream.hpp"

#include <gtest/gtest.h>

#include "core/records/detections/detections.hpp"
#include "tests/core/records/samples.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

using test::error_of;

constexpr const char* kScansText =
    "Robot;Time [s];Tag;Range [m];Bearing [deg];battery\n"
    "r1;0.5;door;1.5;90;9\n"
    "r2;0.5;door;2.5;;9\n"
    "r1;0.5;desk;;-45;9\n"
    "# a remark\n"
    "r2;0.75;lamp, tall;3;10;9\n"
    "\n"
    "r1;1.25;lamp, tall;4;20;9";

std::vector<StreamedScan> streamed(const std::string& text, std::size_t piece,
                                   DetectionStream& stream) {
  for (std::size_t at = 0; at < text.size(); at += piece)
    stream.take(std::string_view(text).substr(at, piece));
  stream.end();
  return stream.scans();
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

TEST(DetectionStream, GivesTheScansOfTheFileHoweverItsBytesCome) {
  test::TemporaryFolder folder;
  const DetectionLog whole = read_detections(folder.file("scans.csv", kScansText)).log;
  for (std::size_t piece = 1; piece < 200; ++piece) {
    DetectionStream stream("scans.csv", {});
    std::vector<StreamedScan> scans = streamed(kScansText, piece, stream);
    // As the reader pools them: robot by robot.
    std::ranges::sort(scans, {}, &StreamedScan::scan);
    ASSERT_EQ(std::ssize(scans), whole.steps);
    EXPECT_EQ(stream.names(), whole.names);
    EXPECT_TRUE(stream.is_timed());
    std::size_t k = 0;
    for (std::size_t step = 0; step < scans.size(); ++step) {
      EXPECT_EQ(scans[step].scan.key, whole.times_s[step]);
      for (const Detection& seen : scans[step].detections) {
        const Detection& expected = whole.detections.at(k++);
        EXPECT_EQ(expected.step, static_cast<int>(step));
        EXPECT_EQ(seen.landmark, expected.landmark);
        EXPECT_TRUE(same(seen.range_m, expected.range_m));
        EXPECT_TRUE(same(seen.bearing_rad, expected.bearing_rad));
      }
    }
    EXPECT_EQ(k, whole.detections.size());
    EXPECT_EQ(stream.remarks(),
              (std::vector<std::string>{"Columns that are not read: \"battery\"", kCutRemark}));
  }
}

TEST(DetectionStream, HoldsAScanBackUntilALaterOneOfTheRobotBegins) {
  DetectionStream stream("f", {});
  stream.take("0,a,1,0\n0,b,1,1\n");
  EXPECT_TRUE(stream.scans().empty());
  stream.take("3,b,1,1");
  EXPECT_TRUE(stream.scans().empty());
  stream.take("\n");
  ASSERT_EQ(stream.scans().size(), 1U);
  stream.take("4,a,1,");
  stream.drop_half_line();
  stream.end();
  EXPECT_EQ(stream.scans().size(), 1U);
  EXPECT_TRUE(stream.remarks().empty());
}

TEST(DetectionStream, HasAByteOrderMarkAtItsStartAlone) {  // Found by the fuzzer.
  const std::string mark = "\xEF\xBB\xBF", header = "time,landmark,range,bearing\n";
  test::TemporaryFolder folder;
  for (const std::string& rows : {mark + "1,a,2,0\n2,a,2,0\n", "1,a,2,0\n" + mark + "2,a,2,0\n"}) {
    const std::string text = mark + header + rows;
    DetectionStream stream("f", {});
    const std::string error = error_of([&] { stream.take(text); });
    EXPECT_NE(error.find("is not a time"), std::string::npos) << error;
    const std::string of_file = error_of([&] { read_detections(folder.file("f", text)); });
    EXPECT_NE(of_file.find("is not a time"), std::string::npos) << of_file;
  }
  DetectionStream stream("f", {});
  EXPECT_EQ(streamed(mark + header + "1,a,2,0\n2,a,2,0\n", 1, stream).size(), 2U);
}

TEST(DetectionStream, TakesALineOfTabsForARowIfTabsSeparate) {  // Found by the fuzzer.
  const std::string header = "time\tlandmark\trange\tbearing\n", row = "1\ta\t2\t0\n";
  test::TemporaryFolder folder;
  const std::string text = header + row + "\t\t\t\n";
  DetectionStream stream("f", {});
  const std::string error = error_of([&] { stream.take(text); });
  EXPECT_NE(error.find("line 3"), std::string::npos) << error;
  EXPECT_EQ(error_of([&] { read_detections(folder.file("f", text)); }),
            (folder / "f").string() + error.substr(1));
  DetectionStream blanks("f", {});
  EXPECT_EQ(streamed(header + " \r\n\n# none\n" + row, 1, blanks).size(), 1U);
}

TEST(DetectionStream, StatesItsSeparatorInItsFirstLineAlone) {  // Found by the fuzzer.
  const std::string rows = "time;landmark;range;bearing\n1;a;2;0\n2;a;2;0\n";
  DetectionStream stream("f", {});
  EXPECT_EQ(streamed("sep=;\n" + rows, 1, stream).size(), 2U);
  test::TemporaryFolder folder;
  DetectionStream late("f", {});
  const std::string error = error_of([&] { late.take(rows + "sep=;\n"); });
  EXPECT_NE(error.find("line 4"), std::string::npos) << error;
  const auto file = folder.file("f", rows + "sep=;\n");
  EXPECT_EQ(error_of([&] { read_detections(file); }), file.string() + error.substr(1));
}

TEST(DetectionStream, NamesTheLineOfWhatIsWrong) {
  const auto error = [](const std::string& text) {
    return error_of([&] {
      DetectionStream stream("f", {});
      stream.take(text);
      stream.end();
    });
  };
  EXPECT_EQ(error("0,a,1,0\n0,a,2,0\n"), "f: line 2: landmark \"a\" is in that scan already");
  EXPECT_EQ(error("time,landmark,range,bearing\n5,a,1,0\n4.5,a,1,0\n"),
            "f: line 3: time 4.5 after time 5: a streamed file lists a robot's scans in "
            "ascending order");
  EXPECT_EQ(error("0,a,1\n"),
            "f: line 1: has 3 cells; a table of detections has a header, or the columns step, "
            "landmark, range, bearing; --columns names others");
  EXPECT_EQ(error("0,a,1,0\n1,a,1\n"), "f: line 2: has 3 cells, expected 4");
  EXPECT_TRUE(error("0,a,-1,0\n").starts_with("f: line 1: "));
}

}  // namespace
}  // namespace mapproof
