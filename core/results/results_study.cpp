#include "core/results/results_study.hpp"

#include <algorithm>
#include <set>

namespace mapproof {
namespace {

/// @return The first label whose id no row has; empty if there is none.
std::string complete(std::vector<Label>& labels, const std::set<std::string>& in_rows) {
  for (const Label& label : labels)
    if (!in_rows.contains(label.id)) return label.id;
  for (const std::string& id : in_rows)
    if (std::ranges::find(labels, id, &Label::id) == labels.end()) labels.push_back({id, id});
  return "";
}

void complete_quantities(ResultsStudy& study, const std::set<std::string>& in_rows) {
  std::erase_if(study.quantities, [&](const std::string& id) { return !in_rows.contains(id); });
  for (const Quantity& quantity : study.results.quantities.all())
    if (in_rows.contains(quantity.id) &&
        std::ranges::find(study.quantities, quantity.id) == study.quantities.end())
      study.quantities.push_back(quantity.id);
}

}  // namespace

std::string complete(ResultsStudy& study) {
  std::set<std::string> quantities, setups, methods, factors;
  for (const Result& row : study.results.rows) {
    quantities.insert(row.quantity);
    setups.insert(row.at.setup);
    methods.insert(row.method);
    for (const Level& level : row.at.levels) factors.insert(level.factor);
  }
  complete_quantities(study, quantities);
  if (const std::string id = complete(study.setups, setups); !id.empty()) return "setups: " + id;
  if (const std::string id = complete(study.methods, methods); !id.empty()) return "methods: " + id;
  if (const std::string id = complete(study.factors, factors); !id.empty()) return "factors: " + id;
  return "";
}

std::string label_of(const std::vector<Label>& labels, const std::string& id) {
  const auto found = std::ranges::find(labels, id, &Label::id);
  return found == labels.end() ? id : found->label;
}

}  // namespace mapproof
