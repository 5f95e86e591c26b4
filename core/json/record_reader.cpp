#include "core/json/record_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text/spelling.hpp"
#include "core/json/text_input.hpp"

namespace mapproof::record_json {
namespace {

constexpr std::size_t kMostNamesShown = 5;

void check_number(const JsonCursor& json, double number, const FieldRule& rule) {
  if (rule.above_minimum && number == rule.minimum)
    json.fail(fmt::format("expected a number above {}, got {}", rule.minimum, number));
}

std::string spaced(std::string_view type) {
  std::string words(type);
  std::ranges::replace(words, '_', ' ');
  return words;
}

[[noreturn]] void refuse_name(const JsonCursor& json, const std::string& text,
                              std::span<const std::string_view> known) {
  json.fail(fmt::format("expected {} or {}, got {}", fmt::join(known.first(known.size() - 1), ", "),
                        known.back(), in_quotes(text)));
}

}  // namespace

std::optional<JsonCursor> Reader::find(std::string_view key, const FieldRule& rule) const {
  if (rule.when && is_required(rule)) return json_.at(key);
  const auto found = json_.find(key);
  if (found && !rule.when) json_.fail("unknown key \"" + std::string(key) + '"');
  return found;
}

double read_number(const JsonCursor& json, const FieldRule& rule) {
  if (rule.integer)
    return static_cast<double>(read_integer(json, rule, std::numeric_limits<std::int64_t>::min(),
                                            std::numeric_limits<std::int64_t>::max()));
  if (rule.nullable && json.is_null()) return rule.null_is;
  const double number = json.number(rule.minimum, rule.maximum);
  check_number(json, number, rule);
  return number;
}

std::vector<double> read_numbers(const JsonCursor& json, const FieldRule& rule,
                                 std::optional<std::size_t> size) {
  std::vector<double> numbers;
  if (rule.integer)
    for (const JsonCursor& item : read_items(json, rule))
      numbers.push_back(read_number(item, rule));
  else
    numbers = json.numbers_or_null(rule.minimum, rule.maximum, size);
  if (numbers.size() < rule.min_items || numbers.size() > rule.max_items) read_items(json, rule);
  const auto is_refused = [&](double number) {
    return (std::isnan(number) && !rule.nullable) || (rule.above_minimum && number == rule.minimum);
  };
  if (const auto bad = std::ranges::find_if(numbers, is_refused); bad != numbers.end())
    read_number(json.element(static_cast<std::size_t>(bad - numbers.begin())), rule);  // Throws.
  return numbers;
}

std::string read_text(const JsonCursor& json, const FieldRule& rule) {
  std::string text = json.text(rule.max_bytes);
  if (rule.not_empty && text.empty()) json.fail("is empty");
  if (rule.form != nullptr && !rule.form->holds(text))
    json.fail(fmt::format("expected {}, got {}", rule.form->expected, in_quotes(text)));
  return text;
}

std::size_t read_name(const JsonCursor& json, const EnumNames& names) {
  const std::string text = json.text();
  const auto found = std::ranges::find(names.names, text);
  if (found != names.names.end()) return static_cast<std::size_t>(found - names.names.begin());
  if (names.names.size() <= kMostNamesShown) refuse_name(json, text, names.names);
  json.fail(fmt::format("unknown {} {}: did you mean \"{}\"?", spaced(names.type), in_quotes(text),
                        nearest_word(text, names.names)));
}

JsonItems read_items(const JsonCursor& json, const FieldRule& rule) {
  return json.elements(rule.min_items, rule.max_items);
}

std::int64_t read_integer(const JsonCursor& json, const FieldRule& rule, std::int64_t least,
                          std::int64_t most) {
  if (rule.minimum > static_cast<double>(least)) least = static_cast<std::int64_t>(rule.minimum);
  if (rule.maximum < static_cast<double>(most)) most = static_cast<std::int64_t>(rule.maximum);
  return json.integer(least, most);
}

JsonCursor location_of(const JsonCursor& json, std::string_view pointer) {
  const std::string key(pointer.substr(0, pointer.find('/')));
  const auto found = json.is_object() ? json.find(key) : json.element(std::stoul(key));
  if (!found || key.size() == pointer.size()) return found.value_or(json);
  return location_of(*found, pointer.substr(key.size() + 1));
}

void refuse_order(const JsonCursor& json, double number, double before) {
  json.fail(fmt::format("expected values in ascending order, got {} after {}", number, before));
}

void refuse_tag(const JsonCursor& tag, const std::vector<std::string_view>& known) {
  const std::string text = tag.text();
  if (known.size() <= kMostNamesShown) refuse_name(tag, text, known);
  const std::string_view meant = likely_word(text, known);
  const std::string key = tag.pointer().substr(tag.pointer().rfind('/') + 1);
  tag.fail(fmt::format("the {} {} is unknown{}", key, in_quotes(text),
                       meant.empty() ? "" : fmt::format(": did you mean \"{}\"?", meant)));
}

}  // namespace mapproof::record_json
