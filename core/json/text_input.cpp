#include "core/json/text_input.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/utf8.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

unsigned byte_at(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
}

/// Offset of the first byte that is not UTF-8; text.size() if there is none.
std::size_t first_bad_byte(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    std::uint64_t word = 0;
    if (at + sizeof word <= text.size()) {
      std::memcpy(&word, text.data() + at, sizeof word);
      if ((word & 0x8080808080808080U) == 0) {
        at += sizeof word;
        continue;
      }
    }
    std::string_view rest = text.substr(at);
    if (!take_code_point(rest)) return at;
    at = text.size() - rest.size();
  }
  return at;
}

}  // namespace

std::string_view checked_text(std::string_view text, const std::string& source,
                              std::size_t first_line) {
  if (first_line == 1) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
      throw IoError(source, "is UTF-16; save it as UTF-8");
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  }
  if (text.empty()) throw IoError(source, "is empty");
  const std::size_t nul = text.find('\0');
  if (nul != std::string_view::npos)
    throw IoError(source, line_of(text, nul, first_line), "holds a NUL byte: not a text file");
  const std::size_t bad = first_bad_byte(text);
  if (bad < text.size())
    throw IoError(source, line_of(text, bad, first_line),
                  fmt::format("byte 0x{:02X} is not UTF-8", byte_at(text, bad)));
  return text;
}

std::string line_of(std::string_view text, std::size_t offset, std::size_t first_line) {
  const std::string_view before = text.substr(0, offset);
  const auto ends = static_cast<std::size_t>(std::ranges::count(before, '\n'));
  return fmt::format("line {}", first_line + ends);
}

std::string location_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t last = before.rfind('\n');
  const std::size_t column =
      last == std::string_view::npos ? before.size() : before.size() - last - 1;
  return fmt::format("{}, column {}", line_of(text, offset), column + 1);
}

std::optional<double> number_in(std::string_view cell) {
  if (cell.size() > 1 && cell[0] == '+' && cell[1] != '-') cell.remove_prefix(1);
  double value = 0.0;
  const char* end = cell.data() + cell.size();
  const auto [stop, error] = std::from_chars(cell.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::string number_problem(std::string_view cell) {
  double value = 0.0;
  const char* end = cell.data() + cell.size();
  const auto result = std::from_chars(cell.data(), end, value);
  if (result.ec == std::errc::result_out_of_range)
    return in_quotes(cell) + " is beyond what a double holds";
  if (result.ec == std::errc() && result.ptr == end) return in_quotes(cell) + " is not finite";
  const bool has_comma = result.ec == std::errc() && result.ptr != end && *result.ptr == ',';
  return in_quotes(cell) + " is not a number" +
         (has_comma ? ": the decimal separator is a point" : "");
}

bool is_missing(std::string_view cell) {
  constexpr std::string_view kWords[] = {"na",   "n/a", "#n/a", "<na>", "#na", "null",
                                         "none", "nan", "-nan", "nat",  "-",   "--"};
  if (cell.empty()) return true;
  if (cell.size() > 4 || (cell[0] >= '0' && cell[0] <= '9')) return false;
  return std::ranges::find(kWords, lower_case(cell)) != std::end(kWords);
}

std::string in_quotes(std::string_view cell) {
  constexpr std::size_t kShown = 40;
  return '"' + printable(std::string(cell.substr(0, 4 * kShown + 4)), kShown) + '"';
}

}  // namespace mapproof
