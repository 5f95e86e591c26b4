#include "reports/diff/verdict/verdict.hpp"

#include <algorithm>

namespace mapproof {

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kIdentical:
      return "identical";
    case Verdict::kWithinTolerance:
      return "within-tolerance";
    case Verdict::kRenderer:
      return "renderer";
    case Verdict::kBetter:
      return "better";
    case Verdict::kNew:
      return "new";
    case Verdict::kStyle:
      return "style";
    case Verdict::kChanged:
      return "changed";
    case Verdict::kWorse:
      return "worse";
    case Verdict::kMissing:
      return "missing";
    case Verdict::kUnreadable:
      return "unreadable";
  }
  return "";
}

std::string_view label(Verdict verdict) {
  switch (verdict) {
    case Verdict::kWithinTolerance:
      return "data, within tolerance";
    case Verdict::kBetter:
      return "data, better";
    case Verdict::kWorse:
      return "data, worse";
    default:
      return name(verdict);
  }
}

std::optional<Verdict> verdict_named(std::string_view text) {
  const auto found =
      std::ranges::find(kVerdicts, text, [](Verdict verdict) { return name(verdict); });
  return found == kVerdicts.end() ? std::nullopt : std::optional(*found);
}

Verdict heavier(Verdict a, Verdict b) { return std::max(a, b); }

bool passes(const Judgement& judgement, std::span<const Verdict> allowed) {
  switch (judgement.verdict) {
    case Verdict::kIdentical:
    case Verdict::kWithinTolerance:
      return true;
    case Verdict::kRenderer:
      if (!judgement.visible) return true;
      break;
    default:
      break;
  }
  return std::ranges::find(allowed, judgement.verdict) != allowed.end();
}

}  // namespace mapproof
