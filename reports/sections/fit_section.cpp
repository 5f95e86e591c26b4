#include "reports/sections/fit_section.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "core/results/quantity.hpp"
#include "render/figures/diagrams/fit.hpp"
#include "render/figures/unit_scale.hpp"
#include "reports/sections/fit_text.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

bool is_alarm(FitVerdict verdict) { return verdict != FitVerdict::kFits; }

bool is_cause(const Fit& fit, const FitTest& test) {
  return std::ranges::any_of(fit.causes, [&](const FitCause& cause) {
    return cause.code == test.code && cause.landmarks == test.landmarks;
  });
}

KeyValues number_items(const Fit& fit) {
  KeyValues items;
  for (const FitNumber& number : fit.numbers) {
    const Quantity* known = find_quantity(number.quantity);
    Quantity shown = known == nullptr ? Quantity{.label = number.quantity} : *known;
    const ScaledUnit unit = scaled_unit(shown.unit, std::abs(number.value));
    shown.unit = unit.unit;
    const std::string value = significant(unit.factor * number.value);
    items.items.push_back({label_with_unit(shown),
                           {number.bound ? fmt::format("{} (bound {})", value,
                                                       significant(unit.factor * *number.bound))
                                         : value}});
  }
  return items;
}

std::string tests_title(const std::vector<FitTest>& tests) {
  const auto exceeded = std::ranges::count_if(tests, &FitTest::exceeds);
  const std::string all = counted(std::ssize(tests), "test");
  if (tests.empty()) return "The fit was not tested";
  if (exceeded == 0 && tests.size() == 1) return "The test of the fit is within its bound";
  if (exceeded == 0) return fmt::format("All {} of the fit are within their bounds", all);
  return fmt::format("{} of {} of the fit {}", exceeded, all,
                     exceeded == 1 ? "exceeds its bound" : "exceed their bounds");
}

}  // namespace

Figure fit_figure(const Fit& fit, const std::string& id, std::vector<std::string> record_ids) {
  FitTestsSpec spec{.id = id,
                    .title = tests_title(fit.tests),
                    .verdict = verdict_text(fit),
                    .is_alarm = is_alarm(fit.verdict),
                    .rows = {},
                    .record_ids = std::move(record_ids)};
  for (const FitTest& test : fit.tests)
    spec.rows.push_back({.label = test_label(test.code, test.landmarks),
                         .key = fmt::format("test-{}", spec.rows.size() + 1),
                         .ratio = test.statistic / test.bound,
                         .is_cause = is_cause(fit, test)});
  Figure figure = fit_tests_figure(spec);
  std::vector<std::string> meanings;
  for (const FitTest& test : fit.tests) {
    const std::string meaning = test_meaning(test);
    if (meaning.empty() || std::ranges::find(meanings, meaning) != meanings.end()) continue;
    meanings.push_back(meaning);
    figure.caption += " " + meaning;
  }
  return figure;
}

Highlights::Item fit_number(const Fit& fit) {
  const auto exceeded = std::ranges::count_if(fit.tests, &FitTest::exceeds);
  const std::string tests = counted(std::ssize(fit.tests), "test");
  return {.label = "the map to its data",
          .value = verdict_words(fit.verdict),
          .detail = fit.tests.empty()
                        ? "no test could be made"
                        : fmt::format("{} of {} beyond what noise explains", exceeded, tests),
          .section = kFitSection,
          .falls_short = fit.verdict == FitVerdict::kDoesNotFit};
}

Section fit_section(const Fit& fit, const std::vector<FigureBlock>& figures, const std::string& id,
                    const std::string& title, const std::string& verdict) {
  Section section{id, title, {}};
  section.blocks.emplace_back(
      Callout{is_alarm(fit.verdict) ? Callout::Tone::kWarning : Callout::Tone::kNote,
              "Verdict: " + verdict_words(fit.verdict),
              plain(verdict.empty() ? verdict_text(fit) : verdict)});
  BulletList items;
  for (const FitCause& cause : fit.causes) items.items.push_back(plain(cause_text(cause)));
  if (const std::string parts = parts_text(fit); !parts.empty())
    items.items.push_back(plain(parts));
  if (fit.why.size() > 1)
    for (const FitMissing missing : fit.why)
      items.items.push_back(plain("Missing: " + why_text(missing)));
  if (!items.items.empty()) section.blocks.emplace_back(std::move(items));
  // Words and numbers between high figures fill a page of paper.
  if (!figures.empty()) section.blocks.emplace_back(figures.front());
  if (!fit.numbers.empty()) section.blocks.emplace_back(number_items(fit));
  BulletList limits;
  for (const FitTest& test : fit.tests)
    if (const std::string limit = limit_text(test); !limit.empty())
      limits.items.push_back(plain(limit));
  if (!limits.items.empty()) {
    section.blocks.emplace_back(plain("What these data could not have shown:"));
    section.blocks.emplace_back(std::move(limits));
  }
  for (std::size_t i = 1; i < figures.size(); ++i) section.blocks.emplace_back(figures[i]);
  return section;
}

}  // namespace mapproof
