#pragma once

#include <optional>
#include <string>

#include "core/results/study_labels.hpp"

namespace mapproof {

// Ids of methods and factors as tables, figures and pages show them: under the labels of their
// study, else as mapproof calls its own.

/// The name of mapproof's method that a setting is of, without its parameter: "smacof-knn" of
/// "smacof-knn-K6"; empty of other settings.
std::string method_in_setting(const std::string& setting);

/// "ISOMAP, K = 6" of "isomap-K6"; a setting that is not mapproof's own as it is.
std::string setting_text(const std::string& setting);

/// The study's label of a method; setting_text() where it has none.
std::string method_text(const StudyLabels& labels, const std::string& method);

/// A level of a factor, by the factor's label and unit; the id is the label where there is none.
struct ShownLevel {
  std::string name;   ///< "range noise".
  std::string value;  ///< As reports show it: "0.1", "10⁻⁴".
  std::string unit = {};
  std::optional<double> number = {};  ///< Of a level that is one.

  /// "range noise 0.1 m".
  std::string words() const;
};

/// @param value  As results.csv has it.
ShownLevel shown_level(const StudyLabels& labels, const std::string& factor,
                       const std::string& value);

}  // namespace mapproof
