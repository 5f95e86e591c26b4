#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/history/night.hpp"

namespace mapproof {

/// Files kept by what is in them, each once: STORE/objects/ab/abcd…, named by their SHA-256.
class ObjectFolder {
 public:
  explicit ObjectFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Where the file of that digest is or would be.
  std::filesystem::path path(const std::string& digest) const;

  /// Keeps every file of a folder, which holds no folders, and puts a hard link in each one's
  /// place, so that both take the room of one. Where there are no hard links the file is copied.
  /// @return By name. @throws IoError.
  std::vector<FigureFile> keep(const std::filesystem::path& figures) const;

  /// Removes what none of `digests`, which ascend, names. @return How many files. @throws IoError.
  int remove_others(const std::vector<std::string>& digests) const;

  /// What is wrong, a sentence each: a file that is not there, or is not what its name says.
  std::vector<std::string> problems(const std::vector<std::string>& digests) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace mapproof
