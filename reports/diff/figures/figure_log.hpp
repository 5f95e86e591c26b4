#pragma once

#include <string>
#include <string_view>

#include "reports/diff/figures/figure_diff.hpp"

namespace mapproof {

/// FigureChange::what of a figure that was made of other records.
inline constexpr std::string_view kRecordsWord = "records";

/// How the cause begins of a figure that differs in nothing else.
inline constexpr std::string_view kMadeOfOthers = "made of other records";

/// Gathers what two figures differ in, within bounds.
class FigureLog {
 public:
  /// @param varies  Places and numbers are counted as masked; other words, layers, numbers of
  ///                points and records are told of such figures too.
  explicit FigureLog(bool varies) : varies_(varies) {}

  /// Notes nothing if both values are the same.
  void change(ChangeKind kind, const std::string& place, std::string_view what,
              const std::string& baseline, const std::string& current);
  void move(MarkMove move);
  /// A difference that is not judged, as the figure varies.
  void mask() { ++diff_.masked; }
  /// A point that moved within tolerance.
  void within() { ++diff_.within; }
  /// Errors of marks on both sides: their sums, and how many.
  void errors(double baseline, double current, double count);

  /// All of it: data changes first, far moves first.
  FigureDiff take();

 private:
  bool varies_;
  FigureDiff diff_;
  double baseline_errors_ = 0.0, current_errors_ = 0.0, errors_ = 0.0;
};

}  // namespace mapproof
