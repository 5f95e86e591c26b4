#include "core/base/errors.hpp"

#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/base/text/utf8.hpp"

namespace mapproof {

IoError::IoError(const std::string& path, const std::string& what)
    : std::runtime_error(printable(path, 300) + ": " + what) {}

IoError::IoError(const std::string& path, const std::string& location, const std::string& what)
    : std::runtime_error(printable(path, 300) + ": " + location + ": " + what) {}

std::string printable(const std::string& text, std::size_t limit) {
  std::string out;
  std::size_t shown = 0;
  for (std::string_view rest = text; !rest.empty(); ++shown) {
    if (shown == limit) return out + "...";
    const std::string_view before = rest;
    const std::optional<char32_t> code = take_code_point(rest);
    if (!code) {
      out += fmt::format("\\x{:02X}", static_cast<unsigned char>(before.front()));
    } else if (is_hidden(*code)) {
      out += fmt::format("\\u{{{:04X}}}", static_cast<unsigned>(*code));
    } else {
      out += before.substr(0, before.size() - rest.size());
    }
  }
  return out;
}

}  // namespace mapproof
