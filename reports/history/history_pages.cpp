#include "reports/history/history_pages.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "reports/history/nightly_standing.hpp"
#include "reports/history/shown_names.hpp"
#include "reports/model/report.hpp"

namespace mapproof {
namespace {

TextCell text(std::string words) { return {std::move(words), Emphasis::kPlain}; }

Cell number(double value, int decimals) {
  if (!std::isfinite(value)) return MissingCell{};
  return NumberCell{value, decimals};
}

std::string words_of(const NightlyFacts& nightly_run) {
  switch (nightly_run.verdict) {
    case NightlyVerdict::kPassed:
      return std::string(verdict_word(nightly_run));
    case NightlyVerdict::kCost:
      return "slower or larger";
    default:
      return "accuracy worse";
  }
}

/// The last step of each method, of what is an error or shown.
std::vector<SeriesId> last_steps(const StudyTrend& trend) {
  std::vector<SeriesId> last;
  for (const auto& [id, values] : trend.medians) {
    const NightlyRule rule = rule_of(id, trend.quantities, trend.medians);
    if (!is_accuracy(rule) && rule != NightlyRule::kShown) continue;
    const auto later = std::ranges::find_if(last, [&](const SeriesId& other) {
      return method_of(other) == method_of(id) && other.quantity == id.quantity;
    });
    if (later == last.end())
      last.push_back(id);
    else
      *later = id;
  }
  return last;
}

/// Figures of the index: its reader sees the course at a glance, the trends have all.
constexpr std::size_t kMostOnIndex = 2;

/// Links to nightly runs in one sentence at most; the index lists all.
constexpr std::size_t kMostLinked = 10;

FigureBlock block_of(const Figure& figure) {
  return {figure.id, figure.title, figure.caption, figure.alt, figure.record_ids};
}

Gallery gallery_of(const std::vector<Figure>& figures) {
  Gallery gallery;
  for (const Figure& figure : figures) gallery.figures.push_back(block_of(figure));
  return gallery;
}

/// The findings of a nightly run.
std::span<const NightlyFinding> found_on(int nightly_run, const NightlyFindings& findings) {
  const auto found = findings.find(nightly_run);
  return found == findings.end() ? std::span<const NightlyFinding>{} : found->second;
}

/// Which nightly runs the page shows.
Paragraph nightly_runs_shown(const StudyTrend& trend) {
  return {{{fmt::format(
      "{} from nightly run {} on are shown: those with the same settings as the last.",
      counted(static_cast<long long>(trend.nightly_runs.size()), "nightly run"),
      trend.nightly_runs.front().number)}}};
}

/// "all nightly runs, trends of tiny, report of nightly run 9, which it was compared with".
Paragraph ways(std::vector<Phrase> to, const std::optional<Phrase>& reference) {
  Paragraph all{{{"See "}}};
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (i > 0) all.phrases.push_back({", "});
    all.phrases.push_back(std::move(to[i]));
  }
  if (reference) {
    all.phrases.push_back({", "});
    all.phrases.push_back(*reference);
    all.phrases.push_back({", which it was compared with"});
  }
  all.phrases.push_back({"."});
  return all;
}

/// Figures of the last nightly run's studies, those that have findings first.
std::vector<Figure> course(const IndexFacts& facts) {
  std::vector<const StudyTrend*> trends;
  for (const StudyTrend& trend : facts.trends) trends.push_back(&trend);
  const auto found = found_on(facts.nightly_runs.back().number, facts.findings);
  std::ranges::stable_partition(trends, [&](const StudyTrend* trend) {
    return std::ranges::find(found, trend->name, &NightlyFinding::study) != found.end();
  });
  const bool among_others = trends.size() > 1;
  std::vector<Figure> figures;
  std::set<std::string> ids;
  for (const StudyTrend* trend : trends)
    for (Figure& figure :
         trend_figures(*trend, facts.findings,
                       {.among_others = among_others, .most = among_others ? 1 : kMostOnIndex}))
      if (figures.size() < kMostOnIndex && ids.insert(figure.id).second)
        figures.push_back(std::move(figure));
  return figures;
}

/// A warning on nightly runs that were lost, with what is left of them; nothing if none was.
std::optional<Callout> reported_of(const LostNightlyRuns& lost) {
  if (lost.kept_as.empty()) return std::nullopt;
  const bool one = lost.kept_as.size() == 1;
  std::string text = fmt::format(
      "{} kept as {}, and a new one was begun: nightly runs are not compared with any before "
      "that. ",
      one ? "It is" : "They are", listed(lost.kept_as, 4));
  text += lost.reports.empty()
              ? "No report of its nightly runs is left in nightly_runs/."
              : fmt::format(
                    "The reports of {} from before that are still in nightly_runs/; they are "
                    "listed at the end of this page.",
                    counted(static_cast<long long>(lost.reports.size()), "nightly run"));
  return Callout{Callout::Tone::kWarning,
                 one ? "A history was damaged" : "Histories were damaged",
                 {{{text}}}};
}

Section last_section(const IndexFacts& facts, NightlyLinks& links) {
  Section last{"last", "The last nightly run", {}};
  const NightlyFacts& this_run = facts.nightly_runs.back();
  if (auto damage = reported_of(facts.lost)) last.blocks.emplace_back(std::move(*damage));
  if (const auto made = facts.studies.find(this_run.number); made != facts.studies.end())
    for (const std::string& study : made->second)
      last.blocks.emplace_back(Paragraph{{{study + ": ", Emphasis::kStrong},
                                          links.report(this_run.number, study),
                                          {", "},
                                          links.trends(study)}});
  BulletList list;
  for (const std::string& remark : facts.remarks) list.items.push_back({{{remark + "."}}});
  if (!list.items.empty()) last.blocks.emplace_back(std::move(list));
  return last;
}

Section lost_section(const LostNightlyRuns& lost, NightlyLinks& links) {
  BulletList list;
  for (const auto& [nightly_run, studies] : lost.reports)
    for (const std::string& study : studies)
      list.items.push_back({{{study + ": ", Emphasis::kStrong}, links.report(nightly_run, study)}});
  return {"lost", "Nightly runs of a damaged history", {std::move(list)}};
}

}  // namespace

