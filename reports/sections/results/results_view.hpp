#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text/slug.hpp"
#include "core/results/results_study.hpp"
#include "core/results/values_by_run.hpp"
#include "core/statistics/intervals.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/results/paired_methods.hpp"

namespace mapproof {

/// The most characters of the id of a block, which leave room for what id_below() puts behind it.
inline constexpr std::size_t kLongestBlockId = kLongestId - 20;

/// A setup at one level of every factor but one: what has figures and tables of its own.
struct ResultsBlock {
  std::string id;                  ///< [a-z0-9-]+, unique in the study; begins with its name.
  std::string title;               ///< "Indoors, noise 0.1 m".
  std::string factor = {};         ///< Along which curves go; empty: there is a single level.
  std::vector<Level> levels = {};  ///< Of it, ascending; none without a factor.
  std::vector<Condition> conditions = {};  ///< One per level; one without a factor.
  std::vector<Level> others = {};          ///< The levels of the other factors.

  /// Whether the levels are numbers, so that a curve can go along them.
  bool has_axis() const;
};

/// The blocks of a setup that differ in the same factors, shown side by side.
struct ResultsOverview {
  std::string id;       ///< Of its section; unique in the study.
  std::string title;    ///< "Indoors: overview by terrain".
  std::string factors;  ///< "terrain", "terrain and light".
  std::vector<const ResultsBlock*> blocks;
  std::vector<std::string> names;   ///< Of the blocks, by what they differ in: "grass, day".
  std::optional<Level> level = {};  ///< Along the blocks' factor: the last that all of them have.
  std::vector<Condition> conditions = {};  ///< One per block, at that level.
};

/// What has one row of a table and one curve: a method, over all runs or, where runs are no
/// repeats of each other, in one run.
struct ResultsLine {
  std::string method;
  std::string run = {};    ///< Empty: all.
  std::string label;       ///< "EKF", "EKF, plaza-1".
  std::size_t index = 0;   ///< Of the method, in the order of the study.
  std::size_t series = 0;  ///< Its style in all figures, see series_style().
};

/// The value of each run, and how many runs lost theirs.
struct RunNumbers {
  ValuesByRun values;  ///< Finite; the mean over the subjects of a run.
  int lost = 0;
};

/// How often a method ended with each status under a condition.
struct StatusCounts {
  std::map<std::string, int> codes;  ///< Runs that have it.
  int runs = 0;                      ///< In all.
};

/// How many runs there are, and how many groups of them.
struct RunCounts {
  std::size_t runs = 0;
  std::size_t groups = 0;
};

/// A study's results as figures and tables show them.
class ResultsView {
 public:
  /// @param study  complete(), its rows in order; must outlive the view, which keeps some hundred
  ///               bytes per condition, method and quantity, and 10 per run.
  explicit ResultsView(const ResultsStudy& study);

  const ResultsStudy& study() const { return study_; }
  const std::vector<ResultsBlock>& blocks() const { return blocks_; }
  /// One per setup that has several blocks of one factor; none where it has levels that differ.
  const std::vector<ResultsOverview>& overviews() const { return overviews_; }
  std::size_t runs() const { return groups_.size(); }
  std::size_t groups() const { return groups_in_all_; }
  /// Of one setup alone; none of a setup without rows.
  RunCounts counts_of(const std::string& setup) const;
  /// Otherwise figures and tables show the runs themselves, and no title ranks methods.
  bool has_groups_for_intervals() const { return groups() >= kFewestGroups; }

  /// One of the study's quantities, under the study's label.
  const Quantity& quantity(const std::string& id) const { return quantities_.at(id); }
  /// The quantities that a block has, in the order of the study.
  std::vector<const Quantity*> quantities(const ResultsBlock& block) const;
  /// Whether large values of a quantity are those of methods that diverged: it is an error in m,
  /// and the least value of the study is a usual one.
  bool has_great_errors(const Quantity& quantity) const;
  /// Of a quantity's means in all tables and figures; those of methods that diverged have none.
  int decimals(const Quantity& quantity) const { return decimals_.at(quantity.id); }
  /// The lines that a block has of a quantity, in the order of methods and runs.
  std::vector<ResultsLine> lines(const ResultsBlock& block, const Quantity& quantity) const;

