#pragma once

#include <string>

namespace mapproof {

/// A path relative to the page as the target of a link: never with another scheme or host.
std::string file_link(const std::string& path);

}  // namespace mapproof
