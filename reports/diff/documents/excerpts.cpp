#include "reports/diff/documents/excerpts.hpp"

#include <algorithm>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kBefore = 24;  // Bytes of the common beginning that are shown.

/// The start of the excerpt: at a word, at most kBefore bytes before `at`, never within a
/// character.
std::size_t beginning(const std::string& text, std::size_t at) {
  std::size_t from = at > kBefore ? at - kBefore : 0;
  const std::size_t blank = text.find(' ', from);
  if (from > 0 && blank < at) from = blank + 1;
  const auto is_within = [&](std::size_t i) {
    return i > 0 && i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
  };
  while (is_within(from)) --from;
  return from;
}

}  // namespace

std::pair<std::string, std::string> excerpts(const std::string& a, const std::string& b,
                                             std::size_t most) {
  std::pair<std::string, std::string> shown{printable(a, most), printable(b, most)};
  if (shown.first != shown.second || a == b) return shown;
  const auto [first, second] = std::ranges::mismatch(a, b);
  const std::size_t from = beginning(a, static_cast<std::size_t>(first - a.begin()));
  return {"\u2026 " + printable(a.substr(from), most), "\u2026 " + printable(b.substr(from), most)};
}

}  // namespace mapproof
