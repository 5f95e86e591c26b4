#pragma once

#include <string>
#include <vector>

#include "core/model/method.hpp"

namespace mapproof {

/// A number that a paper printed, shown beside ours.
struct PublishedValue {
  MethodSetting setting;
  double mpe_m = 0.0;
  double moe_percent = 0.0;
  std::string note = {};  ///< Why ours cannot match it, a sentence or two; empty: nothing known.
};

/// What was published on one sensor's part of an experiment; nothing if `source` is empty.
struct Published {
  std::string source = {};  ///< "Yairi 2007, Table 1".
  std::string table = {};   ///< Id of the table that has ours beside it: "table-1"; may be empty.
  std::vector<PublishedValue> values = {};
  std::vector<std::string> notes = {};  ///< On all of the values, a sentence or two each.
  /// Methods from least to greatest MPE, as the source has them and ours is expected to.
  std::vector<std::vector<Method>> orderings = {};
};

}  // namespace mapproof
