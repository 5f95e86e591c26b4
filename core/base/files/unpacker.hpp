#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace mapproof {

/// Unpacks the bytes of gzip and xz as they come, also members and streams that follow one another,
/// and makes UTF-8 of UTF-16 with a byte order mark, packed or not. Other bytes pass unchanged.
class Unpacker {
 public:
  /// @param source  The name of the input in errors.
  explicit Unpacker(std::string source);
  ~Unpacker();
  Unpacker(Unpacker&&) noexcept;
  Unpacker& operator=(Unpacker&&) noexcept;

  /// Gives it the next packed bytes.
  void feed(std::string_view packed);

  /// No more bytes come: drain() then gives those that might have begun a packed file.
  void end();

  /// Appends unpacked bytes to `bytes`, at most `count`.
  /// @return How many were appended; fewer than `count`: all that was fed is used up.
  /// @throws IoError if the packed bytes are damaged; if they unpack to more than 64 MB and more
  ///         than 300 times their number, which no table does; or if unpacking takes more than
  ///         128 MB of memory.
  std::size_t drain(std::string& bytes, std::size_t count);

  /// feed(), then all that drain() gives.
  std::string take(std::string_view packed);

  /// "gzip", "xz" or "UTF-16"; empty if the input is not packed, or as long as that is not known.
  std::string_view packing() const;

  /// Whether the input is not packed and drain() has given all that was fed.
  bool is_passing() const;

  /// After end() and drain(): whether the packed bytes are cut off.
  bool is_cut() const;

  /// Unpacked bytes per packed byte so far; 1 before the first.
  double ratio() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Refuses more than 64 MB that are more than 300 times as large as their packed bytes.
/// @throws IoError.
void refuse_bomb(const std::string& source, double packed_bytes, double unpacked_bytes);

/// The first bytes of what zlib packed, `most` or all; fewer where it is damaged.
std::string zlib_start(std::string_view packed, std::size_t most);

}  // namespace mapproof
