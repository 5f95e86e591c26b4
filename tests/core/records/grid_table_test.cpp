#include "core/records/observations/grid_table.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/observe/proximities.hpp"
#include "core/records/observations/observations.hpp"
#include "core/records/tables/table_reader.hpp"
#include "tests/support/byte_sources.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

using test::source_of;

/// The numbers of a table by TableReader's cells and the C library.
Eigen::MatrixXd by_strtod(const std::string& text, std::size_t skipped_rows,
                          std::size_t skipped_columns) {
  const std::string name = "table";
  TableReader reader(text, name);
  TableRow row;
  std::vector<std::vector<double>> rows;
  for (std::size_t k = 0; reader.next(row); ++k) {
    if (k < skipped_rows) continue;
    rows.emplace_back();
    for (std::size_t i = skipped_columns; i < row.cells.size(); ++i)
      rows.back().push_back(row.cells[i].empty()
                                ? std::nan("")
                                : std::strtod(std::string(row.cells[i]).c_str(), nullptr));
  }
  Eigen::MatrixXd values(std::ssize(rows), std::ssize(rows.front()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < rows[i].size(); ++k)
      values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = rows[i][k];
  return values;
}

bool are_equal(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         (a.array() == b.array() || (a.array().isNaN() && b.array().isNaN())).all();
}

struct Written {
  const char* header;
  const char* name;  ///< A format of the row's number.
  const char* value;
  const char* separator;
  bool is_transposed;
};

/// Rows of random bearings in many ways in which programs write numbers; some are missing.
std::string table_of(const Written& as, int rows, int columns, double missing) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(-3.1, 3.1), chance(0.0, 1.0);
  std::string text = as.header;
  for (int r = 0; r < rows; ++r) {
    text += fmt::format(fmt::runtime(as.name), r);
    for (int c = 0; c < columns; ++c) {
      if (c > 0 || *as.name != '\0') text += as.separator;
      if (chance(random) >= missing)
        text += fmt::format(fmt::runtime(as.value), angle(random));
      else if (as.separator[0] == ' ' || chance(random) < 0.5)
        text += "NaN";
    }
    text += r % 7 == 0 ? "\r\n" : "\n";
  }
  return text;
}

TEST(GridTable, HoldsTheNumbersThatTheCLibraryReads) {
  const Written forms[] = {
      {"", "L{}", "{:.4f}", ",", false},
      {"", "\"L {}\"", "{:.6f}", ";", false},
      {"", "row{}", "{:.18e}", " ", false},
      {"", "L{}", "{:.3g}", "\t", false},
      {"step,a,b,c,d,e,f,g\n", "{}", "{:.17g}", ",", true},
      {"# made by hand\nstep, a, b, c, d, e, f, g\n", "{}", "{:.5f}", ", ", true},
      {"time;a;b;c;d;e;f;g\n", "{}.25", "{:.10f}", ";", true},
  };
  for (const Written& form : forms)
    for (const double missing : {0.0, 0.2})
      for (const int rows : {12, 3000}) {
        if (!form.is_transposed && rows > 1000) continue;
        const std::string text = table_of(form, rows, form.is_transposed ? 7 : 2200, missing);
        ByteSource source = source_of(text, 1000);
        const PackedSource read = read_grid(source, Sensor::kBearing);
        const Eigen::MatrixXd values = by_strtod(text, form.is_transposed ? 1 : 0, 1);
        const Eigen::MatrixXd expected =
            form.is_transposed ? Eigen::MatrixXd(values.transpose()) : values;
        ASSERT_TRUE(are_equal(read.history.array().values, expected)) << form.value << rows;
        EXPECT_EQ(read.history.missing, static_cast<double>(expected.array().isNaN().count()));
        EXPECT_EQ(read.history.blocks().is_complete(), missing == 0.0);
      }
}

