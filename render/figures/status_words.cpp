#include "render/figures/status_words.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace mapproof {

std::string status_words(const Status& status) {
  if (!status.detail.empty()) return status.detail;
  std::string text(name(status.code));
  std::ranges::replace(text, '_', ' ');
  return text;
}

void add_status_notes(const std::vector<std::string>& lines, std::vector<Note>& notes) {
  constexpr std::size_t kMost = 4;
  for (std::size_t i = 0; i < std::min(lines.size(), kMost); ++i)
    notes.push_back({"\u26A0 " + lines[i], Ink::kWarning});
  if (lines.size() > kMost)
    notes.push_back(
        {fmt::format("\u26A0 {} more, see the record.", lines.size() - kMost), Ink::kWarning});
}

}  // namespace mapproof
