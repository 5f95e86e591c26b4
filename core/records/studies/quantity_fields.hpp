#pragma once

#include <string_view>
#include <vector>

#include "core/json/fields.hpp"
#include "core/results/quantity.hpp"

namespace mapproof {

// The fields of a quantity as a study names it (core/json/fields.hpp).

inline EnumNames enum_names(Better) { return names_up_to(Better::kNeither, "better"); }

inline constexpr TextForm kQuantityId = {"^[a-z][a-z0-9_]*$", is_quantity_id,
                                         "lower-case letters, digits and '_', a letter first"};

/// The ids of the dictionary.
inline const std::vector<std::string_view>& known_quantity_ids() {
  static const std::vector<std::string_view> ids = [] {
    std::vector<std::string_view> all;
    for (const Quantity& quantity : all_quantities()) all.push_back(quantity.id);
    return all;
  }();
  return ids;
}

template <typename Visitor>
void fields(Visitor& v, Quantity& quantity) {
  v.field("id", quantity.id,
          {.description = "One of mapproof's dictionary needs no label and no direction.",
           .max_bytes = 100,
           .form = &kQuantityId,
           .decides = true,
           .known = known_quantity_ids()});
  const Quantity* known = find_quantity(quantity.id);
  if constexpr (Visitor::kReads)
    if (known != nullptr) quantity = *known;
  const Key key = known == nullptr ? Key::kRequired : Key::kOptional;
  v.field("label", quantity.label, {.max_bytes = 200, .key = key});
  v.field("unit", quantity.unit, {.max_bytes = 100, .key = Key::kOptional});
  v.field("better", quantity.better, {.key = key});
  if constexpr (Visitor::kReads) {
    if (const std::string problem = problem_of(quantity); !problem.empty()) v.refuse("id", problem);
    quantity = study_quantity(quantity.id, quantity.label, quantity.unit, quantity.better);
  }
}

}  // namespace mapproof