// Blocks give what the array has, in any part and with any stride.
TEST(GridTable, GivesTheSameProximitiesPackedAndAsAnArray) {
  for (const bool is_transposed : {false, true})
    for (const Sensor sensor : {Sensor::kBearing, Sensor::kRange, Sensor::kVisibility})
      for (const double missing : {0.0, 0.1}) {
        std::mt19937 random(5);
        std::uniform_real_distribution<double> chance(0.0, 1.0);
        constexpr int kLandmarks = 6, kSteps = 9000;
        std::string text;
        for (int r = 0; r < (is_transposed ? kSteps : kLandmarks); ++r) {
          if (!is_transposed) text += fmt::format("L{}", r);
          for (int c = 0; c < (is_transposed ? kLandmarks : kSteps); ++c) {
            if (c > 0 || !is_transposed) text += ",";
            if (chance(random) < missing) continue;
            const double value = chance(random);
            text += sensor == Sensor::kVisibility ? (value < 0.3 ? "1" : "0")
                                                  : fmt::format("{:.4f}", 3.0 * value);
          }
          text += "\n";
        }
        ByteSource source = source_of(text);
        TableFormat format;
        if (is_transposed) format.layout = Layout::kTransposed;
        const PackedSource packed = read_grid(source, sensor, format);
        const ObservationHistory array = packed.history.array();
        const HistoryBlocks blocks = packed.history.blocks();
        const Proximities a = proximities(blocks, kSteps), b = proximities(array, kSteps);
        EXPECT_TRUE(are_equal(a.squared_distances, b.squared_distances));
        EXPECT_TRUE(are_equal(a.inner_products, b.inner_products));
        EXPECT_TRUE(are_equal(steps_observed_together(blocks, kSteps),
                              steps_observed_together(array, kSteps)));
        const Eigen::MatrixXd some = blocks.between(100, 8000).every(13).values(5, 400);
        for (Eigen::Index k = 0; k < some.cols(); ++k)
          ASSERT_TRUE(are_equal(some.col(k), array.values.col(100 + 13 * (5 + k)))) << k;
      }
}

TEST(GridTable, IsTheSameByFileAndPacked) {
  const test::TemporaryFolder folder;
  const std::string text =
      table_of({"step,a,b,c,d,e,f,g\n", "{}", "{:.4f}", ",", true}, 20'000, 7, 0.01);
  ByteSource plain(folder.file("t.csv", text));
  ByteSource packed(folder.file("t.csv.gz", test::gzipped(text)));
  ByteSource stream = source_of(text, 777);
  const Eigen::MatrixXd values = read_grid(plain, Sensor::kBearing).history.array().values;
  EXPECT_TRUE(are_equal(values, read_grid(packed, Sensor::kBearing).history.array().values));
  EXPECT_TRUE(are_equal(values, read_grid(stream, Sensor::kBearing).history.array().values));
}

std::string problem_of(const std::string& text, const TableFormat& format = {}) {
  ByteSource source = source_of(text, 1 << 16, "table");
  try {
    read_grid(source, Sensor::kBearing, format);
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

TEST(GridTable, ReadsARowWhoseFirstNumberHasAnotherForm) {
  for (const char* first : {".5", "\"0.5\"", "+0.5", "5e-1"}) {
    SCOPED_TRACE(first);
    std::string text;
    for (int i = 0; i < 3; ++i) text += std::string(first) + ",1.25,2.5,3\n";
    ByteSource source = source_of(text);
    const PackedSource read = read_grid(source, Sensor::kRange, {.layout = Layout::kWide});
    EXPECT_EQ(read.history.array().values(2, 0), 0.5);
    EXPECT_EQ(read.history.array().values(2, 3), 3.0);
  }
}

TEST(GridTable, NamesTheFirstThingThatIsWrong) {
  EXPECT_EQ(problem_of("a,1,2,3\nb,1,2\nc,1,2,x\n"),
            "table: line 2: has 3 cells where line 1 has 4");
  EXPECT_EQ(problem_of("a,1,2,3\nb,1,2,x\nc,1,2\n"),
            "table: line 2, column 4: \"x\" is not a number");
  EXPECT_EQ(problem_of("a,1,2,3\n\n# none\nb,1,90,3\n"),
            "table: line 4, column 3: bearings are in radians from the heading, "
            "counter-clockwise, within a full turn; 90 looks like degrees: --degrees");
  EXPECT_EQ(problem_of("a,1,2,3\nb,1,2,3\na,1,2,x\n"),
            "table: line 3: landmark \"a\" is already on line 1");
  EXPECT_EQ(problem_of("step,a,b,a\n0,1,2,3\n1,1,2,3\n"),
            "table: line 1: landmark \"a\" is already on line 1");
  EXPECT_EQ(problem_of("name,0,1,2\n"), "table: holds a header and no rows");
}

TEST(GridTable, SubtractsRadiansOnlyAfterDegrees) {
  ByteSource source = source_of("a,0.5,90\nb,180,\nc,-90.25,360\n");
  TableFormat format{.unit = AngleUnit::kDegrees};
  format.convention = BearingConvention::kClockwise;
  const Eigen::MatrixXd values = read_grid(source, Sensor::kBearing, format).history.array().values;
  EXPECT_EQ(values(0, 1), 0.0 - 90.0 * std::numbers::pi / 180.0);
  EXPECT_EQ(values(2, 0), 90.25 * std::numbers::pi / 180.0);
  EXPECT_TRUE(std::isnan(values(1, 1)));
}

}  // namespace
}  // namespace mapproof
