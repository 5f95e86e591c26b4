#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "render/theme/theme.hpp"

namespace mapproof::test {

/// What a figure does against the rules of docs/figures.md in a theme, a line each; empty if it
/// keeps them all: fewer than two labels on an axis, or three where they have room; labels of
/// several forms, or one twice, on an axis; an axis from 0 whose lines lie in its uppermost part;
/// bars or points cut by the frame, or bands without a note; texts with a part left out; a title
/// that counts what it does not name; two lines of one style or two colours that touch and are
/// alike; frames that take too little of the page.
std::vector<std::string> broken_rules(const Figure& figure, const Theme& theme);

/// The styles of methods over many figures.
class MethodStyles {
 public:
  /// Takes the styles of the figure's lines whose marks name a curve.
  void see(const Figure& figure);
  /// Methods with two styles, and styles of two methods, a line each.
  std::vector<std::string> conflicts() const;

 private:
  std::map<std::string, std::set<std::string>> styles_;   ///< By method.
  std::map<std::string, std::set<std::string>> methods_;  ///< By style.
};

}  // namespace mapproof::test
