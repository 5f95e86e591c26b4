#include "core/json/json_cursor.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/retired_names.hpp"
#include "core/base/text/spelling.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::json;

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

constexpr std::size_t kDepth = 64;

/// Builds the value while nlohmann-json's parser reads, and stops at what it would let pass:
/// repeated keys and endless nesting. `problem` then holds the problem, without a location.
class Builder : public nlohmann::json_sax<Json> {
 public:
  explicit Builder(std::size_t size) : size_(size) {}

  Json root;
  std::string problem;
  std::optional<std::size_t> offset;  ///< Of the problem, if the parser gave it.
  std::string pointer;                ///< Of the problem, if it has one.

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(std::int64_t value) override { return put(value); }
  bool number_unsigned(std::uint64_t value) override { return put(value); }
  bool number_float(double value, const std::string&) override { return put(value); }
  bool string(std::string& value) override { return put(std::move(value)); }
  bool binary(Json::binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(std::string& name) override {
    const auto [member, is_new] = stack_.back()->get_ref<Json::object_t&>().emplace(name, nullptr);
    slot_ = &member->second;
    if (!is_new) problem = "the key " + in_quotes(name) + " is there twice";
    return is_new;
  }

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    const bool at_end = position > size_ || token == "<U+0000>";
    offset = std::min(position == 0 ? 0 : position - 1, size_);
    if (error.id == 406) {
      problem = "the number " + in_quotes(token) + " is beyond what a double holds";
    } else if (at_end || std::string_view(error.what()).find("unexpected end of input") !=
                             std::string::npos) {
      problem = "the file is truncated: it ends within a value";
    } else {
      problem = reason(error.what()) + ", near " + in_quotes(token);
    }
    return false;
  }

 private:
  /// "invalid literal" out of "[json...] parse error at line 1, column 2: syntax error while
  /// parsing value - invalid literal; last read: 'x'; expected ..."
  static std::string reason(std::string_view what) {
    const std::size_t start = what.find(" - ");
    if (start == std::string_view::npos) return "not JSON";
    what.remove_prefix(start + 3);
    return "not JSON: " + std::string(what.substr(0, what.find("; last read: ")));
  }

  template <typename Value>
  bool put(Value&& value) {
    location() = std::forward<Value>(value);
    return true;
  }

  bool open(Json&& empty) {
    if (stack_.size() == kDepth) {
      problem = fmt::format("nested deeper than {} levels", kDepth);
      return false;
    }
    Json& value = location();
    value = std::move(empty);
    stack_.push_back(&value);
    return true;
  }

  bool close() {
    stack_.pop_back();
    return true;
  }

  /// Where the next value goes. Only the innermost container grows, so outer pointers stay good.
  Json& location() {
    if (stack_.empty()) return root;
    if (stack_.back()->is_object()) return *slot_;
    return stack_.back()->get_ref<Json::array_t&>().emplace_back();
  }

  std::size_t size_;
  std::vector<Json*> stack_;
  Json* slot_ = nullptr;
};

/// Stops at the name of the schema.
class SchemaFinder : public nlohmann::json_sax<Json> {
 public:
  std::string name;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(std::int64_t) override { return true; }
  bool number_unsigned(std::uint64_t) override { return true; }
  bool number_float(double, const std::string&) override { return true; }
  bool binary(Json::binary_t&) override { return true; }
  bool string(std::string& value) override {
    if (depth_ != 2 || !is_schema_ || key_ != "name") return true;
    name = value;
    return false;
  }
  bool key(std::string& word) override {
    key_ = word;
    return true;
  }
  bool start_object(std::size_t) override { return enter(key_ == "schema"); }
  bool start_array(std::size_t) override { return enter(false); }
  bool end_object() override { return leave(); }
  bool end_array() override { return leave(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  bool enter(bool is_schema) {
    if (++depth_ == 2) is_schema_ = is_schema;
    return depth_ <= kDepth;
  }
  bool leave() {
    --depth_;
    return true;
  }

  std::size_t depth_ = 0;
  std::string key_;
  bool is_schema_ = false;  ///< The second level is the root's schema.
};

/// Forwards the text byte by byte and counts, so that a stop has a location.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, const char** seen) : at_(at), seen_(seen) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    *seen_ = ++at_;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** seen_;
};

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
    constexpr std::string_view kUnits[] = {"deg", "rad", "m", "cm", "mm", "km", "s", "ms", "percent"};
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

}  // namespace

JsonCursor::JsonCursor(const Json& value, const std::string& source, std::string pointer)
    : value_(&value), source_(&source), pointer_(std::move(pointer)) {}

void JsonCursor::fail(const std::string& what) const {
  throw IoError(*source_, pointer_.empty() ? "/" : pointer_, what);
}

std::string JsonCursor::got() const {
  switch (value_->type()) {
    case Json::value_t::object:
      return "an object";
    case Json::value_t::array:
      return "an array";
    case Json::value_t::string:
      return in_quotes(value_->get_ref<const std::string&>());
    case Json::value_t::number_float:
      return fmt::format("{}", value_->get<double>());
    default:
      return value_->dump();
  }
}

JsonCursor JsonCursor::child(const Json& value, std::string_view key) const {
  return {value, *source_, pointer_ + pointer_part(key)};
}

JsonCursor JsonCursor::at(const std::string& key) const {
  const std::optional<JsonCursor> found = find(key);
  if (!found) fail("lacks the key " + in_quotes(key));
  return *found;
}

std::optional<JsonCursor> JsonCursor::find(const std::string& key) const {
  if (!value_->is_object()) fail("expected an object, got " + got());
  const auto member = value_->find(key);
  if (member == value_->end()) return std::nullopt;
  return child(*member, key);
}

