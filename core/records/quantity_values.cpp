#include "core/records/quantity_values.hpp"

#include <string>

namespace mapproof {

nlohmann::ordered_json quantity_value(const Quantity& quantity) {
  return {{"id", quantity.id},
          {"label", quantity.label},
          {"unit", quantity.unit},
          {"better", name(quantity.better)}};
}

Quantity read_quantity(const JsonCursor& value) {
  value.allow_only({"id", "label", "unit", "better"});
  const JsonCursor id = value.at("id");
  Quantity quantity{.id = id.text(100)};
  if (const Quantity* known = find_quantity(quantity.id)) quantity = *known;
  const bool is_known = !quantity.label.empty();
  if (const auto label = value.find("label"); label || !is_known)
    quantity.label = value.at("label").text(200);
  if (const auto unit = value.find("unit")) quantity.unit = unit->text(100);
  if (const auto better = value.find("better"); better || !is_known) {
    const auto named = better_named(value.at("better").text());
    if (!named) value.at("better").fail("expected lower, higher or neither");
    quantity.better = *named;
  }
  if (const std::string problem = problem_of(quantity); !problem.empty()) id.fail(problem);
  return study_quantity(quantity.id, quantity.label, quantity.unit, quantity.better);
}

}  // namespace mapproof