Phrase NightlyLinks::link(const std::string& path, const std::string& words) {
  words_[path] = words;
  return {path, Emphasis::kFile};
}

Phrase NightlyLinks::index() { return link(folders_.pages + "index.html", "all nightly runs"); }

Phrase NightlyLinks::trends(const std::string& study) {
  return link(fmt::format("{}trends/{}/report.html", folders_.pages, study), "trends of " + study);
}

Phrase NightlyLinks::report(int nightly_run, const std::string& study) {
  return link(
      fmt::format("{}nightly_runs/{:04}/{}/report.html", folders_.nightly_runs, nightly_run, study),
      fmt::format("report of nightly run {}", nightly_run));
}

Phrase NightlyLinks::folder(int nightly_run) {
  return link(fmt::format("{}nightly_runs/{:04}/", folders_.nightly_runs, nightly_run),
              fmt::format("folder of nightly run {}", nightly_run));
}

std::string to_the_minute(const std::string& utc) {
  if (utc.size() != 20 || utc[10] != 'T' || utc[19] != 'Z') return utc;
  return utc.substr(0, 10) + " " + utc.substr(11, 5);
}

Table nightly_runs_table(std::span<const NightlyFacts> nightly_runs,
                         const NightlyFindings& findings, const NightlyStudies& studies,
                         NightlyLinks& links) {
  Table table{
      .id = "nightly-runs",
      .caption = "Every nightly run, the last one first.",
      .columns = {{"Run", "", "", "Its number: the order of nightly runs, whatever clocks say"},
                  {"Started", "", "", "UTC"},
                  {"Verdict", "", "", ""},
                  {"Findings", "", "", "How many"},
                  {"Compared with", "", "", "The nightly run it was compared with"},
                  {"Host", "", "", ""},
                  {"Report", "", "",
                   "The report of that nightly run; its folder if there are several"}},
      .rows = {},
      .notes = {}};
  for (const NightlyFacts& nightly_run : nightly_runs | std::views::reverse) {
    const auto found = findings.find(nightly_run.number);
    const std::size_t count = found == findings.end() ? 0 : found->second.size();
    const auto made = studies.find(nightly_run.number);
    const Phrase place = made != studies.end() && made->second.size() == 1
                             ? links.report(nightly_run.number, made->second.front())
                             : links.folder(nightly_run.number);
    // What got worse is marked by weight as well, not by its text alone.
    const Emphasis weight =
        nightly_run.verdict == NightlyVerdict::kPassed ? Emphasis::kPlain : Emphasis::kStrong;
    const Cell against =
        nightly_run.reference ? Cell{number(*nightly_run.reference, 0)} : Cell{MissingCell{}};
    table.rows.push_back(
        {{number(nightly_run.number, 0), text(to_the_minute(nightly_run.started_utc)),
          TextCell{words_of(nightly_run) + (nightly_run.pinned ? ", pinned" : ""), weight},
          number(static_cast<double>(count), 0), against,
          TextCell{nightly_run.host, Emphasis::kData}, TextCell{place.text, place.emphasis}},
         fmt::format("nightly run {}", nightly_run.number)});
  }
  return table;
}

