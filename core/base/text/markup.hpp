#pragma once

#include <string_view>

namespace mapproof {

/// The reference that stands for a character with a meaning of its own in XML and HTML, in texts
/// and in attributes between double quotes; empty: the character stands for itself.
constexpr std::string_view markup_reference(char c) {
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    default:
      return {};
  }
}

}  // namespace mapproof
