#include "reports/sections/trials/trial_means.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/words.hpp"
#include "reports/sections/results/results_view.hpp"
#include "reports/sections/run_scores.hpp"

namespace mapproof {
namespace {

/// The values of one quantity, by the run that they belong to.
std::optional<MeanEstimate> mean_of(const std::vector<std::pair<RunId, const Trial*>>& trials,
                                    std::size_t quantity) {
  RunValues values;
  for (const auto& [run, trial] : trials)
    if (std::isfinite(trial->values[quantity])) values.add(run, trial->values[quantity]);
  return values.mean();
}

/// One cell of the trials that belong to it; empty without any.
std::optional<TrialCell> cell_of(const TrialStudy& study, TrialCell cell) {
  std::vector<std::pair<RunId, const Trial*>> trials;
  for (const TrialPart& part : study.parts) {
    if (!cell.part.empty() && part.id != cell.part) continue;
    for (const Trial& trial : part.trials)
      if (trial.setup == cell.setup && trial.series == cell.series && trial.level == cell.level)
        trials.emplace_back(part.run.value_or(RunId{}), &trial);
  }
  if (trials.empty()) return std::nullopt;
  cell.tried = static_cast<int>(trials.size());
  for (std::size_t i = 0; i < study.design.quantities.size(); ++i)
    cell.means.push_back(mean_of(trials, i));
  for (const auto& [run, trial] : trials) {
    std::set<StatusCode> codes;
    for (const Status& status : trial->statuses) codes.insert(status.code);
    for (const StatusCode code : codes) ++cell.statuses[code];
  }
  return cell;
}

}  // namespace

std::vector<TrialCell> trial_cells(const TrialStudy& study) {
  std::vector<std::string> parts = {""};
  if (is_of_data(study)) {
    parts.clear();
    for (const TrialPart& part : study.parts) parts.push_back(part.id);
  }
  std::vector<TrialCell> cells;
  for (const TrialSetup& setup : study.design.setups)
    for (const TrialSeries& series : study.design.series)
      for (const double level : setup.levels)
        for (const std::string& part : parts) {
          TrialCell asked;
          asked.setup = setup.id;
          asked.series = series.id;
          asked.level = level;
          asked.part = part;
          if (auto cell = cell_of(study, std::move(asked))) cells.push_back(*std::move(cell));
        }
  return cells;
}

std::vector<const TrialCell*> cells_of(const std::vector<TrialCell>& cells,
                                       const std::string& setup, const std::string& series) {
  std::vector<const TrialCell*> found;
  for (const TrialCell& cell : cells)
    if (cell.setup == setup && cell.series == series) found.push_back(&cell);
  return found;
}

bool is_of_data(const TrialStudy& study) { return !study.experiment.data.empty(); }

int decimals_of(const std::vector<TrialCell>& cells, std::size_t quantity) {
  std::vector<double> means;
  for (const TrialCell& cell : cells)
    if (cell.means[quantity]) means.push_back(cell.means[quantity]->mean);
  return decimals_of(std::move(means));
}

std::string id_prefix(const TrialStudy& study) {
  std::string id = lower_case(study.experiment.name);
  std::ranges::replace(id, '_', '-');
  return id.front() >= 'a' && id.front() <= 'z' ? id : "study-" + id;
}

}  // namespace mapproof
