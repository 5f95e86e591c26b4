#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/unpacker.hpp"

namespace mapproof {

/// Writes the next bytes to `to`, as many as it likes. @return How many; 0 at the end.
using ReadBytes = std::function<std::size_t(std::span<char> to)>;

/// The bytes of an input, once from its start to its end; unpacked if they are gzip'ed or xz'ed,
/// whatever the input is called. Its start can be looked at before it is read, which tells of what
/// kind it is. Files, pipes and standard input read the same, however their bytes come.
///
/// All members throw IoError if the input cannot be read, or its packing is cut off, damaged or a
/// bomb (see Unpacker).
class ByteSource {
 public:
  /// How much is looked at to tell one kind of file from others.
  static constexpr std::size_t kPeek = std::size_t{1} << 16;
  /// The most that is read as a whole.
  static constexpr std::size_t kLargest = std::size_t{1} << 31;

  /// Opens a file or a stream (see open_input()). @throws IoError.
  explicit ByteSource(const std::filesystem::path& path);

  /// Of bytes that come from elsewhere.
  /// @param name  What to call them in errors.
  ByteSource(std::string name, ReadBytes read);

  /// What to call it in errors: its path, or "standard input".
  const std::string& name() const { return name_; }

  /// Where the file is, for those that stand beside it; empty for a stream, which has no place.
  const std::filesystem::path& path() const { return path_; }

  /// The next bytes, `count` of them or all there are, which stay unread.
  /// @note Good until the source is read or looked at again.
  std::string_view peek(std::size_t count = kPeek);

  /// Adds the next bytes to `bytes`, `count` of them or all there are. @return Whether there were
  /// any.
  bool append(std::string& bytes, std::size_t count);

  /// All that is left. @throws IoError if that is more than `limit` bytes.
  std::string rest(std::size_t limit = kLargest);

  /// Whether more than `count` bytes are left. Those of a stream or a packed file are kept for it,
  /// and stay unread.
  bool holds_more_than(std::size_t count);

  /// Bytes of the whole, unpacked as those so far; empty for a stream.
  std::optional<double> expected_size() const;

 private:
  std::size_t fill(std::string& bytes, std::size_t count);
  std::size_t fill_plain(std::string& bytes, std::size_t count);
  std::size_t ahead() const;

  std::string name_;
  std::filesystem::path path_;
  ReadBytes read_;
  std::optional<std::size_t> size_;  ///< Bytes in the file; empty: not known.
  Unpacker unpacker_;
  bool is_over_ = false;           ///< read_ gives no more.
  std::deque<std::string> ahead_;  ///< What was looked at; of the first, what stands from at_ on.
  std::size_t at_ = 0;
  std::size_t taken_ = 0;  ///< Bytes that were read.
};

/// The whole of an input. @throws IoError as ByteSource.
std::string read_input(const std::filesystem::path& path, std::size_t limit = ByteSource::kLargest);

}  // namespace mapproof
