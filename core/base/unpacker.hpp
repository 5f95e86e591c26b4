#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace mapproof {

/// Unpacks gzip'ed and xz'ed bytes as they come, members and streams one behind the other too;
/// others pass as they are.
class Unpacker {
 public:
  /// @param source  What to call the bytes in errors.
  explicit Unpacker(std::string source);
  ~Unpacker();
  Unpacker(Unpacker&&) noexcept;
  Unpacker& operator=(Unpacker&&) noexcept;

  /// Gives it the next bytes.
  void feed(std::string_view packed);

  /// There will be no more: what was held back because it may have begun a packed file passes.
  void end();

  /// Adds to `bytes` what the bytes so far come to, at most `count` of it.
  /// @return How much was added; less than `count`: it has to be fed.
  /// @throws IoError if they are damaged; or unpack beyond 64 MB to more than 300 times their
  ///         number, which no table does, or with more than 128 MB of memory.
  std::size_t drain(std::string& bytes, std::size_t count);

  /// feed() and drain() of all.
  std::string take(std::string_view packed);

  /// "gzip" or "xz"; empty: not packed, or not known yet.
  std::string_view packing() const;

  /// Whether all that was fed passes as it is, and nothing of it is held back any more.
  bool is_passing() const;

  /// After end() and drain(): the packed bytes stop before their end.
  bool is_cut() const;

  /// Size of what was drained over that of what it was made from; 1 before anything was.
  double ratio() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mapproof
