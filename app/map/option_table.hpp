#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/map/arguments.hpp"
#include "core/model/method.hpp"

namespace mapproof {

/// An option of `mapproof map`, or an option with certain values: what the table below is about.
struct MapOption {
  std::string_view name;  ///< As refusals call it: "--ellipses", "--method auto".
  bool (*is_asked)(const MapJob& job);
  /// Words of a command line that ask for it; empty: it is a condition alone.
  std::vector<std::string> example = {};
};

/// Options that do not go together, or, in the table of needs, of which the first is of use with
/// the second alone.
struct OptionPair {
  std::string_view option, other;
  /// {method}, {missing}: their values; {has}: what the method has for a parameter.
  std::string_view why;
};

std::span<const MapOption> map_option_list();

/// "--ellipses: not with --follow: they come of hundreds ...".
std::span<const OptionPair> options_apart();

/// "--overlap: it is of sub-maps; ...".
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