  /// Nothing in it where nothing was tried.
  RunNumbers numbers(const Condition& at, const ResultsLine& line, const Quantity& quantity) const;
  /// The mean over runs with its interval over groups; empty without a value.
  std::optional<MeanEstimate> mean(const Condition& at, const ResultsLine& line,
                                   const Quantity& quantity) const;
  /// The 95 % interval of a mean(), cut where the quantity has no values (at 0 if none of its
  /// values lies below, at 100 % if its unit is that and none lies above), or, without groups for
  /// one, the least and the greatest value of the runs. Empty of fewer than two.
  std::optional<Interval> spread(const Condition& at, const ResultsLine& line,
                                 const Quantity& quantity) const;
  /// What is known of how a line's runs ended.
  StatusCounts statuses(const Condition& at, const ResultsLine& line) const;
  /// The group of each run of the study.
  const GroupsByRun& run_groups() const { return groups_; }

  /// "noise 0.1 m, light day": what several setups have and none has otherwise, which their titles
  /// leave out; empty if there is nothing.
  std::string shared_words() const;
  /// "noise 0.1 m": a level in words.
  std::string level_words(const Level& level) const;
  /// "noise [m]".
  std::string factor_label(const std::string& factor) const;
  /// A part of ids; unique among the setups.
  const std::string& setup_slug(const std::string& setup) const { return slugs_.at(setup); }
  /// "Indoors, noise 0.1 m": a block at one of its conditions.
  std::string words_of(const ResultsBlock& block, std::size_t condition) const;

 private:
  /// The rows of one condition, method and quantity, which stand together.
  struct Key {
    Condition at;
    Name method, quantity;

    auto operator<=>(const Key&) const = default;
  };
  using Rows = std::span<const Result>;

  std::optional<Interval> interval(const std::optional<MeanEstimate>& mean,
                                   const Quantity& quantity) const;
  void take_rows();
  void name_setups();
  void find_shared_levels();
  /// Empty where nothing was tried.
  Rows rows_of(const Condition& at, const Name& method, const Name& quantity) const;
  void make_blocks();
  void add_setup(const Label& setup);
  void make_overviews();
  void set_decimals();
  /// Without its id and title.
  std::optional<ResultsOverview> overview_of(const std::vector<const ResultsBlock*>& blocks) const;
  /// "noise 0.1 m", "grass": a text needs no name of its factor.
  std::string short_words(const Level& level) const;

  const ResultsStudy& study_;
  std::vector<std::size_t> series_;             ///< Of its methods.
  std::map<std::string, Quantity> quantities_;  ///< By id.
  std::map<std::string, double> scales_;        ///< By which values are multiplied, by quantity.
  std::map<Key, Rows> rows_;
  std::map<std::pair<Condition, std::string>, std::vector<const RunOutcome*>> outcomes_;
  GroupsByRun groups_;
  std::vector<int> clusters_;  ///< By Name::id() of the group, in the order of rows.
  std::size_t groups_in_all_ = 0;
  std::map<Name, RunCounts> counts_;                         ///< By setup.
  std::map<std::string, std::pair<double, double>> ranges_;  ///< By quantity.
  std::set<std::string> usual_errors_;  ///< Quantities that have a value of a usual error in m.
  std::map<std::string, int> decimals_;       ///< By quantity.
  std::map<std::string, std::string> slugs_;  ///< By setup.
  std::vector<Level> shared_levels_;  ///< Of several setups, the only ones of their factors.
  std::vector<ResultsBlock> blocks_;
  std::vector<ResultsOverview> overviews_;
};

/// What series_style() takes for each method of a study, and for one that it does not have.
std::vector<std::size_t> styles_of(const ResultsStudy& study);

/// Whether a value counts as lost: no number, or too large for a sum of squares.
bool is_lost(double value);

/// The level's text for ids, with its sign in words: "minus-5", "0-5", "grass".
std::string level_slug(const Level& level);

}  // namespace mapproof
