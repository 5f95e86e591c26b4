#include "reports/diff/records/numbers_in_text.hpp"

#include <cstdlib>

#include "core/base/text/ascii.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kMinus = "\u2212";  // As tables print it.

/// The number of bytes of the sign at `at`, 0 if there is none.
std::size_t sign_at(std::string_view text, std::size_t at) {
  if (text.substr(at).starts_with(kMinus)) return kMinus.size();
  return at < text.size() && (text[at] == '-' || text[at] == '+') ? 1 : 0;
}

std::size_t digits_end(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// The end of the number that begins at `at`; `at` if none does.
std::size_t number_end(std::string_view text, std::size_t at) {
  const bool inside_word = at > 0 && (is_letter(text[at - 1]) || is_digit(text[at - 1]));
  std::size_t end = at + (inside_word ? 0 : sign_at(text, at));
  const std::size_t whole = digits_end(text, end);
  if (whole == end) return at;
  end = whole;
  if (end + 1 < text.size() && text[end] == '.' && is_digit(text[end + 1]))
    end = digits_end(text, end + 1);
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    const std::size_t power = end + 1 + sign_at(text, end + 1);
    if (digits_end(text, power) > power) end = digits_end(text, power);
  }
  return end;
}

double parsed_number(std::string_view text) {
  std::string plain(text);
  if (text.starts_with(kMinus)) plain.replace(0, kMinus.size(), "-");
  return std::strtod(plain.c_str(), nullptr);
}

std::vector<std::string_view> number_texts(std::string_view text) {
  std::vector<std::string_view> numbers;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = number_end(text, at);
    if (end > at) numbers.push_back(text.substr(at, end - at));
    at = end > at ? end : at + 1;
  }
  return numbers;
}

/// Whether a number has more decimals than anybody reads.
bool is_long(std::string_view number) {
  constexpr std::size_t kReadable = 8;  // Characters.
  return number.size() > kReadable && number.find('.') != std::string_view::npos;
}

}  // namespace

std::string without_numbers(std::string_view text) {
  std::string words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = number_end(text, at);
    words += end > at ? '#' : text[at];
    at = end > at ? end : at + 1;
  }
  return words;
}

std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  for (const std::string_view number : number_texts(text)) numbers.push_back(parsed_number(number));
  return numbers;
}

std::pair<std::string, std::string> readable_numbers(std::string_view a, std::string_view b) {
  const std::vector<std::string_view> first = number_texts(a), second = number_texts(b);
  const bool are_pairs = first.size() == second.size();
  const auto shown = [&](std::string_view text, bool is_first) {
    std::string out;
    std::size_t at = 0;
    const std::vector<std::string_view>& own = is_first ? first : second;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const std::string_view before = are_pairs ? first[i] : own[i];
      const std::string_view after = are_pairs ? second[i] : own[i];
      if (!is_long(before) && !is_long(after)) continue;
      const auto begin = static_cast<std::size_t>(own[i].data() - text.data());
      const auto numbers = changed_numbers(parsed_number(before), parsed_number(after));
      out += text.substr(at, begin - at);
      out += is_first ? numbers.first : numbers.second;
      at = begin + own[i].size();
    }
    return out += text.substr(at);
  };
  return {shown(a, true), shown(b, false)};
}

bool same_numbers(std::string_view a, std::string_view b) { return numbers_in(a) == numbers_in(b); }

TextChange text_change(std::string_view a, std::string_view b, const Tolerance& tolerance) {
  if (a == b) return TextChange::kNone;
  if (without_numbers(a) != without_numbers(b)) return TextChange::kWords;
  const std::vector<double> first = numbers_in(a), second = numbers_in(b);
  if (first.size() != second.size()) return TextChange::kWords;  // "##" is "#" and "#" as well.
  for (std::size_t i = 0; i < first.size(); ++i)
    if (!tolerance.holds(first[i], second[i])) return TextChange::kNumbers;
  return TextChange::kWithin;
}

}  // namespace mapproof
