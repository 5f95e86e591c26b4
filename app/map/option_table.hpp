#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/map/arguments.hpp"
#include "core/model/method.hpp"

namespace mapproof {

/// An option of `mapproof map`, an option with certain values, or a condition on the job.
struct MapOption {
  std::string_view name;  ///< As messages name it: "--ellipses", "--method auto".
  bool (*is_asked)(const MapJob& job);
  /// Words of a command line that ask for it; empty: it is only a condition.
  std::vector<std::string> example = {};
};

/// Two options that do not go together, or, in the table of needs, an option that has a use only
/// with the other.
struct OptionPair {
  std::string_view option, other;
  /// {method}, {missing}, {sensor}: their values; {has}: what the method has for a parameter.
  std::string_view why;
};

std::span<const MapOption> map_option_list();

/// "--ellipses: not with --incremental: they need hundreds ...".
std::span<const OptionPair> options_apart();

/// "--overlap: it is the overlap of sub-maps; ...".
std::span<const OptionPair> options_needed();

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
