#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/json/json_document.hpp"

namespace mapproof {

/// An experiment's document of that schema, without its key "profiles".
/// @param profile  The profile whose merge patch (RFC 7396) is applied; "" for none.
/// @throws IoError with the location if it is none, lacks that profile, or has a profile that is not
///         a patch.
JsonDocument parse_with_profile(std::string_view text, const std::string& source,
                                std::string_view schema, const std::string& profile);

/// The names of a document's profiles, sorted. @throws IoError as above.
std::vector<std::string> profile_names(std::string_view text, const std::string& source,
                                       std::string_view schema);

}  // namespace mapproof
