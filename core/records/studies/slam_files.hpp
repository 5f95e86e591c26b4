#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/records/studies/study_folder.hpp"

namespace mapproof {

/// Where things stand in the folder of a range-only study.
struct SlamFiles {
  std::filesystem::path folder;  ///< Empty: paths are below the folder.

  std::filesystem::path study() const { return folder / kStudyFile; }
  std::filesystem::path timings() const { return folder / kTimingsFile; }
  std::filesystem::path runs() const { return folder / "runs"; }
  std::vector<std::filesystem::path> records() const {
    return {runs(), paths(), curves(), histories(), space()};
  }
  std::filesystem::path run(const std::string& id) const { return runs() / (id + ".json"); }
  std::filesystem::path paths() const { return folder / "paths"; }
  std::filesystem::path paths(const std::string& id) const { return paths() / id; }
  std::filesystem::path curves() const { return folder / "convergence"; }
  std::filesystem::path curve(const std::string& id) const { return curves() / (id + ".json"); }
  std::filesystem::path histories() const { return folder / "histories.json"; }
  std::filesystem::path space() const { return folder / "space.json"; }
};

}  // namespace mapproof
