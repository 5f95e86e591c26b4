#include "core/trials/trial_means.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/errors.hpp"

namespace mapproof {

std::vector<double> trial_values(const TrialStudy& study, std::string_view setup,
                                 std::string_view series, double level, std::string_view quantity) {
  const auto& quantities = study.design.quantities;
  const auto found = std::ranges::find(quantities, quantity, &TrialQuantity::id);
  if (found == quantities.end()) throw InvalidInput("a study of trials without that quantity");
  const auto column = static_cast<std::size_t>(found - quantities.begin());
  std::vector<double> values;
  for (const TrialPart& part : study.parts)
    for (const Trial& trial : part.trials)
      if (trial.setup == setup && trial.series == series && trial.level == level &&
          std::isfinite(trial.values.at(column)))
        values.push_back(trial.values[column]);
  return values;
}

double trial_mean(const TrialStudy& study, std::string_view setup, std::string_view series,
                  double level, std::string_view quantity) {
  const std::vector<double> values = trial_values(study, setup, series, level, quantity);
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? std::numeric_limits<double>::quiet_NaN()
                        : sum / static_cast<double>(values.size());
}

void add_seconds(TrialPart& part, std::string_view series, double seconds) {
  const auto found = std::ranges::find(part.seconds, series, &TrialSeconds::series);
  if (found == part.seconds.end())
    part.seconds.push_back({part.id, std::string(series), seconds});
  else
    found->seconds += seconds;
}

}  // namespace mapproof
