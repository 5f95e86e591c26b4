#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/files/byte_source.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/points.hpp"
#include "core/model/sensor.hpp"
#include "core/records/observations/sources.hpp"

namespace mapproof {

/// Observations from CSV (wide or long) or mapproof's JSON. Of detections (see detections.hpp),
/// what one sensor observed.
///
/// Rows without any observation are kept: whether they are a problem is for the caller to decide.
///
/// @param kind  What the values are. Required for CSV; must agree with a JSON file.
/// @param format  Of CSV; a JSON file states what it holds. A table whose layout is in doubt (see
///                table_shape.hpp) is refused with the option that states it.
/// @throws IoError naming file and location if the source cannot be read as such, breaks the bounds
/// of
///         its kind (0 or 1; |rad| <= 2 pi; 0 <= m <= 1e6), repeats a name or a (step, landmark),
///         or exceeds 5000 landmarks, 1e6 steps or 2e8 entries.
/// @note Linear in the size of the file; about 0.2 s for 50 x 100,000 entries.
ObservationSource read_observations(ByteSource& source, std::optional<Sensor> kind,
                                    const TableFormat& format = {});

/// The same of a file or stream, or of a folder of MRCLAM [leung2011], then of visibility if `kind`
/// is empty.
ObservationSource read_observations(const std::filesystem::path& path, std::optional<Sensor> kind,
                                    const TableFormat& format = {});

/// Whether the source, which stays unread, is a table of landmarks times steps, as read_grid()
/// takes it. @throws IoError as respell().
bool is_grid_table(ByteSource& source, const TableFormat& format = {});

/// The long form of a table; `text` is from checked_text().
ObservationSource read_long(std::string_view text, const std::string& source, Sensor sensor,
                            const TableFormat& format = {});

/// Whether the table's first row names the columns landmark and value, as a long one does.
bool has_long_header(std::string_view text, const std::string& source,
                     const ColumnNames& names = {});

/// Whether a table without a header starts with a step, a landmark's name that is not a number, and
/// a value: a row that no wide table holds.
bool starts_as_long(std::string_view text, const std::string& source);

}  // namespace mapproof
