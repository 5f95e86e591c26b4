#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mapproof {

/// The verdict on one item, in ascending order of weight. The verdict on a whole is the heaviest of
/// its parts.
enum class Verdict {
  kIdentical,        ///< The values are equal, exactly.
  kWithinTolerance,  ///< Values or pixels differ, all within their tolerances.
  kRenderer,         ///< Pixels differ, the figure's value is equal.
  kBetter,           ///< Data differ beyond tolerance, for the better.
  kNew,              ///< It exists only in the current.
  kStyle,            ///< Styles or texts differ, data do not.
  kChanged,          ///< It differs beyond tolerance, neither significantly better nor worse.
  kWorse,            ///< Data differ beyond tolerance, for the worse.
  kMissing,          ///< It exists only in the baseline.
  kUnreadable,       ///< One of the two cannot be read.
};

inline constexpr std::array kVerdicts = {
    Verdict::kIdentical, Verdict::kWithinTolerance, Verdict::kRenderer, Verdict::kBetter,
    Verdict::kNew,       Verdict::kStyle,           Verdict::kChanged,  Verdict::kWorse,
    Verdict::kMissing,   Verdict::kUnreadable};

/// In files and on the command line: "identical", "within-tolerance", "renderer", "better", "new",
/// "style", "changed", "worse", "missing", "unreadable".
std::string_view name(Verdict verdict);

/// The words for readers: "data, within tolerance", "data, worse", ...
std::string_view label(Verdict verdict);

/// The verdict of that name; empty if there is none.
std::optional<Verdict> verdict_named(std::string_view name);

/// The heavier of the two.
Verdict heavier(Verdict a, Verdict b);

/// A verdict with its reason.
struct Judgement {
  Verdict verdict = Verdict::kIdentical;
  /// Whether the difference is visible in the image; for kRenderer it decides whether it passes.
  bool visible = true;
  std::string cause;  ///< One sentence; empty if identical.
  /// What may be the cause of other items too: another seed, another renderer; empty: nothing.
  std::string shared_cause = {};
};

/// Whether a check passes: identical, within tolerance, an invisible difference of the renderer,
/// and verdicts that are allowed by name.
bool passes(const Judgement& judgement, std::span<const Verdict> allowed);

}  // namespace mapproof