std::vector<std::pair<std::string, JsonCursor>> JsonCursor::members() const {
  if (!value_->is_object()) fail("expected an object, got " + got());
  std::vector<std::pair<std::string, JsonCursor>> all;
  for (const auto& [key, value] : value_->items()) all.emplace_back(key, child(value, key));
  return all;
}

void JsonCursor::allow_only(std::initializer_list<std::string_view> keys) const {
  allow_only(std::vector<std::string_view>(keys));
}

void JsonCursor::allow_only(const std::vector<std::string_view>& keys) const {
  for (const auto& [key, value] : members()) {
    if (std::ranges::find(keys, key) != keys.end()) continue;
    if (const std::string_view now = replacement_of(NameKind::kKey, key);
        std::ranges::find(keys, now) != keys.end())
      fail(fmt::format("{}: this key is now called \"{}\"", in_quotes(key), now));
    const std::string_view other = otherwise_called(key, keys);
    const std::string_view meant = other.empty() ? likely_word(key, keys) : other;
    fail("unknown key " + in_quotes(key) +
         (meant.empty() ? "" : fmt::format(": did you mean \"{}\"?", meant)) +
         (!meant.empty() && key.ends_with("_deg") ? " Angles are in radians" : ""));
  }
}

std::vector<JsonCursor> JsonCursor::elements(std::size_t least, std::size_t most) const {
  if (!value_->is_array()) fail("expected an array, got " + got());
  if (size() < least) fail(fmt::format("expected at least {} elements, got {}", least, size()));
  if (size() > most) fail(fmt::format("expected at most {} elements, got {}", most, size()));
  std::vector<JsonCursor> all;
  all.reserve(size());
  for (std::size_t i = 0; i < size(); ++i) all.push_back(element(i));
  return all;
}

JsonCursor JsonCursor::element(std::size_t index) const {
  return child((*value_)[index], fmt::format("{}", index));
}

std::int64_t JsonCursor::integer(std::int64_t least, std::int64_t most) const {
  const auto refuse = [&] {
    fail(fmt::format("expected an integer from {} to {}, got {}", least, most, got()));
  };
  std::int64_t integer = 0;
  if (value_->is_number_unsigned()) {
    const auto value = value_->get<std::uint64_t>();
    if (value > std::uint64_t{std::numeric_limits<std::int64_t>::max()}) refuse();
    integer = static_cast<std::int64_t>(value);
  } else if (value_->is_number_integer()) {
    integer = value_->get<std::int64_t>();
  } else if (value_->is_number_float()) {
    const double value = value_->get<double>();  // 1e3 and 5.0 are integers in JSON's eyes.
    if (std::abs(value) > 0x1p53 || value != std::trunc(value)) refuse();
    integer = static_cast<std::int64_t>(value);
  } else {
    refuse();
  }
  if (integer < least || integer > most) refuse();
  return integer;
}

std::uint64_t JsonCursor::unsigned_integer() const {
  if (!value_->is_number_unsigned())
    fail("expected an integer from 0 to 18446744073709551615, got " + got());
  return value_->get<std::uint64_t>();
}

double JsonCursor::number(double least, double most) const {
  const double value = value_->is_number() ? value_->get<double>() : kNaN;
  if (!(value >= least && value <= most))
    fail("expected a number" + bounds(least, most) + ", got " + got());
  return value;
}

double JsonCursor::number_or_null(double least, double most) const {
  return is_null() ? kNaN : number(least, most);
}

bool JsonCursor::boolean() const {
  if (!value_->is_boolean()) fail("expected true or false, got " + got());
  return value_->get<bool>();
}

std::string JsonCursor::text(std::size_t most) const {
  if (!value_->is_string()) fail("expected a string, got " + got());
  const auto& text = value_->get_ref<const std::string&>();
  if (text.size() > most)
    fail(fmt::format("expected a string of at most {} bytes, got {}", most, text.size()));
  if (text.find('\0') != std::string::npos) fail("holds a NUL character");
  return text;
}

std::vector<double> JsonCursor::numbers_or_null(double least, double most,
                                                std::optional<std::size_t> size) const {
  if (!value_->is_array()) fail("expected an array, got " + got());
  if (size && value_->size() != *size)
    fail(fmt::format("expected {} elements, got {}", *size, value_->size()));
  std::vector<double> numbers;
  numbers.reserve(value_->size());
  for (const Json& item : *value_) {
    double value = kNaN;
    if (item.is_number()) value = item.get<double>();
    if (!item.is_null() && !(value >= least && value <= most))
      element(numbers.size())
          .number_or_null(least, most);  // Throws, with the problem in its message.
    numbers.push_back(value);
  }
  return numbers;
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

JsonDocument parse_json(std::string_view text, const std::string& source) {
  text = checked_text(text, source);
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw IoError(source, "is empty");
  Builder builder(text.size());
  const char* seen = text.data();
  const bool good = Json::sax_parse(CountingIterator(text.data(), &seen),
                                    CountingIterator(text.data() + text.size(), &seen), &builder);
  if (good) return {source, std::move(builder.root)};
  const std::size_t stopped = static_cast<std::size_t>(seen - text.data());
  const std::size_t offset = builder.offset.value_or(stopped == 0 ? 0 : stopped - 1);
  throw IoError(source, location_of(text, offset), builder.problem);
}

std::string schema_name_in(std::string_view text) {
  SchemaFinder finder;
  Json::sax_parse(text, &finder);
  return finder.name;
}

}  // namespace mapproof
