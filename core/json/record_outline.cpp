#include "core/json/record_outline.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mapproof::record_json {

void Outline::check(const JsonCursor& json,
                    const std::function<JsonCursor::NestedKeys()>& nested) const {
  json.allow_only(keys, nested);
  if (json.size() < least_keys)
    json.fail(fmt::format("expected at least {} of {}, got {}", least_keys, fmt::join(keys, ", "),
                          json.size()));
  if (json.size() > most_keys)
    json.fail(fmt::format("expected at most {} of {}, got {}", most_keys, fmt::join(keys, ", "),
                          json.size()));
}

FieldRule item_rule(const FieldRule& rule) {
  if (rule.items != nullptr) return *rule.items;
  FieldRule item = rule;
  item.description = {};
  item.min_items = 0;
  item.max_items = std::numeric_limits<std::size_t>::max();
  item.unique = item.ascending = false;
  item.key = Key::kRequired;
  return item;
}

}  // namespace mapproof::record_json