Table findings_table(const NightlyFindings& findings, const std::string& study) {
  Table table{.id = "findings",
              .caption = "What got worse, the last nightly run first.",
              .columns = {{"Run", "", "", ""},
                          {"Since", "", "",
                           "The nightly run in which it began, as far as can be determined"},
                          {"Rule", "", "", "The rule that found it"},
                          {"Finding", "", "", ""}},
              .rows = {},
              .notes = {}};
  for (const auto& [nightly_run, of_nightly_run] : findings | std::views::reverse)
    for (const NightlyFinding& finding : of_nightly_run)
      if (finding.study == study)
        table.rows.push_back({{number(nightly_run, 0), number(finding.since, 0),
                               text(std::string(name(finding.rule))), text(finding.sentence)},
                              fmt::format("nightly run {}", nightly_run)});
  return table;
}

Table accuracy_table(const StudyTrend& trend) {
  const std::vector<SeriesId> shown = last_steps(trend);
  const bool has_steps = std::ranges::any_of(shown, [](const SeriesId& id) { return id.step > 0; });
  Table table{.id = "accuracy-now",
              .caption = has_steps ? "Medians over the runs at the last step of each method."
                                   : "Medians over the runs.",
              .columns = {{"Method", "", "", ""},
                          {"Quantity", "", "", ""},
                          {"Unit", "", "", ""},
                          {"First", "", "", "The first of the nightly runs shown"},
                          {"Before", "", "", "The nightly run before the last"},
                          {"Last", "", "", "The last nightly run"}},
              .rows = {},
              .notes = {}};
  for (const SeriesId& id : shown) {
    const Quantity& quantity = trend.quantities.at(id.quantity);
    const std::vector<double>& values = trend.medians.at(id);
    const double before = values.size() > 1 ? values[values.size() - 2] : kNaN;
    table.rows.push_back(
        {{text(shown_subject(trend.labels, id)), text(quantity.label), text(quantity.unit),
          number(values.front(), 4), number(before, 4), number(values.back(), 4)},
         "medians over runs"});
  }
  return table;
}

