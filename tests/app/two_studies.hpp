#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {

namespace fs = std::filesystem;

inline const std::string kStudy = std::string(MAPPROOF_TEST_DATA) + "/study";
inline const std::string kImages = std::string(MAPPROOF_SOURCE_DIR) + "/tests/baselines";

/// Writes `to` for the first `from` in a file.
inline void replace_in(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = read_file(file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  write_file(file, text.replace(at, from.size(), to));
}

/// A baseline and a copy of it, for one to be changed.
struct TwoStudies {
  TemporaryFolder folder;
  std::string before = folder / "before";
  std::string after = folder / "after";

  TwoStudies() {
    for (const std::string& copy : {before, after}) {
      fs::copy(kStudy, copy, fs::copy_options::recursive);
      fs::create_directory(fs::path(copy) / "figures");
      for (const char* image : {"curve-usual", "map-usual", "pair-usual"})
        fs::copy_file(fs::path(kImages) / (std::string(image) + ".png"),
                      fs::path(copy) / "figures" / (std::string(image) + ".png"));
    }
  }
  void change_image() const {
    fs::copy_file(fs::path(kImages) / "curve-log.png", fs::path(after) / "figures/map-usual.png",
                  fs::copy_options::overwrite_existing);
  }
  /// In one run alone, so that it has no direction.
  void change_score() const {
    replace_in(fs::path(after) / "runs/layout-1-pose-1.json", "\"mpe_m\": 0.", "\"mpe_m\": 0.9");
  }
};

}  // namespace mapproof::test
