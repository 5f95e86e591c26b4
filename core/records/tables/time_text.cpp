#include "core/records/tables/time_text.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "core/base/text/ascii.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

constexpr std::array<std::string_view, 12> kMonths = {
    "january", "february", "march",     "april",   "may",      "june",
    "july",    "august",   "september", "october", "november", "december"};
constexpr std::array<std::string_view, 7> kDays = {"monday", "tuesday",  "wednesday", "thursday",
                                                   "friday", "saturday", "sunday"};

/// Reads a date from its start to its end.
class DateCursor {
 public:
  explicit DateCursor(std::string_view text) : text_(text) {}

  std::optional<double> read() {
    double seconds = 0.0;
    const bool has_day_of_week = skip_day_of_week();
    const bool is_time_alone = text_.size() > 2 && (text_[1] == ':' || text_[2] == ':');
    if (is_time_alone && has_day_of_week) return std::nullopt;
    if (!is_time_alone) {
      const std::optional<double> days = date();
      if (!days) return std::nullopt;
      seconds = *days * 86400.0;
      if (text_.empty()) return seconds;
      const bool has_comma = take(',');
      if (!take(' ') && (has_comma || (!take('T') && !take('t')))) return std::nullopt;
      while (take(' ')) {
      }
    }
    const std::optional<double> of_day = time_of_day();
    const std::optional<double> zone = of_day ? offset() : std::nullopt;
    if (!zone || !text_.empty()) return std::nullopt;
    return seconds + *of_day - *zone;
  }

  /// Whether it is a date with a day and a month that may be either.
  static bool is_ambiguous(int a, int b) { return a <= 12 && b <= 12 && a != b; }

 private:
  bool take(char c) {
    if (text_.empty() || text_.front() != c) return false;
    text_.remove_prefix(1);
    return true;
  }

  std::size_t digits() const {
    return static_cast<std::size_t>(std::ranges::find_if_not(text_, is_digit) - text_.begin());
  }

  /// A number of `least` to `most` digits; -1 if there is none such.
  int number(std::size_t least, std::size_t most) {
    const std::size_t count = std::min(digits(), most);
    if (count < least) return -1;
    int value = 0;
    for (std::size_t i = 0; i < count; ++i) value = 10 * value + (text_[i] - '0');
    text_.remove_prefix(count);
    return value;
  }

  /// The number, from 0 on, of the name that begins the text, in full or by three letters or more;
  /// -1 if there is none.
  template <std::size_t kCount>
  int by_name(const std::array<std::string_view, kCount>& names) {
    const std::string word = lower_case(text_.substr(
        0, static_cast<std::size_t>(std::ranges::find_if_not(text_, is_letter) - text_.begin())));
    const auto* found = std::ranges::find_if(
        names, [&](std::string_view name) { return word.size() >= 3 && name.starts_with(word); });
    if (found == names.end()) return -1;
    text_.remove_prefix(word.size());
    return static_cast<int>(found - names.begin());
  }

  int month_by_name() {
    const int month = by_name(kMonths);
    return month < 0 ? -1 : month + 1;
  }

  /// @return Whether there was one.
  bool skip_day_of_week() {
    if (text_.empty() || !is_letter(text_.front()) || by_name(kDays) < 0) return false;
    take('.');
    take(',');
    while (take(' ')) {
    }
    return true;
  }

  /// Nov 3, 2026.
  std::optional<double> date_by_month() {
    const int month = month_by_name();
    take('.');
    if (!take(' ')) return std::nullopt;
    const int day = number(1, 2);
    take(',');
    if (!take(' ') || digits() != 4) return std::nullopt;
    return days_of(number(4, 4), month, day);
  }

  static std::optional<double> days_of(int year, int month, int day) {
    if (year < 0 || month < 0 || day < 0) return std::nullopt;
    const std::chrono::year_month_day date{std::chrono::year(year),
                                           std::chrono::month(static_cast<unsigned>(month)),
                                           std::chrono::day(static_cast<unsigned>(day))};
    if (!date.ok()) return std::nullopt;
    return static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
  }

  std::optional<double> date() {
    if (!text_.empty() && is_letter(text_.front())) return date_by_month();
    const std::size_t count = digits();
    if (count == 8) {
      const int year = number(4, 4), month = number(2, 2);
      return days_of(year, month, number(2, 2));
    }
    if (count != 4 && count != 1 && count != 2) return std::nullopt;
    const int first = number(1, 4);
    const char separator = text_.empty() ? '\0' : text_.front();
    if (std::string_view("-/. ").find(separator) == std::string_view::npos || !take(separator))
      return std::nullopt;
    const bool is_named = !text_.empty() && !is_digit(text_.front());
    if (separator == ' ' && !is_named) return std::nullopt;
    const int second = is_named ? month_by_name() : number(1, 2);
    if (is_named && separator == ' ') take('.');
    if (!take(separator)) return std::nullopt;
    if (count == 4) return days_of(first, second, number(1, 2));
    // With points the day comes first, even with a year of two digits: 03.11.26.
    const bool has_century = digits() == 4;
    if (!has_century && !(separator == '.' && count == 2 && digits() == 2)) return std::nullopt;
    const int year = has_century ? number(4, 4) : 2000 + number(2, 2);
    if (separator == '.' || is_named || first > 12 || first == second)
      return days_of(year, second, first);
    if (second > 12) return days_of(year, first, second);
    return std::nullopt;  // Day and month may be either.
  }

