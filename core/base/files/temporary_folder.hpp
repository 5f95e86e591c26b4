#pragma once

#include <filesystem>
#include <string>
#include <utility>

namespace mapproof {

/// A new folder for temporary files, for this user alone. It is removed with all that is in it when
/// this object ends.
class TemporaryFolder {
 public:
  /// @param purpose  In its name: "mapproof-PURPOSE-XXXXXX". @throws IoError.
  explicit TemporaryFolder(const std::string& purpose);
  ~TemporaryFolder();
  TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept {
    std::swap(path_, other.path_);
    return *this;
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace mapproof
