#include "core/json/json_document.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/json_text_scan.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::json;
using json_text_scan::decoded;
using json_text_scan::skip_blanks;
using json_text_scan::skip_plain;

constexpr std::size_t kDepth = 64;

/// Forwards the text byte by byte and counts, so that each event and each stop has an offset.
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

/// Indexes the containers while nlohmann-json's parser reads, and stops at what it would let pass:
/// repeated keys and endless nesting. `problem` then holds the problem, without a location.
class Indexer : public nlohmann::json_sax<Json> {
 public:
  Indexer(std::string_view text, std::deque<JsonNode>& nodes)
      : seen(text.data()), text_(text), nodes_(nodes) {}

  const char* seen;  ///< Behind the last byte that the parser took.
  std::string problem;
  std::optional<std::size_t> offset;  ///< Of the problem, if it is known better.
  std::size_t values = 0;             ///< Containers included.

  bool null() override { return put(); }
  bool boolean(bool) override { return put(); }
  bool number_integer(std::int64_t) override { return put(); }
  bool number_unsigned(std::uint64_t) override { return put(); }
  bool number_float(double, const std::string&) override { return put(); }
  bool string(std::string&) override { return put(); }
  bool key(std::string&) override { return true; }
  bool binary(Json::binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(); }
  bool start_array(std::size_t) override { return open(); }
  bool end_object() override {
    if (!check_keys(nodes_[open_.back().node])) return false;
    return close();
  }
  bool end_array() override { return close(); }

  bool parse_error(std::size_t position, const std::string& token,
                   const nlohmann::detail::exception& error) override {
    const bool at_end = position > text_.size() || token == "<U+0000>";
    offset = std::min(position == 0 ? 0 : position - 1, text_.size());
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
  /// A container that is not closed yet, the last container in it, and that before it in its parent.
  struct Open {
    std::uint32_t node;
    std::uint32_t last = JsonNode::kNone;
    std::uint32_t before = JsonNode::kNone;
  };

  /// "invalid literal" out of "[json...] parse error at line 1, column 2: syntax error while
  /// parsing value - invalid literal; last read: 'x'; expected ..."
  static std::string reason(std::string_view what) {
    const std::size_t start = what.find(" - ");
    if (start == std::string_view::npos) return "not JSON";
    what.remove_prefix(start + 3);
    return "not JSON: " + std::string(what.substr(0, what.find("; last read: ")));
  }

  std::uint32_t position() const { return static_cast<std::uint32_t>(seen - text_.data()); }

  bool put() {
    ++values;
    if (!open_.empty()) ++nodes_[open_.back().node].count;
    return true;
  }

  bool open() {
    if (open_.size() == kDepth) {
      problem = fmt::format("nested deeper than {} levels", kDepth);
      return false;
    }
    put();
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    JsonNode node{.begin = position() - 1};
    Open opened{.node = index};
    if (!open_.empty()) {
      Open& outer = open_.back();
      node.parent = outer.node;
      opened.before = outer.last;
      next_of(outer, outer.last) = index;
      outer.last = index;
    }
    nodes_.push_back(node);
    open_.push_back(opened);
    return true;
  }

  /// An empty container needs no node, but for the root.
  bool close() {
    const Open closed = open_.back();
    open_.pop_back();
    nodes_[closed.node].end = position();
    if (open_.empty() || nodes_[closed.node].count > 0) return true;
    nodes_.pop_back();
    Open& outer = open_.back();
    outer.last = closed.before;
    next_of(outer, outer.last) = JsonNode::kNone;
    return true;
  }

  /// What names the container behind `last` in its parent: the parent itself if there is none yet.
  std::uint32_t& next_of(const Open& outer, std::uint32_t last) {
    return last == JsonNode::kNone ? nodes_[outer.node].first : nodes_[last].next;
  }

  /// A key as it stands between its quotes, and the offset of the first quote.
  struct Key {
    std::string_view name;
    std::uint32_t begin;
  };

  /// The keys of an object, in their order.
  std::vector<Key> keys_of(const JsonNode& object) const {
    std::vector<Key> keys;
    keys.reserve(object.count);
    std::uint32_t at = object.begin + 1, child = object.first;
    for (std::uint32_t i = 0; i < object.count; ++i) {
      at = skip_blanks(text_, at);
      const std::uint32_t end = skip_plain(text_, at);
      keys.push_back({text_.substr(at + 1, end - at - 2), at});
      at = skip_blanks(text_, skip_blanks(text_, end) + 1);  // Behind the colon.
      if (child != JsonNode::kNone && nodes_[child].begin == at) {
        at = nodes_[child].end;
        child = nodes_[child].next;
      } else {
        at = skip_plain(text_, at);
      }
      at = skip_blanks(text_, at) + 1;  // Behind the comma.
    }
    return keys;
  }

  /// False if a key is there twice.
  bool check_keys(const JsonNode& object) {
    if (object.count < 2) return true;
    std::deque<std::string> decoded_keys;  // Two keys may differ in their escapes alone.
    std::vector<Key> keys = keys_of(object);
    for (Key& key : keys)
      if (key.name.find('\\') != key.name.npos)
        key.name = decoded_keys.emplace_back(decoded(text_.substr(key.begin, key.name.size() + 2)));
    std::ranges::sort(keys, [](const Key& a, const Key& b) {
      return std::tie(a.name, a.begin) < std::tie(b.name, b.begin);
    });
    const Key* repeated = nullptr;
    for (std::size_t i = 1; i < keys.size(); ++i)
      if (keys[i].name == keys[i - 1].name &&
          (repeated == nullptr || keys[i].begin < repeated->begin))
        repeated = &keys[i];
    if (repeated == nullptr) return true;
    problem = "the key " + in_quotes(repeated->name) + " is there twice";
    offset = skip_plain(text_, repeated->begin) - 1;
    return false;
  }

  std::string_view text_;
  std::deque<JsonNode>& nodes_;
  std::vector<Open> open_;
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

}  // namespace

JsonDocument parse_json(std::string_view text, const std::string& source) {
  text = checked_text(text, source);
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw IoError(source, "is empty");
  if (text.size() >= JsonNode::kNone) throw IoError(source, "is larger than 4 GiB");
  JsonDocument document;
  document.source = source;
  document.text_ = text;
  Indexer indexer(text, document.nodes_);
  const bool good =
      Json::sax_parse(CountingIterator(text.data(), &indexer.seen),
                      CountingIterator(text.data() + text.size(), &indexer.seen), &indexer);
  document.values_ = indexer.values;
  if (good) return document;
  const auto stopped = static_cast<std::size_t>(indexer.seen - text.data());
  const std::size_t offset = indexer.offset.value_or(stopped == 0 ? 0 : stopped - 1);
  throw IoError(source, location_of(text, offset), indexer.problem);
}

std::string schema_name_in(std::string_view text) {
  SchemaFinder finder;
  Json::sax_parse(text, &finder);
  return finder.name;
}

}  // namespace mapproof
