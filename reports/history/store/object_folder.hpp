#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/history/nightly_run.hpp"

namespace mapproof {

/// Files kept by what is in them, each once: STORE/objects/ab/abcd…, named by their SHA-256.
class ObjectFolder {
 public:
  explicit ObjectFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Where the file of that digest is or would be.
  std::filesystem::path path(const std::string& digest) const;

  /// Keeps every file of a folder, which holds no folders, and replaces each by a hard link, so
  /// that both take the space of one. The file is copied where hard links are not available.
  /// @return By name. @throws IoError.
  std::vector<FigureFile> keep(const std::filesystem::path& figures) const;

  /// Removes what none of `digests`, which ascend, names. @return How many files. @throws IoError.
  int remove_others(const std::vector<std::string>& digests) const;

  /// One sentence for each problem: a file that is missing, or whose contents do not match its
  /// name.
  std::vector<std::string> problems(const std::vector<std::string>& digests) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace mapproof
