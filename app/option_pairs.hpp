#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof {

/// An option of a command, an option with certain values, or a condition on its arguments.
template <typename Arguments>
struct ListedOption {
  std::string_view name;  ///< As messages name it: "--ellipses", "--method auto".
  bool (*is_asked)(const Arguments& arguments);
  /// Words of a command line that ask for it; empty: it is only a condition.
  std::vector<std::string> example = {};
};

/// Two options that do not go together, or, in the table of needs, an option that has a use only
/// with the other.
struct OptionPair {
  std::string_view option, other;
  std::string_view why;
};

/// Which options of a command go together. It refers to lists that live as long as the program.
template <typename Arguments>
struct OptionTable {
  std::span<const ListedOption<Arguments>> options;
  std::span<const OptionPair> apart;
  std::span<const OptionPair> needed;

  /// The sentence by which the table refuses the arguments, "--ellipses: not with --incremental:
  /// they need hundreds ...", or "--overlap: it is the overlap of sub-maps; ..."; empty if all that
  /// is asked for goes together.
  /// @param reason  The words of a pair's `why`.
  std::string refusal(const Arguments& arguments,
                      const std::function<std::string(const OptionPair&)>& reason) const {
    const auto is_asked = [&](std::string_view name) {
      return std::ranges::find(options, name, &ListedOption<Arguments>::name)->is_asked(arguments);
    };
    for (const OptionPair& pair : apart)
      if (is_asked(pair.option) && is_asked(pair.other))
        return std::string(pair.option) + ": not with " + std::string(pair.other) + ": " +
               reason(pair);
    for (const OptionPair& pair : needed)
      if (is_asked(pair.option) && !is_asked(pair.other))
        return std::string(pair.option) + ": " + reason(pair);
    return "";
  }

  /// "Not with --with, --ellipses or --missing": the options that are refused with this one.
  std::string not_with(std::string_view option) const {
    std::string text;
    for (auto pair = apart.rbegin(); pair != apart.rend(); ++pair)
      if (pair->other == option) {
        const char* separator = text.empty() ? "" : text.find(" or ") == text.npos ? " or " : ", ";
        text.insert(0, separator).insert(0, pair->option);
      }
    return "Not with " + text;
  }
};

}  // namespace mapproof
