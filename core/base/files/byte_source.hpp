#pragma once

#include <cstddef>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/files/unpacker.hpp"

namespace mapproof {

/// Writes the next bytes to the front of `to`, which is not empty. @return How many; 0 at the end.
using ReadBytes = std::function<std::size_t(std::span<char> to)>;

/// Reads the bytes of an input once, from its start to its end, and unpacks gzip and xz, whatever
/// the name of the input is. peek() shows the start before it is read, so that a reader can detect
/// the format. Files, pipes and standard input give the same bytes, however these are divided.
///
/// All members throw IoError if the input cannot be read, or if its packed bytes are cut off,
/// damaged or a bomb (see Unpacker).
class ByteSource {
 public:
  /// How many bytes peek() shows, to detect the format of a file.
  static constexpr std::size_t kPeek = std::size_t{1} << 16;
  /// The most bytes that rest() returns.
  static constexpr std::size_t kLargest = std::size_t{1} << 31;

  /// Opens a file or a stream (see open_input()). @throws IoError.
  explicit ByteSource(const std::filesystem::path& path);

  /// Reads from a function.
  /// @param name  The name of the input in errors.
  /// @param original  What the input was before the function made a text of it: "JSON lines".
  ByteSource(std::string name, ReadBytes read, std::string original = "");

  /// The name in errors: the path, or "standard input".
  const std::string& name() const { return name_; }

  /// The path of the file, to find others next to it; empty for a stream.
  const std::filesystem::path& path() const { return path_; }

  /// The unread bytes are a text: if its first character beyond ASCII is not UTF-8, they are taken
  /// as Windows-1252, and given as UTF-8 from here on.
  void take_text();

  /// The next `count` bytes, fewer only at the end; they stay unread.
  /// @note Valid until the next call of a member that is not const.
  std::string_view peek(std::size_t count = kPeek);

  /// Appends the next `count` bytes to `bytes`, fewer only at the end. @return Whether there were
  /// any.
  bool append(std::string& bytes, std::size_t count);

  /// All unread bytes. @throws IoError if they are more than `limit`.
  std::string rest(std::size_t limit = kLargest);

  /// Whether more than `count` bytes are unread; they stay unread.
  /// @note Holds some `count` bytes in memory, except for a file that is not packed.
  bool holds_more_than(std::size_t count);

  /// What the input was before it was made a text; empty: it was a text.
  const std::string& original() const { return original_; }

  /// "gzip", "xz" or "UTF-16"; empty if the input is none, or not begun.
  std::string_view packing() const { return unpacker_.packing(); }

  /// The packing of what was read so far, "Windows-1252" of a text that is, and what it was before:
  /// "gzip, Windows-1252".
  std::string form() const;

  /// Bytes of the whole input, estimated from the bytes so far if it is packed; empty for a
  /// stream.
  std::optional<double> expected_size() const;

 private:
  /// What take_text() found out.
  enum class Text { kBytes, kAscii, kUtf8, kWindows1252 };

  std::size_t fill(std::string& bytes, std::size_t count);
  std::size_t fill_unpacked(std::string& bytes, std::size_t count);
  std::string decoded(std::string bytes);
  std::size_t next_block() const;
  std::size_t fill_plain(std::string& bytes, std::size_t count);
  std::size_t ahead() const;

  std::string name_;
  std::filesystem::path path_;
  ReadBytes read_;
  std::string original_ = {};
  std::optional<std::size_t> size_;  ///< Bytes of the file, packed or not; empty: not known.
  Unpacker unpacker_;
  bool is_over_ = false;           ///< read_ has reached its end.
  std::deque<std::string> ahead_;  ///< Peeked blocks; of the first one the bytes from at_ on.
  std::size_t at_ = 0;
  std::size_t taken_ = 0;  ///< Bytes that were read.
  std::size_t block_ = 0;  ///< Bytes that were read together last.
  Text text_ = Text::kBytes;
  std::string decoded_;  ///< Text behind the peeked bytes.
};

/// The whole input, unpacked. @throws IoError as ByteSource, or if it has more than `limit` bytes.
std::string read_input(const std::filesystem::path& path, std::size_t limit = ByteSource::kLargest);

}  // namespace mapproof
