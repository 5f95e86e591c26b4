#include <algorithm>

#include <fmt/format.h>

#include "core/records/experiment_values.hpp"
#include "core/records/json_values.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

MethodGrid read_grid(const std::string& name, const JsonCursor& object) {
  MethodGrid grid{.method = read_method(name, object), .parameters = {}};
  const auto& parameter = info(grid.method).parameter;
  if (!parameter) {
    if (!object.members().empty()) object.fail(name + " has no parameter: expected {}");
    return grid;
  }
  object.allow_only({parameter->symbol});
  grid.parameters = read_ascending<double>(
      object.at(std::string(parameter->symbol)),
      [&](const JsonCursor& item) { return read_parameter(*parameter, item); });
  return grid;
}

}  // namespace

std::vector<MethodGrid> read_methods(const JsonCursor& object) {
  std::vector<MethodGrid> grids;
  for (const auto& [name, value] : object.members()) grids.push_back(read_grid(name, value));
  if (grids.empty()) object.fail("expected at least one method");
  std::ranges::sort(grids, {}, &MethodGrid::method);
  return grids;
}

Json methods_value(const std::vector<MethodGrid>& grids) {
  Json methods = Json::object();
  for (const MethodGrid& grid : grids) {
    const MethodInfo& method = info(grid.method);
    Json& entry = methods[std::string(method.name)] = Json::object();
    if (!method.parameter) continue;
    Json& values = entry[std::string(method.parameter->symbol)] = Json::array();
    for (const double value : grid.parameters) values.push_back(number_value(value));
  }
  return methods;
}

void check_grids(const std::vector<MethodGrid>& grids, int landmarks, const JsonCursor& methods) {
  for (const MethodGrid& grid : grids) {
    if (!on_graph(grid.method)) continue;
    const JsonCursor values = methods.at(std::string(info(grid.method).name)).at("K");
    for (std::size_t i = 0; i < grid.parameters.size(); ++i)
      if (grid.parameters[i] >= landmarks)
        values.element(i).fail(fmt::format("K must be below the number of landmarks, {}, got {}",
                                           landmarks, grid.parameters[i]));
  }
}

}  // namespace mapproof
