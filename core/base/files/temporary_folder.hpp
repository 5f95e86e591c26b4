#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "core/base/files/descriptor.hpp"

namespace mapproof {

/// A new folder for temporary files, for this user alone. It is removed with all that is in it when
/// this object ends; if the program is killed, by the next one of the same purpose. It is locked as
/// long as it is used, where the file system has locks.
class TemporaryFolder {
 public:
  /// @param purpose  In its name: "mapproof-PURPOSE-XXXXXX". @throws IoError.
  explicit TemporaryFolder(const std::string& purpose);
  ~TemporaryFolder();
  TemporaryFolder(TemporaryFolder&& other) noexcept
      : path_(std::exchange(other.path_, {})), lock_(std::move(other.lock_)) {}
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(lock_, other.lock_);
    return *this;
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  Descriptor lock_{-1};
};

}  // namespace mapproof
