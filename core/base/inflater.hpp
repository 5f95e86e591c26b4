#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace mapproof {

/// Refuses what inflates beyond 64 MB to more than 300 times its size, which no table does.
/// @throws IoError of `source`.
void refuse_bomb(const std::string& source, double packed_bytes, double inflated_bytes);

/// Inflates gzip'ed bytes as they come; those that are not gzip'ed pass as they are.
class Inflater {
 public:
  /// @param source  What to call the bytes in errors.
  explicit Inflater(std::string source);
  ~Inflater();
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// What the next bytes come to, as far as can be told so far.
  /// @throws IoError if they are damaged, or inflate beyond 64 MB to more than 300 times their
  ///         number, which no table does.
  std::string take(std::string_view bytes);

  /// There will be no more. @return What was held back: a single byte that began no gzip.
  std::string end();

  /// After end(): the gzip'ed bytes stop before their end.
  bool is_cut() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mapproof
