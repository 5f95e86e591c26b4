#pragma once

#include <string>

namespace mapproof {

/// `text` as it may stand between tags and in quoted attributes: characters that HTML reads as its
/// own become references; bytes that are no UTF-8 and control characters become visible ones.
std::string html_escaped(const std::string& text);

/// A path from the page as the target of a link: never of another scheme or host.
std::string file_link(const std::string& path);

}  // namespace mapproof
