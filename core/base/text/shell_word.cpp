#include "core/base/text/shell_word.hpp"

#include <string_view>

namespace mapproof {

std::string shell_word(const std::string& word) {
  if (word.starts_with("~/")) return "~/" + (word.size() > 2 ? shell_word(word.substr(2)) : "");
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_./=,:+@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace mapproof
