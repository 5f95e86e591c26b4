#include "core/json/json_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace mapproof {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t kColumns = 100;
constexpr std::size_t kUnlimited = std::numeric_limits<std::size_t>::max();

void append_number(std::string& out, double value) {
  if (!std::isfinite(value)) {
    out += "null";
  } else if (value == 0.0) {
    out += std::signbit(value) ? "-0.0" : "0";  // "-0" would be read back as an integer.
  } else {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    out.append(digits.data(), end);
  }
}

void append_string(std::string& out, const std::string& text) {
  out += OrderedJson(text).dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

void append_plain(std::string& out, const OrderedJson& value) {
  if (value.is_number_float()) {
    append_number(out, value.get<double>());
  } else if (value.is_string()) {
    append_string(out, value.get_ref<const std::string&>());
  } else {
    out += value.dump();
  }
}

/// Appends on one line; false, with `out` in disorder, if it grows beyond `limit` bytes.
bool append_inline(std::string& out, const OrderedJson& value, std::size_t limit) {
  if (!value.is_structured()) {
    append_plain(out, value);
    return out.size() <= limit;
  }
  out += value.is_object() ? '{' : '[';
  bool first = true;
  for (auto item = value.begin(); item != value.end(); ++item) {
    if (!first) out += ", ";
    first = false;
    if (value.is_object()) {
      append_string(out, item.key());
      out += ": ";
    }
    if (!append_inline(out, *item, limit)) return false;
  }
  out += value.is_object() ? '}' : ']';
  return out.size() <= limit;
}

bool is_row(const OrderedJson& value) {
  return value.is_array() &&
         std::ranges::none_of(value, [](const OrderedJson& item) { return item.is_structured(); });
}

/// `column`: where the value starts on its line.
void append(std::string& out, const OrderedJson& value, std::size_t indent, std::size_t column) {
  if (!value.is_structured()) return append_plain(out, value);
  const std::size_t start = out.size();
  const std::size_t room =
      is_row(value) ? kUnlimited : start + kColumns - std::min(column, kColumns);
  if (indent > 0 && append_inline(out, value, room)) return;
  out.resize(start);

  const std::string inner(indent + 2, ' ');
  out += value.is_object() ? "{" : "[";
  for (auto item = value.begin(); item != value.end(); ++item) {
    out += item == value.begin() ? "\n" : ",\n";
    const std::size_t line = out.size();
    out += inner;
    if (value.is_object()) {
      append_string(out, item.key());
      out += ": ";
    }
    append(out, *item, indent + 2, out.size() - line + 1);  // One more for the comma behind it.
  }
  if (!value.empty()) out += '\n' + std::string(indent, ' ');
  out += value.is_object() ? '}' : ']';
}

}  // namespace

std::string json_text(const OrderedJson& value) {
  std::string out;
  append(out, value, 0, 0);
  return out + '\n';
}

std::string json_element(const OrderedJson& value, std::size_t indent) {
  std::string out;
  append(out, value, indent, indent + 1);
  return out;
}

std::string json_line(const OrderedJson& value) {
  std::string out;
  append_inline(out, value, kUnlimited);
  return out + '\n';
}

}  // namespace mapproof
