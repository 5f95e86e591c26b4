#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kDepth = 64;

/// Builds the value while nlohmann-json's parser reads, and stops at what it would let pass:
/// repeated keys and endless nesting. `problem` then says what, without a place.
class Builder : public nlohmann::json_sax<Json> {
 public:
  explicit Builder(std::size_t size) : size_(size) {}

  Json root;
  std::string problem;
  std::optional<std::size_t> offset;  ///< Of the problem, if the parser told.
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
    place() = std::forward<Value>(value);
    return true;
  }

  bool open(Json&& empty) {
    if (stack_.size() == kDepth) {
      problem = fmt::format("nested deeper than {} levels", kDepth);
      return false;
    }
    Json& value = place();
    value = std::move(empty);
    stack_.push_back(&value);
    return true;
  }

  bool close() {
    stack_.pop_back();
    return true;
  }

  /// Where the next value goes. Only the innermost container grows, so outer pointers stay good.
  Json& place() {
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

/// Forwards the text byte by byte and counts, so that a stop has a place.
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

}  // namespace

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
  throw IoError(source, place_of(text, offset), builder.problem);
}

std::string schema_name_in(std::string_view text) {
  SchemaFinder finder;
  Json::sax_parse(text, &finder);
  return finder.name;
}

}  // namespace mapproof