HistoryPage trend_page(const StudyTrend& trend, const NightlyFindings& findings, bool is_compared,
                       const HistoryFolders& folders) {
  HistoryPage page;
  NightlyLinks links(folders);
  page.figures = trend_figures(trend, findings);
  page.report.title = trend.name + ", by nightly run";
  page.report.subtitle = fmt::format("Nightly runs {} to {}", trend.nightly_runs.front().number,
                                     trend.nightly_runs.back().number);
  const NightlyFacts& this_run = trend.nightly_runs.back();
  page.report.opening.standing =
      study_standing(this_run, found_on(this_run.number, findings), trend.name, is_compared);
  std::optional<Phrase> reference;
  if (is_compared && this_run.reference) reference = links.report(*this_run.reference, trend.name);
  page.report.opening.findings.push_back(
      ways({links.index(), links.report(this_run.number, trend.name)}, reference));
  page.report.sections.push_back(
      {"trends", "Trends", {nightly_runs_shown(trend), gallery_of(page.figures)}});
  page.report.sections.push_back({"values", "Values", {accuracy_table(trend)}});
  if (Table found = findings_table(findings, trend.name); !found.rows.empty())
    page.report.sections.push_back({"findings", "Findings", {std::move(found)}});
  page.link_words = links.words();
  return page;
}

HistoryPage index_page(const IndexFacts& facts, const HistoryFolders& folders) {
  HistoryPage page;
  Report& report = page.report;
  report.title = "Nightly runs";
  if (facts.nightly_runs.empty()) {
    report.sections.push_back(
        {"last", "The last nightly run", {Paragraph{{{"No nightly run was recorded yet."}}}}});
    return page;
  }
  NightlyLinks links(folders);
  const NightlyFacts& this_run = facts.nightly_runs.back();
  report.subtitle =
      fmt::format("{}, the last begun {} UTC",
                  counted(static_cast<long long>(facts.nightly_runs.size()), "nightly run"),
                  to_the_minute(this_run.started_utc));
  report.opening.standing = nightly_standing(this_run, found_on(this_run.number, facts.findings));
  report.sections.push_back(last_section(facts, links));
  page.figures = course(facts);
  if (!page.figures.empty())
    report.sections.push_back(
        {"course", "Trends over the nightly runs", {gallery_of(page.figures)}});
  report.sections.push_back(
      {"nightly-runs",
       "All nightly runs",
       {nightly_runs_table(facts.nightly_runs, facts.findings, facts.studies, links)}});
  if (!facts.lost.reports.empty()) report.sections.push_back(lost_section(facts.lost, links));
  page.link_words = links.words();
  return page;
}

void add_nightly_run(Report& report, const StudyOfNightlyRun& study, NightlyLinks& links) {
  const NightlyRun& nightly_run = study.nightly_run;
  const LostNightlyRuns& lost = study.lost;
  Opening& opening = report.opening;
  opening.standing =
      study_standing(nightly_run.facts, nightly_run.findings, study.name, study.is_compared);
  std::optional<Phrase> reference;
  if (study.is_compared && nightly_run.facts.reference)
    reference = links.report(*nightly_run.facts.reference, study.name);
  std::vector<Paragraph> head = {ways({links.index(), links.trends(study.name)}, reference)};
  if (!lost.kept_as.empty()) {
    opening.standing->worse = true;
    opening.standing->sentences.push_back(
        fmt::format("The history was damaged. It is kept as {}, and a new one begins with this "
                    "nightly run: there is none before it to compare with.",
                    lost.kept_as.back()));
    std::vector<Phrase> reports;
    for (const auto& [number, studies] : lost.reports)
      if (std::ranges::find(studies, study.name) != studies.end())
        reports.push_back(links.report(number, study.name));
    if (reports.size() > kMostLinked)
      reports.erase(reports.begin(), reports.end() - static_cast<long>(kMostLinked));
    if (!reports.empty()) {
      head.push_back(ways(std::move(reports), std::nullopt));
      head.back().phrases.front().text = "Reports from before that are still there: ";
    }
  }
  opening.findings.insert(opening.findings.begin(), std::make_move_iterator(head.begin()),
                          std::make_move_iterator(head.end()));
}

}  // namespace mapproof
