#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace mapproof {

/// 0xRRGGBB of a colour's name in CSS, in lower case; empty if there is none.
std::optional<std::uint32_t> css_named_colour(std::string_view name);

}  // namespace mapproof
