#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mapproof {

/// A date with or without a time of day, or a time of day alone, in seconds since 1970-01-01 UTC
/// (since midnight). Empty if the cell is none.
///
/// Dates: 2026-11-03, 2026/11/03, 20261103, 03.11.2026, 03.11.26, 03-Nov-2026, 3 November 2026,
/// Nov 3, 2026, with a day of the week before it or not, and 11/13/2026 or 13/11/2026 where one
/// number is above 12. Times: 09:15, 09:15:00, 09:15:00.125, 09:15:00,125,
/// 091500, with AM or PM; a zone may follow: Z, UTC, +01:00, +0100. A time without a zone is taken
/// as UTC.
std::optional<double> date_in(std::string_view cell);

/// A number, or as date_in(). Empty if the cell is neither, or not finite.
std::optional<double> time_in(std::string_view cell);

/// Why time_in() refuses the cell.
std::string time_problem(std::string_view cell);

/// A unit of times that their sizes show.
struct TimeScale {
  double seconds = 1.0;         ///< Of one unit.
  const char* words = nullptr;  ///< "nanoseconds"; null: seconds.
};

/// Nanoseconds, microseconds or milliseconds since 1970; days as spreadsheets count them, where at
/// least five values between the years 1970 and 2100 are whole milliseconds; else seconds.
/// @param times  Finite.
TimeScale time_scale(std::span<const double> times);

}  // namespace mapproof
