#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "app/map/arguments.hpp"
#include "app/option_pairs.hpp"
#include "core/model/method.hpp"

namespace mapproof {

using MapOption = ListedOption<MapJob>;

/// Which options of `mapproof map` go together. In the reasons {method}, {missing} and {sensor}
/// stand for their values, {has} for what the method has for a parameter.
const OptionTable<MapJob>& map_option_table();

/// States in the help of --incremental which options it does not go with.
void complete_help(CLI::App& app);

/// The sentence by which the table refuses a job; empty if all that is asked for goes together.
std::string refusal(const MapJob& job);

/// The one place that refuses pairs of options. @throws InvalidInput with refusal().
void require_compatible(const MapJob& job);

/// The option that the method's parameter was given by, and its value.
struct GivenParameter {
  std::string_view option;
  double value;
};

/// None: the usual value is taken.
std::optional<GivenParameter> given_parameter(const MapJob& job);

/// The method of one sensor's observations, isomap if none was named; none for auto and pairs, and
/// for names that are not known.
std::optional<Method> method_of(const MapJob& job);

/// @throws InvalidInput for a name that is not known, with the nearest one.
void require_known_method(const MapJob& job);

}  // namespace mapproof
