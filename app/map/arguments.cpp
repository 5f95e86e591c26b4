#include "app/map/arguments.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"

namespace mapproof {
namespace {

/// The option that the parameter was given by, and its value; none: the usual value is taken.
struct GivenParameter {
  std::string_view option;
  double value;
};

/// An option for the parameter of a name, as that of the other methods: "--sigma2".
struct ParameterOption {
  std::string_view symbol;
  std::string_view option;
  std::optional<double> MapArguments::*value;
};

constexpr ParameterOption kParameterOptions[] = {{"K", "-K", &MapArguments::neighbours},
                                                 {"sigma2", "--sigma2", &MapArguments::variance},
                                                 {"d", "--degree", &MapArguments::degree}};

/// @throws InvalidInput for an option of another method's parameter.
std::optional<GivenParameter> given_parameter(const MapArguments& arguments,
                                              const MethodInfo& method) {
  std::optional<GivenParameter> given;
  if (arguments.parameter) given = {"--parameter", *arguments.parameter};
  std::string_view usual;
  for (const ParameterOption& option : kParameterOptions)
    if (method.parameter && method.parameter->symbol == option.symbol) usual = option.option;
  for (const ParameterOption& option : kParameterOptions) {
    const std::optional<double>& value = arguments.*option.value;
    if (!value) continue;
    if (method.parameter && option.option != usual)
      throw InvalidInput(fmt::format("{}: the method {} has the parameter {}; did you mean {}?",
                                     option.option, method.name, method.parameter->shown, usual));
    given = {option.option, *value};
  }
  if (given && !method.parameter)
    throw InvalidInput(fmt::format("{}: the method {} has none", given->option, method.name));
  return given;
}

/// The way that range and bearing are mapped has no parameter and no use for other kinds.
void require_pairs(const MapArguments& arguments) {
  const bool of_both = arguments.input.kind == kRangeBearing;
  if (of_both && !arguments.method.empty() && arguments.method != kPairs)
    throw InvalidInput(
        fmt::format("--method {}: range and bearing together are mapped by pairs; for others say "
                    "--sensor range, "
                    "bearing or visibility",
                    printable(arguments.method)));
  if (!of_both && arguments.method == kPairs)
    throw InvalidInput("--method pairs: it maps observations of --sensor range-bearing");
  if (of_both &&
      (arguments.parameter || arguments.neighbours || arguments.variance || arguments.degree))
    throw InvalidInput("the method pairs has no parameter");
  if (of_both && arguments.options.missing.way != MissingChoice().way)
    throw InvalidInput("--missing: pairs that were not measured are not filled in");
  if (of_both && arguments.options.submaps > 0)
    throw InvalidInput("--submaps: a map of pairs is made as a whole");
  if (arguments.options.overlap && arguments.options.submaps == 0)
    throw InvalidInput("--overlap: it is of sub-maps; add --submaps SIZE");
  if (!of_both && arguments.input.rigid)
    throw InvalidInput("--fit rigid: only a map of range and bearing has a scale of its own");
}

/// Fills in the other sensors' files. @throws InvalidInput for what does not go with them.
void take_others(MapArguments& arguments) {
  if (arguments.with.size() != arguments.with_kind.size())
    throw InvalidInput("--with: each file needs a --with-sensor of its own");
  for (std::size_t k = 0; k < arguments.with.size(); ++k)
    arguments.input.others.push_back({arguments.with[k], arguments.with_kind[k]});
  if (!arguments.input.unsure.empty() &&
      (arguments.follow || !arguments.with.empty() || arguments.input.kind == kRangeBearing))
    throw InvalidInput(
        "--uncertain-ids: of one kind of value that every landmark has at every step; not with "
        "--follow, --with or range-bearing (see --check-ids)");
  if (arguments.with.empty()) return;
  const MapOptions& options = arguments.options;
  if (arguments.input.kind == kRangeBearing)
    throw InvalidInput(
        "--with: range and bearing together are mapped by pairs; name one of them by --sensor");
  if (options.choose || options.submaps > 0 || options.ellipse_replicates > 0 ||
      options.missing.way != MissingChoice().way || arguments.follow ||
      arguments.input.labels.asked())
    throw InvalidInput(
        "--with: not with --method auto, --submaps, --ellipses, --missing, --follow or labels that "
        "are checked");
}

/// The method, and its parameter if one was given.
MethodSetting chosen_setting(const MapArguments& arguments) {
  if (arguments.options.submaps > 0 &&
      (arguments.options.choose || arguments.options.ellipse_replicates > 0))
    throw InvalidInput("--submaps: not with --method auto or --ellipses");
  if (arguments.options.choose) {
    if (arguments.parameter || arguments.neighbours || arguments.variance || arguments.degree)
      throw InvalidInput("--method auto chooses the parameter, too; leave it out");
    return {Method::kIsomap, std::nullopt};
  }
  const std::string name = arguments.method.empty() ? "isomap" : lower_case(arguments.method);
  const std::optional<Method> method = method_named(name);
  if (!method)
    throw InvalidInput(fmt::format("--method: unknown method \"{}\"; did you mean \"{}\"?",
                                   printable(arguments.method),
                                   nearest_method_name(arguments.method)));
  const std::optional<GivenParameter> given = given_parameter(arguments, info(*method));
  if (!given) return {*method, std::nullopt};
  const ParameterInfo& parameter = *info(*method).parameter;
  if (!(given->value >= parameter.minimum && given->value <= parameter.maximum) ||
      (parameter.integer && given->value != std::floor(given->value)))
    throw InvalidInput(fmt::format(
        "{}: {} = {:g} is not {} from {:g} to {:g}", given->option, parameter.shown, given->value,
        parameter.integer ? "an integer" : "a number", parameter.minimum, parameter.maximum));
  return {*method, given->value};
}

}  // namespace

void settle(MapArguments& arguments) {
  MapInput& input = arguments.input;
  input.layout = arguments.layout == "wide"   ? Layout::kWide
                 : arguments.layout == "long" ? Layout::kLong
                                              : Layout::kAuto;
  input.unit = arguments.degrees ? AngleUnit::kDegrees : AngleUnit::kRadians;
  input.rigid = arguments.fit == "rigid";
  if (input.kind.empty() && arguments.method == kPairs) input.kind = kRangeBearing;
  arguments.options.choose = lower_case(arguments.method) == "auto";
  // What grows cannot be looked into first.
  if (!arguments.follow) open_observations(input);
  take_others(arguments);
  require_pairs(arguments);
  if (input.kind != kRangeBearing) arguments.options.setting = chosen_setting(arguments);
  arguments.options.fit =
      arguments.fit == "least-squares" ? AffineFit::kLeastSquares : AffineFit::kLeastDistances;
}

}  // namespace mapproof