  std::optional<double> time_of_day() {
    const bool is_compact = digits() == 6 || digits() == 4;
    const int hour = number(1, 2);
    if (!is_compact && !take(':')) return std::nullopt;
    const int minute = number(2, 2);
    double second = 0.0;
    if (is_compact ? digits() == 2 : take(':')) {
      const int whole = number(2, 2);
      if (whole < 0) return std::nullopt;
      second = whole;
      if (take('.') || take(',')) second += fraction();
    }
    int hour_of_day = hour;
    while (take(' ')) {
    }
    const std::string half = lower_case(text_.substr(0, 2));
    if (half == "am" || half == "pm") {
      if (hour < 1 || hour > 12) return std::nullopt;
      hour_of_day = hour % 12 + (half == "pm" ? 12 : 0);
      text_.remove_prefix(2);
    }
    if (hour_of_day < 0 || hour_of_day > 24 || minute < 0 || minute > 59 || !(second < 61.0))
      return std::nullopt;
    return hour_of_day * 3600.0 + minute * 60.0 + second;
  }

  /// Digits behind a decimal point.
  double fraction() {
    double value = 0.0, digit = 0.1;
    for (; !text_.empty() && is_digit(text_.front()); text_.remove_prefix(1), digit *= 0.1)
      value += (text_.front() - '0') * digit;
    return value;
  }

  /// The zone behind a time, in seconds east; 0 without one.
  std::optional<double> offset() {
    while (take(' ')) {
    }
    if (text_.empty() || text_ == "UTC" || text_ == "GMT" || text_ == "Z" || text_ == "z") {
      text_ = {};
      return 0.0;
    }
    const double sign = text_.front() == '-' ? -1.0 : 1.0;
    if (!take('+') && !take('-')) return std::nullopt;
    const int hours = number(2, 2);
    take(':');
    const int minutes = text_.empty() ? 0 : number(2, 2);
    if (hours < 0 || hours > 15 || minutes < 0 || minutes > 59) return std::nullopt;
    return sign * (hours * 3600.0 + minutes * 60.0);
  }

  std::string_view text_;
};

/// Whether numbers are days since 1899-12-30, as spreadsheets store times.
bool are_spreadsheet_days(std::span<const double> times) {
  constexpr double kIn1970 = 25'569.0, kIn2100 = 73'051.0, kMilliseconds = 86'400'000.0;
  constexpr std::size_t kLeast = 5, kMost = 200;
  if (times.size() < kLeast) return false;
  bool has_fraction = false;
  for (const double time : times.first(std::min(times.size(), kMost))) {
    const double milliseconds = time * kMilliseconds;
    if (!(time >= kIn1970 && time <= kIn2100) ||
        std::abs(milliseconds - std::round(milliseconds)) > 0.1)
      return false;
    has_fraction = has_fraction || time != std::floor(time * 1000.0) / 1000.0;
  }
  return has_fraction;
}

}  // namespace

std::optional<double> date_in(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() < 4 || cell.size() > 64 || (!is_digit(cell.front()) && !is_letter(cell.front())))
    return std::nullopt;
  return DateCursor(cell).read();
}

std::optional<double> time_in(std::string_view cell) {
  if (const std::optional<double> number = number_in(cell))
    return std::isfinite(*number) ? number : std::nullopt;
  return date_in(cell);
}

std::string time_problem(std::string_view cell) {
  if (number_in(cell)) return number_problem(cell);
  const auto slashes = std::ranges::count_if(cell, [](char c) { return c == '/' || c == '-'; });
  if (slashes == 2 && !cell.empty() && is_digit(cell.front()) &&
      cell.find_first_not_of("0123456789/-:., apmAPM") == std::string_view::npos)
    return in_quotes(cell) +
           " is not a time, or its day and month may be either: write dates as 2026-11-03 (in a "
           "spreadsheet the cell format YYYY-MM-DD; in Python pandas.to_datetime(table[\"time\"], "
           "format=\"%m/%d/%Y %H:%M\"))";
  std::string problem = number_problem(cell);
  if (problem != in_quotes(cell) + " is not a number") return problem;
  return in_quotes(cell) + " is not a time: neither a number nor a date such as " +
         "2026-11-03 09:15:00.125";
}

TimeScale time_scale(std::span<const double> times) {
  if (times.empty()) return {};
  const auto [least, most] = std::ranges::minmax(times);
  const auto lies_in = [&](double low, double high) { return least >= low && most < high; };
  // The years 1973 to 2128 in each unit; seconds of that size lie beyond any clock.
  if (lies_in(1e17, 5e18)) return {1e-9, "nanoseconds"};
  if (lies_in(1e14, 5e15)) return {1e-6, "microseconds"};
  if (lies_in(1e11, 5e12)) return {1e-3, "milliseconds"};
  if (are_spreadsheet_days(times)) return {86'400.0, "a spreadsheet's days"};
  return {};
}

}  // namespace mapproof
