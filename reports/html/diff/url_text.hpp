#pragma once

#include <string>
#include <string_view>

namespace mapproof {

/// `text` byte by byte as it may stand in a fragment, an id or an attribute: letters, digits and
/// "-._/" as they are, every other byte as %XX. Two texts never become one.
std::string url_text(std::string_view text);

}  // namespace mapproof
