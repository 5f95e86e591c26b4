#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mapproof {

/// What the comparison of one thing says. In order of weight: the verdict of a whole is the
/// heaviest of its parts.
enum class Verdict {
  kIdentical,        ///< Equal values; nothing less is called so.
  kWithinTolerance,  ///< Values or pixels differ, all within their tolerances.
  kRenderer,         ///< Pixels differ, the figure's value is equal.
  kBetter,           ///< Data differ beyond tolerance, for the better.
  kNew,              ///< Only in the current.
  kStyle,            ///< Styles or words differ, data do not.
  kChanged,          ///< Differs beyond tolerance, and nothing says for better or worse.
  kWorse,            ///< Data differ beyond tolerance, for the worse.
  kMissing,          ///< Only in the baseline.
  kUnreadable,       ///< One of the two cannot be read.
};

inline constexpr std::array kVerdicts = {
    Verdict::kIdentical, Verdict::kWithinTolerance, Verdict::kRenderer, Verdict::kBetter,
    Verdict::kNew,       Verdict::kStyle,           Verdict::kChanged,  Verdict::kWorse,
    Verdict::kMissing,   Verdict::kUnreadable};

/// In files and on the command line: "identical", "within-tolerance", "renderer", "better", "new",
/// "style", "changed", "worse", "missing", "unreadable".
std::string_view name(Verdict verdict);

/// For readers: "data, within tolerance", "data, worse", ...
std::string_view label(Verdict verdict);

/// The verdict of that name; empty if there is none.
std::optional<Verdict> verdict_named(std::string_view name);

/// The heavier of the two.
Verdict heavier(Verdict a, Verdict b);

/// A verdict with its reason.
struct Judgement {
  Verdict verdict = Verdict::kIdentical;
  /// Whether a reader of the picture sees the difference; for kRenderer it decides.
  bool visible = true;
  std::string cause;  ///< One sentence; empty if identical.
};

/// Whether a check lets it pass: identical, within tolerance, a renderer's difference that nobody
/// sees, and what is allowed by name.
bool passes(const Judgement& judgement, std::span<const Verdict> allowed);

}  // namespace mapproof
