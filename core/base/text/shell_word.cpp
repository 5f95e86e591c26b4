#include "core/base/text/shell_word.hpp"

#include <string_view>

namespace mapproof {

std::string shell_word(const std::string& word) {
  // The home folder, and folders that are not named.
  for (const std::string_view folder : {"~/", kUnshownFolder})
    if (word.starts_with(folder)) {
      const std::string inside = word.substr(folder.size());
      return std::string(folder) + (inside.empty() ? "" : shell_word(inside));
    }
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_./=,:+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace mapproof
