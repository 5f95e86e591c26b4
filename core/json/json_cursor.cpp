#include "core/json/json_cursor.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/retired_names.hpp"
#include "core/base/text/spelling.hpp"
#include "core/json/json_text_scan.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

using json_text_scan::decoded;
using json_text_scan::skip_blanks;
using json_text_scan::skip_plain;

constexpr int kVersion = 1;

/// A key as one part of a JSON pointer (RFC 6901), fit for an error's line.
std::string pointer_part(std::string_view key) {
  std::string part = "/";
  for (const char c : key.substr(0, 200)) {
    if (c == '~')
      part += "~0";
    else if (c == '/')
      part += "~1";
    else
      part += c;
  }
  return printable(part, 60);
}

std::string bounds(double least, double most) {
  if (most == kInfinity) return least == 0.0 ? ", 0 or more" : "";
  return fmt::format(" from {} to {}", least, most);
}

/// A number without a point and an exponent that fits into the type.
template <typename Integer>
std::optional<Integer> integer_in(std::string_view token) {
  Integer value = 0;
  const char* end = token.data() + token.size();
  const auto [stop, error] = std::from_chars(token.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

/// A checked number: finite.
double number_of(std::string_view token) {
  double value = 0.0;
  const auto error = std::from_chars(token.data(), token.data() + token.size(), value).ec;
  if (error == std::errc::result_out_of_range) return token.starts_with('-') ? -0.0 : 0.0;
  return token == "-0" ? 0.0 : value;  // An integer has no sign of zero.
}

/// The key that a person means who gives the value another unit or the thing another name; empty if
/// there is none.
std::string_view otherwise_called(std::string_view key, const std::vector<std::string_view>& keys) {
  constexpr std::pair<std::string_view, std::string_view> kOthers[] = {
      {"steps", "checkpoints"}, {"step", "checkpoints"},   {"runs", "layouts"},
      {"worlds", "layouts"},    {"trajectories", "poses"}, {"starts", "poses"}};
  const auto is_key = [&](std::string_view word) {
    return std::ranges::find(keys, word) != keys.end();
  };
  const auto without_unit = [](std::string_view word) {
    constexpr std::string_view kUnits[] = {"deg", "rad", "m",  "cm",     "mm",
                                           "km",  "s",   "ms", "percent"};
    const std::size_t at = word.rfind('_');
    const bool has_unit = at != std::string_view::npos &&
                          std::ranges::find(kUnits, word.substr(at + 1)) != std::end(kUnits);
    return has_unit ? word.substr(0, at) : word;
  };
  for (const std::string_view candidate : keys)
    if (without_unit(candidate) == without_unit(key)) return candidate;
  for (const auto& [other, ours] : kOthers)
    if (key == other && is_key(ours)) return ours;
  return {};
}

/// ": "step_m" is a key of "walk""; empty if no object within has such a key.
std::string nested_hint(std::string_view key, const JsonCursor::NestedKeys& nested) {
  std::vector<std::string_view> keys;
  for (const auto& [object, inner] : nested) keys.push_back(inner);
  const auto same = std::ranges::find(keys, key);
  std::string_view meant = same == keys.end() ? otherwise_called(key, keys) : *same;
  if (meant.empty()) meant = likely_word(key, keys);
  if (meant.empty()) return "";
  const std::string_view object =
      nested[static_cast<std::size_t>(std::ranges::find(keys, meant) - keys.begin())].first;
  return meant == key ? fmt::format(": it is a key of \"{}\"", object)
                      : fmt::format(": did you mean \"{}\", a key of \"{}\"?", meant, object);
}

}  // namespace

JsonCursor JsonDocument::cursor() const {
  return {*this, skip_blanks(text_, 0), nodes_.empty() ? JsonNode::kNone : 0};
}

nlohmann::json JsonDocument::tree() const {
  if (text_.size() > kLargestJsonTree)
    throw IoError(source, fmt::format("holds {} bytes of JSON; at most {} are read as a table, "
                                      "compared or merged",
                                      text_.size(), kLargestJsonTree));
  if (values_ > kMostJsonTreeValues)
    throw IoError(source,
                  fmt::format("holds {} values of JSON; at most {} are read as a table, compared or "
                              "merged",
                              values_, kMostJsonTreeValues));
  return nlohmann::json::parse(text_);
}

const std::string& JsonCursor::source() const { return document_->source; }

std::string JsonCursor::pointer() const {
  if (node_ == JsonNode::kNone) return "";
  const JsonNode& own = document_->nodes_[node_];
  const std::uint32_t holder = own.begin == offset_ ? own.parent : node_;
  if (holder == JsonNode::kNone) return "";
  const JsonNode& node = document_->nodes_[holder];
  const JsonCursor outer(*document_, node.begin, holder);
  const JsonItems items(*document_, holder, node.count);
  std::size_t index = 0;
  for (auto item = items.begin(); item != items.end(); ++item, ++index)
    if ((*item).offset_ == offset_)
      return outer.pointer() +
             pointer_part(outer.is_object() ? item.key() : fmt::format("{}", index));
  return outer.pointer();
}

JsonKind JsonCursor::kind() const {
  switch (document_->text_[offset_]) {
    case '{':
      return JsonKind::kObject;
    case '[':
      return JsonKind::kArray;
    case '"':
      return JsonKind::kString;
    case 'n':
      return JsonKind::kNull;
    case 't':
    case 'f':
      return JsonKind::kBoolean;
    default:
      return JsonKind::kNumber;
  }
}

std::string_view JsonCursor::token() const {
  const std::string_view text = document_->text_;
  return text.substr(offset_, skip_plain(text, offset_) - offset_);
}

void JsonCursor::fail(const std::string& what) const {
  const std::string at = pointer();
  throw IoError(source(), at.empty() ? "/" : at, what);
}

std::string JsonCursor::got() const {
  switch (kind()) {
    case JsonKind::kObject:
      return "an object";
    case JsonKind::kArray:
      return "an array";
    case JsonKind::kString:
      return in_quotes(decoded(token()));
    case JsonKind::kNumber:
      if (const auto value = integer_in<std::uint64_t>(token())) return fmt::format("{}", *value);
      if (const auto value = integer_in<std::int64_t>(token())) return fmt::format("{}", *value);
      return fmt::format("{}", number_of(token()));
    default:
      return std::string(token());
  }
}

JsonCursor JsonCursor::at(std::string_view key) const {
  const std::optional<JsonCursor> found = find(key);
  if (!found) fail("lacks the key " + in_quotes(key));
  return *found;
}

JsonItems JsonCursor::entries() const {
  if (!is_object()) fail("expected an object, got " + got());
  return {*document_, node_, size()};
}

std::optional<JsonCursor> JsonCursor::find(std::string_view key) const {
  const JsonItems all = entries();
  for (auto item = all.begin(); item != all.end(); ++item)
    if (item.has_key(key)) return *item;
  return std::nullopt;
}

std::vector<std::pair<std::string, JsonCursor>> JsonCursor::members() const {
  std::vector<std::pair<std::string, JsonCursor>> all;
  const JsonItems items = entries();
  for (auto item = items.begin(); item != items.end(); ++item) all.emplace_back(item.key(), *item);
  std::ranges::sort(all, {}, [](const auto& member) -> const std::string& { return member.first; });
  return all;
}

void JsonCursor::allow_only(std::initializer_list<std::string_view> keys) const {
  allow_only(std::vector<std::string_view>(keys));
}

void JsonCursor::allow_only(const std::vector<std::string_view>& keys) const {
  allow_only(keys, [] { return NestedKeys(); });
}

void JsonCursor::allow_only(const std::vector<std::string_view>& keys,
                            const std::function<NestedKeys()>& nested) const {
  const JsonItems items = entries();
  for (auto item = items.begin(); item != items.end(); ++item) {
    if (std::ranges::any_of(keys, [&](std::string_view key) { return item.has_key(key); }))
      continue;
    const std::string key = item.key();
    if (const std::string_view now = replacement_of(NameKind::kKey, key, keys); !now.empty())
      fail(fmt::format("{}: this key is now called \"{}\"", in_quotes(key), now));
    const std::string_view other = otherwise_called(key, keys);
    const std::string_view meant = other.empty() ? likely_word(key, keys) : other;
    fail("unknown key " + in_quotes(key) +
         (meant.empty() ? nested_hint(key, nested())
                        : fmt::format(": did you mean \"{}\"?", meant)) +
         (!meant.empty() && key.ends_with("_deg") ? " Angles are in radians" : ""));
  }
}

JsonItems JsonCursor::elements(std::size_t least, std::size_t most) const {
  if (!is_array()) fail("expected an array, got " + got());
  if (size() < least) fail(fmt::format("expected at least {} elements, got {}", least, size()));
  if (size() > most) fail(fmt::format("expected at most {} elements, got {}", most, size()));
  return {*document_, node_, size()};
}

JsonCursor JsonCursor::element(std::size_t index) const {
  auto item = elements().begin();
  for (; index > 0; --index) ++item;
  return *item;
}

std::size_t JsonCursor::size() const {
  if (!is_array() && !is_object()) return is_null() ? 0 : 1;
  const JsonNode& node = document_->nodes_[node_];
  return node.begin == offset_ ? node.count : 0;  // An empty one has no node.
}

std::int64_t JsonCursor::integer(std::int64_t least, std::int64_t most) const {
  const auto refuse = [&] {
    fail(fmt::format("expected an integer from {} to {}, got {}", least, most, got()));
  };
  if (kind() != JsonKind::kNumber) refuse();
  std::int64_t integer = 0;
  if (const auto value = integer_in<std::int64_t>(token())) {
    integer = *value;
  } else {
    const double number = plain_number();  // 1e3 and 5.0 are integers in JSON's eyes.
    if (std::abs(number) > 0x1p53 || number != std::trunc(number)) refuse();
    integer = static_cast<std::int64_t>(number);
  }
  if (integer < least || integer > most) refuse();
  return integer;
}

std::uint64_t JsonCursor::unsigned_integer() const {
  const auto value =
      kind() == JsonKind::kNumber ? integer_in<std::uint64_t>(token()) : std::nullopt;
  if (!value) fail("expected an integer from 0 to 18446744073709551615, got " + got());
  return *value;
}

double JsonCursor::plain_number() const {
  return kind() == JsonKind::kNumber ? number_of(token()) : kNaN;
}

double JsonCursor::number(double least, double most) const {
  const double value = plain_number();
  if (!(value >= least && value <= most))
    fail("expected a number" + bounds(least, most) + ", got " + got());
  return value;
}

double JsonCursor::number_or_null(double least, double most) const {
  return is_null() ? kNaN : number(least, most);
}

bool JsonCursor::boolean() const {
  if (kind() != JsonKind::kBoolean) fail("expected true or false, got " + got());
  return document_->text_[offset_] == 't';
}

std::string JsonCursor::text(std::size_t most) const {
  if (kind() != JsonKind::kString) fail("expected a string, got " + got());
  std::string text = decoded(token());
  if (text.size() > most)
    fail(fmt::format("expected a string of at most {} bytes, got {}", most, text.size()));
  if (text.find('\0') != std::string::npos) fail("holds a NUL character");
  return text;
}

std::vector<double> JsonCursor::numbers_or_null(double least, double most,
                                                std::optional<std::size_t> size) const {
  const JsonItems items = elements();
  if (size && items.size() != *size)
    fail(fmt::format("expected {} elements, got {}", *size, items.size()));
  std::vector<double> numbers;
  numbers.reserve(items.size());
  for (const JsonCursor& item : items) numbers.push_back(item.number_or_null(least, most));
  return numbers;
}

JsonItems::Iterator::Iterator(const JsonDocument& document, std::uint32_t node, std::size_t left)
    : document_(&document), holder_(node), child_(document.nodes_[node].first), left_(left) {
  if (left_ == 0) return;
  offset_ = skip_blanks(document.text_, document.nodes_[node].begin + 1);
  enter_member();
}

void JsonItems::Iterator::enter_member() {
  const std::string_view text = document_->text_;
  if (text[document_->nodes_[holder_].begin] == '[') return;
  key_ = offset_;
  const std::uint32_t colon = skip_blanks(text, skip_plain(text, offset_));
  offset_ = skip_blanks(text, colon + 1);
}

JsonCursor JsonItems::Iterator::operator*() const {
  const bool is_container = child_ != JsonNode::kNone && document_->nodes_[child_].begin == offset_;
  return {*document_, offset_, is_container ? child_ : holder_};
}

JsonItems::Iterator& JsonItems::Iterator::operator++() {
  const std::string_view text = document_->text_;
  if (child_ != JsonNode::kNone && document_->nodes_[child_].begin == offset_) {
    offset_ = document_->nodes_[child_].end;
    child_ = document_->nodes_[child_].next;
  } else {
    offset_ = skip_plain(text, offset_);
  }
  if (--left_ == 0) return *this;
  offset_ = skip_blanks(text, skip_blanks(text, offset_) + 1);  // Behind the comma.
  enter_member();
  return *this;
}

std::string JsonItems::Iterator::key() const {
  const std::string_view text = document_->text_;
  return decoded(text.substr(key_, skip_plain(text, key_) - key_));
}

bool JsonItems::Iterator::has_key(std::string_view key) const {
  const std::string_view text = document_->text_;
  const std::string_view quoted = text.substr(key_, skip_plain(text, key_) - key_);
  const std::string_view inner = quoted.substr(1, quoted.size() - 2);
  return inner.find('\\') == inner.npos ? inner == key : decoded(quoted) == key;
}

SchemaId schema_of(const JsonCursor& document) {
  if (!document.is_object() || !document.find("schema"))
    document.fail(
        "does not state its format: expected the key \"schema\" with the name and version of its "
        "format");
  const JsonCursor schema = document.at("schema");
  schema.allow_only({"name", "version"});
  return {schema.at("name").text(100), schema.at("version").integer32(1, 1'000'000)};
}

void expect_schema(const JsonCursor& document, std::string_view name) {
  const SchemaId found = schema_of(document);
  if (const std::string_view now = replacement_of(NameKind::kFormat, found.name); !now.empty())
    document.at("schema").at("name").fail(
        fmt::format("{}: this format is now called \"{}\"", in_quotes(found.name), now));
  if (found.name != name)
    document.at("schema").at("name").fail(
        fmt::format("expected \"{}\", got {}", name, in_quotes(found.name)));
  if (found.version != kVersion)
    document.at("schema").at("version").fail(
        fmt::format("version {} is not known to this program, which reads version {}",
                    found.version, kVersion));
}

nlohmann::ordered_json schema_value(std::string_view name) {
  return {{"name", name}, {"version", kVersion}};
}

}  // namespace mapproof
