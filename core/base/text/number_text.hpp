#pragma once

#include <string>
#include <string_view>

namespace mapproof {

/// "10⁶".
std::string ten_to_the(int exponent);

/// "×10⁶".
std::string power_of_ten(int exponent);

/// A whole number as prose has it: "9658", from five digits on in groups of three, "25,700".
std::string count_text(long long count);

/// The same beside others of up to `greatest`, of which all have groups or none has: "1,204" beside
/// "25,700".
std::string count_text(long long count, long long greatest);

/// A number that labels a column, a panel or a sentence, with up to six significant digits:
/// "0.001", "1000", "25,700"; of less than 0.001 as a power of ten, "10⁻⁴", "2.5×10⁻⁴".
std::string level_number_text(double value);

/// `value` with `decimals` digits behind the point, U+2212 for minus, no minus before zero.
std::string number_text(double value, int decimals);

/// The same beside numbers of up to `greatest`: its thousands are apart as those of count_text().
std::string number_text(double value, int decimals, double greatest);

/// `value` with so many significant digits, zeros at their end among them: "0.0120". Never in
/// scientific notation from 1e-6 to 1e6. Tiles, sentences, titles and the console have numbers from
/// here, so that one number has the same digits everywhere.
std::string significant(double value, int digits = 3);

/// `value` with so many decimals, beside numbers of up to `greatest`. A value that is not 0 but
/// would show zeros alone is "≈ 0"; with six decimals or more, which a quantity of small values
/// has, it has significant digits.
std::string rounded_text(double value, int decimals, double greatest, int digits = 3);

/// A value of a quantity, "0.0120 m", "88.6 %", "2.06°", with a no-break space. A whole number
/// without a unit is a count: "20". A length that rounding leaves is "≈ 0 m".
std::string quantity_text(double value, std::string_view unit);

/// An error with its unit, "0.123 m"; of a map that diverged "over 1 km" (see kGreatestError_m),
/// and "≈ 0 m" of what rounding leaves.
std::string error_text(double error_m);

/// The length of a path with its unit: "86.0 m", "1.86 km".
std::string length_text(double length_m);

/// A time with its unit: "310 µs", "2.10 ms", "12.0 s".
std::string seconds_text(double seconds);

/// A number for a data attribute: six significant digits, or twelve where three of these six would
/// be rounded from a half; "." for the point.
std::string data_number(double value);

}  // namespace mapproof
