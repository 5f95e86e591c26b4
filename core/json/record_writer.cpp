#include "core/json/record_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

namespace mapproof {
namespace record_json {
namespace {

constexpr double kExact = 0x1p53;

bool is_whole(double number) {
  return std::abs(number) < kExact && number == std::trunc(number) &&
         !(number == 0.0 && std::signbit(number));
}

}  // namespace

Json number_json(double number, const FieldRule& rule) {
  if (!std::isfinite(number)) return nullptr;
  if ((rule.whole_as_integers || rule.integer) && is_whole(number))
    return static_cast<std::int64_t>(number);
  return number;
}

}  // namespace record_json
namespace {

bool is_plain(const nlohmann::ordered_json& value) {
  return !value.is_structured() ||
         (value.is_array() &&
          std::ranges::none_of(value, [](const auto& item) { return item.is_structured(); }));
}

void flatten(const nlohmann::ordered_json& value, const std::string& pointer,
             std::vector<std::pair<std::string, std::string>>& out) {
  if (is_plain(value)) {
    out.emplace_back(pointer,
                     value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      flatten(value[i], fmt::format("{}/{}", pointer, i), out);
  } else {
    for (const auto& [key, item] : value.items())
      flatten(item, fmt::format("{}/{}", pointer, key), out);
  }
}

}  // namespace

std::vector<std::pair<std::string, std::string>> flattened(const nlohmann::ordered_json& value) {
  std::vector<std::pair<std::string, std::string>> values;
  flatten(value, "", values);
  return values;
}

}  // namespace mapproof
