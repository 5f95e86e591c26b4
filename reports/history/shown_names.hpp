#pragma once

#include <string>
#include <vector>

#include "reports/history/nightly_run.hpp"
#include "reports/model/label_text.hpp"

namespace mapproof {

// Ids as pages, findings and exports show them: under the labels of their study; a method that it
// does not label is shown as tables and figures have mapproof's own.

/// What settings have in common: the method that the study declares, without its levels; of
/// mapproof's own the name without its parameter, "smacof-knn" of "smacof-knn-K6". What is neither
/// as it is.
std::string base_method(const StudyLabels& labels, const std::string& method);

/// Its label; the id if it has none.
std::string shown_setup(const StudyLabels& labels, const std::string& setup);

/// The levels in a SeriesId::method: "noise" 0.1 and "pace" 2 of "ekf noise=0.1 pace=2".
std::vector<ShownLevel> levels_of(const StudyLabels& labels, const std::string& method);

/// "My EKF, range noise 0.1 m" of "ekf noise=0.1"; without labels "ISOMAP, K = 6" of "isomap-K6".
/// A text that is not a method stays as it is.
std::string shown_method(const StudyLabels& labels, const std::string& method);

/// method_of() as shown, "bearing, ISOMAP, K = 6"; of a setup without a name the method alone.
std::string shown_method_of(const StudyLabels& labels, const SeriesId& series);

/// subject_of() as shown: "bearing, ISOMAP, K = 6, 2000 steps".
std::string shown_subject(const StudyLabels& labels, const SeriesId& series);

}  // namespace mapproof
