#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/map/pipeline.hpp"
#include "app/result_json.hpp"
#include "core/base/text/words.hpp"
#include "core/choice/judged_maps.hpp"

namespace mapproof {
namespace {

/// What `--method auto` compared, and by what it picked.
struct MethodChoice {
  std::vector<JudgedMap> maps;     ///< All candidates.
  Criterion criterion;             ///< That the pick is the best by.
  std::vector<std::size_t> order;  ///< Rows of `maps` that gave a map, best first.
};

/// Judges the usual candidates for the first `steps` observations, by the criterion that picks best
/// with anchors, or without.
/// @param options  Its settings are filled in here.
MethodChoice choose_method(const ObservationHistory& history, Eigen::Index steps,
                           const UncertaintyFrame& frame, ChoiceOptions options) {
  const HistoryEmbedder usual(history, steps, options.embedder, options.rule);
  options.settings = usual_candidates(usual, history.landmarks());
  const MapJudge judge(history, steps, options);
  MethodChoice choice{
      .maps = judge.in(frame), .criterion = usual_criterion(!frame.anchors.empty()), .order = {}};
  choice.order = ranked(choice.maps, choice.criterion);
  return choice;
}

bool reported(const MethodChoice& choice, Criterion criterion) {
  return std::ranges::any_of(choice.maps, [&](const JudgedMap& map) {
    return !std::isnan(value_of(map.values, criterion));
  });
}

Table ranking_table(const MethodChoice& choice) {
  Table table{
      "ranking", "Candidates, best first", {{"Rank", "", "", ""}, {"Method", "", "", ""}}, {}, {}};
  std::vector<Criterion> shown;
  for (const CriterionInfo& criterion : all_criteria())
    if (reported(choice, criterion.criterion)) {
      shown.push_back(criterion.criterion);
      table.columns.push_back({std::string(criterion.label), "", "",
                               fmt::format("{}; {} is better.", criterion.meaning,
                                           criterion.lower_is_better ? "less" : "more")});
    }
  for (std::size_t rank = 0; rank < choice.order.size(); ++rank) {
    const JudgedMap& map = choice.maps[choice.order[rank]];
    Row row;
    row.cells = {NumberCell{static_cast<double>(rank + 1), 0}, TextCell{label(map.setting)}};
    for (const Criterion criterion : shown)
      row.cells.emplace_back(NumberCell{value_of(map.values, criterion), 3});
    table.rows.push_back(std::move(row));
  }
  const auto without = choice.maps.size() - choice.order.size();
  if (without > 0)
    table.notes.push_back(counted(static_cast<long long>(without), "candidate") + " gave no map.");
  return table;
}

/// The candidates that are as good as the best one, but for rounding; the best one first.
std::vector<std::string> equals_of(const MethodChoice& choice) {
  constexpr double kRounding = 1e-9;
  std::vector<std::string> equals;
  const auto value = [&](std::size_t m) {
    return value_of(choice.maps[m].values, choice.criterion);
  };
  for (const std::size_t m : choice.order)
    if (std::abs(value(m) - value(choice.order.front())) <=
        kRounding * std::max(1.0, std::abs(value(choice.order.front()))))
      equals.push_back(label(choice.maps[m].setting));
  return equals;
}

/// "LPCA and ISOMAP, K = 6 are equally good by it; ..."; empty if one is the best.
std::string equals_text(const MethodChoice& choice) {
  const std::vector<std::string> equals = equals_of(choice);
  if (equals.size() < 2) return "";
  return fmt::format(
      "{} candidates are equally good by \"{}\" ({}): the one tried first was "
      "taken.",
      equals.size(), info(choice.criterion).label, listed(equals, 6));
}

/// The ranking as a table, and in words what was done.
Section choice_section(const MethodChoice& choice, bool is_asked) {
  const CriterionInfo& criterion = info(choice.criterion);
  Section section{"choice", "Why this method", {}};
  section.blocks.emplace_back(Paragraph{{{fmt::format(
      "Chosen {}: {} were tried, and the best by \"{}\" was taken ({}). None of "
      "these "
      "criteria uses the ground truth; in simulated worlds this one chose best.",
      is_asked ? "by --method auto" : "since --method names none",
      counted(std::ssize(choice.maps), "candidate"), criterion.label, criterion.meaning)}}});
  if (const std::string equals = equals_text(choice); !equals.empty())
    section.blocks.emplace_back(Paragraph{{{equals}}});
  section.blocks.emplace_back(ranking_table(choice));
  return section;
}

/// The same for --json: criterion, and method, parameter and values of each candidate.
nlohmann::ordered_json choice_json(const MethodChoice& choice) {
  nlohmann::ordered_json candidates = nlohmann::ordered_json::array();
  for (const std::size_t m : choice.order) {
    const JudgedMap& map = choice.maps[m];
    nlohmann::ordered_json candidate{{"method", info(map.setting.method).name},
                                     {"parameter", parameter_json(map.setting)}};
    for (const CriterionInfo& criterion : all_criteria())
      candidate[std::string(criterion.name)] =
          number_or_null(value_of(map.values, criterion.criterion));
    candidates.push_back(std::move(candidate));
  }
  return {{"criterion", info(choice.criterion).name}, {"candidates", std::move(candidates)}};
}

/// Whether the choice takes at most some 5 s of one processor. Measured: 2.1 s for 200 landmarks x
/// 4000 steps, 2.4 s for 60 x 600, where SDE is a candidate.
bool is_quick(Eigen::Index count, Eigen::Index steps) {
  constexpr Eigen::Index kMostLandmarks = 200;
  constexpr double kMostProducts = 3e8;  // Landmarks squared times steps.
  const auto landmarks = static_cast<double>(count);
  return count <= kMostLandmarks &&
         landmarks * landmarks * static_cast<double>(steps) <= kMostProducts;
}

MapDraft choose(MapDraft draft, const MapJob& job) {
  const bool is_open =
      job.may_choose_method() && (std::holds_alternative<ObservationSource>(draft.observed) ||
                                  std::holds_alternative<PackedSource>(draft.observed));
  if (is_open && !is_quick(std::ssize(draft.landmarks.names), draft.result.record.step)) {
    draft.result.remarks.emplace_back(
        "The method is isomap, since none is named and the choice would take long: --method auto "
        "may give a better map");
    return draft;
  }
  if (!job.chooses_method() && !is_open) return draft;
  hold_array(draft);
  const auto* source = std::get_if<ObservationSource>(&draft.observed);
  const MethodChoice choice = choose_method(
      source->history, draft.result.record.step,
      {draft.reference.positions_m, draft.reference.anchors},
      {.embedder = job.embedder, .rule = draft.distances.of_others, .fit = job.affine_fit()});
  if (!choice.order.empty()) draft.setting = choice.maps[choice.order.front()].setting;
  draft.result.sections.push_back(choice_section(choice, job.chooses_method()));
  if (std::string equals = equals_text(choice); !equals.empty())
    draft.result.remarks.push_back(std::move(equals));
  draft.result.members.push_back({"choice", choice_json(choice)});
  return draft;
}

}  // namespace

const MapStep kMethodChoice{choose};

}  // namespace mapproof
