#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/files/byte_source.hpp"
#include "core/model/points.hpp"
#include "core/records/observations/sources.hpp"

namespace mapproof {

/// Reads a table (name, x, y; header optional) in any form of respell(), or MRCLAM's
/// Landmark_Groundtruth.dat. Lengths are in metres, or in the unit of the header.
/// @param names  Columns that the user names; those that the table lacks do not count.
/// @throws IoError naming file and line.
NamedPoints read_landmarks(ByteSource& source, const ColumnNames& names = {});
NamedPoints read_landmarks(const std::filesystem::path& path, const ColumnNames& names = {});

/// The same from the text of a file, which is from checked_text().
NamedPoints parse_landmarks(std::string_view text, const std::string& source,
                            const ColumnNames& names = {});

/// Whether a table of unknown kind is one of landmarks: MRCLAM's, or its header names x and y, but
/// no times; or, without a header, all its rows are a name of their own and two numbers.
bool is_landmarks_table(std::string_view text, const std::string& source,
                        const ColumnNames& names = {});

/// Landmark_Groundground_truth.dat: subject, x, y, and their standard deviations, which are left
/// out.
NamedPoints parse_groundtruth(std::string_view text, const std::string& source);

}  // namespace mapproof
