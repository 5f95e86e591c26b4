#pragma once

#include <string>

namespace mapproof {

/// Escapes a text for content between tags and for quoted attributes: special characters of HTML
/// become references; bytes that are not UTF-8 and control characters become visible characters.
std::string html_escaped(const std::string& text);

/// A path relative to the page as the target of a link: never with another scheme or host.
std::string file_link(const std::string& path);

}  // namespace mapproof
