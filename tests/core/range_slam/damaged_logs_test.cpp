// Whatever bytes a person feeds the readers of range logs: a log, or an IoError of one line.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/records/ranges/range_logs.hpp"
#include "tests/core/range_slam/sample_log.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;
using namespace std::string_literals;
using test::csv_folder;
using test::sample_log;

/// Whatever is damaged: a log, or an error of one line.
void read_damaged(const fs::path& path) {
  try {
    const RangeLog log = read_range_log(path);
    for (const RangeMeasurement& measured : log.ranges)
      EXPECT_TRUE(std::isfinite(measured.range_m));
  } catch (const IoError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

class DamagedMat : public ::testing::TestWithParam<bool> {};

TEST_P(DamagedMat, CutOffAnywhereItIsALogOrAnError) {
  const test::TemporaryFolder folder;
  test::write_mat(sample_log(), folder / "a.mat", GetParam());
  const std::string bytes = read_file(folder / "a.mat");
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    const fs::path path = folder.file("b.mat", std::string_view(bytes).substr(0, size));
    // Between two variables a file may end; the last one then is not there.
    try {
      EXPECT_FALSE(read_range_log(path).true_landmarks) << size;
    } catch (const IoError&) {
    }
  }
}

TEST_P(DamagedMat, WithAnyBitTurnedItIsALogOrAnError) {
  const test::TemporaryFolder folder;
  test::write_mat(sample_log(), folder / "a.mat", GetParam());
  const std::string bytes = read_file(folder / "a.mat");
  Random random(7);
  for (std::size_t at = 0; at < bytes.size(); at += at < 256 ? 1 : 5) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (random.next() % 8)));
    read_damaged(folder.file("b.mat", damaged));
  }
}

TEST_P(DamagedMat, WithSeveralBytesReplacedItIsALogOrAnError) {
  const test::TemporaryFolder folder;
  test::write_mat(sample_log(), folder / "a.mat", GetParam());
  const std::string bytes = read_file(folder / "a.mat");
  Random random(11);
  for (int round = 0; round < 300; ++round) {
    std::string damaged = bytes;
    for (int i = 0; i < 4; ++i)
      damaged[128 + random.next() % (damaged.size() - 128)] = static_cast<char>(random.next());
    read_damaged(folder.file("b.mat", damaged));
  }
}

TEST(DamagedTexts, AreALogOrAnError) {
  const RangeLog log = sample_log();
  const test::TemporaryFolder folder;
  csv_folder(folder, log);
  const std::vector<std::pair<std::string, std::string>> texts = {
      {"a.pyfg", test::pyfg_of(log)},
      {"b_TD.txt", test::td_text_of(log)},
      {"b_DR.txt", test::dr_text_of(log)},
      {"set/ranges.csv", test::ranges_csv_of(log)},
      {"set/odometry.csv", test::odometry_csv_of(log)},
      {"set/groundtruth.csv", test::ground_truth_csv_of(log)},
      {"set/landmarks.csv", test::landmarks_csv_of(log)}};
  for (const auto& [name, text] : texts) folder.file(name, text);
  Random random(13);
  const std::string odd = "\n\0,;\t-eE.\"#9nai \xFF"s;
  for (const auto& [name, text] : texts) {
    for (int round = 0; round < 60; ++round) {
      std::string damaged =
          text.substr(0, text.size() - (round % 3 == 0 ? random.next() % text.size() : 0));
      for (int i = 0; i < 3; ++i)
        damaged[random.next() % damaged.size()] = odd[random.next() % odd.size()];
      const fs::path path = folder.file(name, damaged);
      read_damaged(name.starts_with("set/") ? folder / "set" : path);
    }
    folder.file(name, text);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, DamagedMat, ::testing::Bool(), [](const auto& which) {
  return std::string(which.param ? "compressed" : "plain");
});

}  // namespace
}  // namespace mapproof
