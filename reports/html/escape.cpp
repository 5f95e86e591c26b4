#include "reports/html/escape.hpp"

#include <string_view>

#include <fmt/format.h>

namespace mapproof {

std::string file_link(const std::string& path) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_./";
  std::string link = "./";  // Never taken for a scheme or a host.
  for (const char c : path)
    link += kPlain.find(c) != std::string_view::npos
                ? std::string(1, c)
                : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return link;
}

}  // namespace mapproof
