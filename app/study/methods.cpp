#include "app/commands.hpp"

#include <fmt/format.h>

#include "core/model/method.hpp"

namespace mapproof {
namespace {

nlohmann::ordered_json parameter_json(const MethodInfo& method) {
  if (!method.parameter) return nullptr;
  const ParameterInfo& parameter = *method.parameter;
  return {{"symbol", parameter.symbol},
          {"shown", parameter.shown},
          {"meaning", parameter.meaning},
          {"integer", parameter.integer},
          {"minimum", parameter.minimum},
          {"maximum", parameter.maximum},
          {"below_number_of_landmarks", parameter.counts_neighbours}};
}

int methods(const Invocation& invocation) {
  nlohmann::ordered_json object{{"methods", nlohmann::ordered_json::array()}};
  std::string text;
  for (const MethodInfo& method : all_methods()) {
    object["methods"].push_back({{"name", method.name},
                                 {"label", method.label},
                                 {"summary", method.summary},
                                 {"source", method.source},
                                 {"parameter", parameter_json(method)}});
    text += fmt::format("{}\n  {}: {}\n", method.name, method.label, method.summary);
    if (method.parameter)
      text += fmt::format("  parameter {}: {}, {:g} to {:g}{}\n", method.parameter->shown,
                          method.parameter->meaning, method.parameter->minimum,
                          method.parameter->maximum,
                          on_graph(method.method) ? ", below the number of landmarks" : "");
    text += fmt::format("  source: {}\n", method.source);
  }
  invocation.console.result(text, object);
  return kDone;
}

}  // namespace

Action methods_command(CLI::App& app) {
  app.description("List the mapping methods, their parameters, ranges and sources");
  app.footer("Example:\n  mapproof methods --json\n");
  return methods;
}

}  // namespace mapproof
