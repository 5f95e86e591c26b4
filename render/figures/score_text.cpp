#include "render/figures/score_text.hpp"

#include <cmath>

#include <fmt/format.h>

#include "render/figures/number_text.hpp"

namespace mapproof {

std::vector<ErrorWords> error_words(const Score& score) {
  const bool usual = std::isfinite(score.mpe_m);
  const double mpe = usual ? score.mpe_m : score.mpe_all_fitted_m;
  const double moe = usual ? score.moe_percent : score.moe_unmirrored_percent;
  std::vector<ErrorWords> words;
  if (std::isfinite(mpe))
    words.push_back({"MPE", error_text(mpe), "mean position error",
                     usual ? "" : "after the best affine fit to all landmarks"});
  if (std::isfinite(moe))
    words.push_back({"MOE", fmt::format("{:.2f} %", moe),
                     "landmark triples with a wrong orientation", usual ? "" : "up to a mirror"});
  return words;
}

std::string score_text(const Score& score) {
  std::string text;
  for (const ErrorWords& error : error_words(score)) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", error.name, error.value);
    if (!error.limit.empty()) text += " " + error.limit;
  }
  return text;
}

std::string title_with_error(const std::string& subject, const std::optional<Score>& score) {
  if (!score) return subject;
  if (std::isfinite(score->mpe_m))
    return fmt::format("{}: {} off in the mean", subject, error_text(score->mpe_m, 2));
  if (std::isfinite(score->mpe_all_fitted_m))
    return fmt::format("{}: {} off after the best affine fit", subject,
                       error_text(score->mpe_all_fitted_m, 2));
  return subject;
}

}  // namespace mapproof
