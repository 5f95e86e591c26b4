#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/files/byte_source.hpp"
#include "core/model/points.hpp"
#include "core/records/observations/sources.hpp"

namespace mapproof {

/// Reads CSV (name, x, y; header optional) or MRCLAM's Landmark_Groundground_truth.dat.
/// @throws IoError naming file and line.
NamedPoints read_landmarks(ByteSource& source);
NamedPoints read_landmarks(const std::filesystem::path& path);

/// The same from the text of a file, which is from checked_text().
NamedPoints parse_landmarks(std::string_view text, const std::string& source);

/// Whether a table of unknown kind is one of landmarks: MRCLAM's, or its header names x and y; or,
/// without a header, all its rows are a name of their own and two numbers.
bool is_landmarks_table(std::string_view text, const std::string& source);

/// Landmark_Groundground_truth.dat: subject, x, y, and their standard deviations, which are left
/// out.
NamedPoints parse_groundtruth(std::string_view text, const std::string& source);

}  // namespace mapproof
