#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace mapproof {

/// The bytes of a file block by block; inflated if they are gzip'ed, whatever the file is called.
class PackedFile {
 public:
  /// @throws IoError if it cannot be opened, or is a folder.
  explicit PackedFile(const std::filesystem::path& path);
  ~PackedFile();
  PackedFile(const PackedFile&) = delete;
  PackedFile& operator=(const PackedFile&) = delete;

  /// Adds up to `count` bytes to `bytes`.
  /// @return Whether there were any.
  /// @throws IoError if the file cannot be read, is cut off or damaged, or inflates beyond 64 MB to
  ///         more than 300 times its size, which no table does.
  bool append(std::string& bytes, std::size_t count);

  /// Bytes of the whole, inflated as what was read so far.
  double expected_size() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The whole file, inflated. @throws IoError as above, and if it holds more than `limit` bytes.
std::string read_packed_file(const std::filesystem::path& path,
                             std::size_t limit = std::size_t{1} << 31);

/// The name without the ending .gz.
std::filesystem::path unpacked_name(const std::filesystem::path& path);

}  // namespace mapproof
