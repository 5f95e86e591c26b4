#pragma once

#include <string>
#include <vector>

#include "core/model/fit.hpp"

namespace mapproof {

/// Gathers the tests of a fit, and the causes among them.
class FitMaker {
 public:
  /// @param names  Of the landmarks; must outlive the object.
  explicit FitMaker(const std::vector<std::string>& names) : names_(names) {}

  std::vector<std::string> names(const std::vector<int>& landmarks) const;

  /// A test, and a cause if it exceeds its bound.
  /// @param may_be_cause  False: another test names the cause.
  void test(FitCause cause, bool may_be_cause = true);

  /// Whether one of those codes is a cause already.
  bool has_cause(FitCode one, FitCode other) const;

  void number(const char* quantity, double value) { fit_.numbers.push_back({quantity, value}); }

  /// A group of landmarks whose position relative to the others is open.
  void part(const std::vector<int>& landmarks) { fit_.parts.push_back(names(landmarks)); }

  /// The gravest causes first, and the verdict: kDoesNotFit by a cause that is not small,
  /// kUndetermined by a connection that is not, kDoubtful by others, kFits without a cause.
  Fit finished() &&;

 private:
  const std::vector<std::string>& names_;
  Fit fit_;
};

}  // namespace mapproof
