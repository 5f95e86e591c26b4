#pragma once

#include <string>
#include <string_view>

namespace mapproof {

/// What keeps bytes from being a whole PNG file: signature, chunk lengths, checksums, IHDR first
/// and IEND last. Empty if nothing does; the pixels are not decoded. Linear in the size.
std::string png_problem(std::string_view bytes);

}  // namespace mapproof
