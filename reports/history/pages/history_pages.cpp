#include "reports/history/pages/history_pages.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/words.hpp"
#include "core/base/version.hpp"
#include "reports/history/nightly_run.hpp"
#include "reports/history/nightly_standing.hpp"
#include "reports/history/pages/history_tables.hpp"
#include "reports/model/report.hpp"

namespace mapproof {
namespace {

/// What pages show at most: groups of findings in a section, whose rest the trends have; links to
/// nightly runs in one sentence, whose rest the index has; small figures on a first screen.
constexpr std::size_t kMostGroups = 30, kMostLinked = 10, kMostSmall = 6;

/// "See all nightly runs, trends of tiny, report of nightly run 9, which it was compared with."
/// @param reference  What it was compared with, if anything.
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

/// What got worse in one group, and where to find it.
/// @param to  Links to pages on it.
FindingBlock finding_block(const FindingGroup& group, std::vector<Phrase> to, NightlyLinks& links) {
  const CommitRange& commits = group.commits;
  FindingBlock block;
  block.title = group.headline();
  block.details = group.sentences;
  block.known = group.known.has_value();
  block.command = block.known ? "" : commits.bisect();
  if (const std::string gaps = commits.bisect_gaps(); !block.command.empty() && !gaps.empty())
    block.details.push_back(gaps);
  auto& phrases = block.text.phrases;
  phrases.push_back({group.study, Emphasis::kData});
  if (!group.setup.empty()) phrases.push_back({", " + group.setup});
  if (const std::string count = group.count_text(); !count.empty())
    phrases.push_back({", " + count});
  if (const std::string values = group.values_text(); !values.empty())
    phrases.push_back({", " + values});
  phrases.push_back({", " + commits.dated_words()});
  if (commits.has_commits()) {
    phrases.push_back({", commits "});
    phrases.push_back(links.commits(commits));
  } else if (!commits.since.commit.empty() && commits.since.commit == commits.before.commit) {
    phrases.push_back({", commit "});
    phrases.push_back(links.commit(commits.since));
    phrases.push_back({" as before it"});
  }
  phrases.push_back({". "});
  for (Phrase& phrase : ways(std::move(to), std::nullopt).phrases)
    phrases.push_back(std::move(phrase));
  if (group.known) {
    phrases.push_back({" Known: "});
    phrases.push_back({group.known->text, Emphasis::kData});
  }
  return block;
}

/// Those of its groups of findings that a page shows.
std::span<const FindingGroup> shown_groups(std::span<const FindingGroup> groups) {
  return groups.first(std::min(groups.size(), kMostGroups));
}

/// Adds how many others there are and where; nothing if a page shows all.
/// @param groups  All, in order.
void add_rest(std::span<const FindingGroup> groups, NightlyLinks& links, Section& section) {
  if (groups.size() <= kMostGroups) return;
  const auto rest = groups.subspan(kMostGroups);
  Paragraph paragraph{{{fmt::format("And {} more, among ", rest.size())}}};
  std::set<std::string> studies;
  for (const FindingGroup& group : rest) {
    if (!studies.insert(group.study).second) continue;
    if (studies.size() > 1) paragraph.phrases.push_back({", "});
    paragraph.phrases.push_back(links.findings(group.study));
  }
  paragraph.phrases.push_back({"."});
  section.blocks.emplace_back(std::move(paragraph));
}

/// Figures of the index: its reader sees the course at a glance, the trends have all.
constexpr std::size_t kMostOnIndex = 2;

FigureBlock block_of(const Figure& figure) {
  return {figure.id, figure.title, figure.caption, figure.alt, figure.record_ids};
}

Gallery gallery_of(const std::vector<Figure>& figures) {
  Gallery gallery;
  for (const Figure& figure : figures) gallery.figures.push_back(block_of(figure));
  return gallery;
}

/// Which nightly runs the page shows.
Paragraph nightly_runs_shown(const StudyTrend& trend) {
  return {{{fmt::format(
      "{} from nightly run {} on are shown: those with the same settings as the last.",
      counted(static_cast<long long>(trend.nightly_runs.size()), "nightly run"),
      trend.nightly_runs.front().number)}}};
}

/// The last nightly run's studies in the order of their first findings, those without any last.
std::vector<const StudyTrend*> trends_by_findings(const IndexFacts& facts,
                                                  const NightlySummary& summary) {
  std::vector<const StudyTrend*> trends;
  for (const StudyTrend& trend : facts.trends) trends.push_back(&trend);
  std::ranges::stable_sort(trends, {}, [&](const StudyTrend* trend) {
    return std::ranges::find(summary.groups, trend->name, &FindingGroup::study) -
           summary.groups.begin();
  });
  return trends;
}

TrendLocation on_index(const IndexFacts& facts) {
  const bool among_others = facts.trends.size() > 1;
  return {.among_others = among_others, .most = among_others ? 1 : kMostOnIndex};
}

/// Their figures.
std::vector<Figure> course(const IndexFacts& facts, const NightlySummary& summary) {
  std::vector<Figure> figures;
  std::set<std::string> ids;
  for (const StudyTrend* trend : trends_by_findings(facts, summary))
    for (Figure& figure : trend_figures(*trend, facts.findings, facts.notes, on_index(facts)))
      if (figures.size() < kMostOnIndex && ids.insert(figure.id).second)
        figures.push_back(std::move(figure));
  return figures;
}

/// What they measured where nothing could be compared or nothing changed.
std::string measured(const IndexFacts& facts, const NightlySummary& summary) {
  std::string text;
  std::size_t count = 0;
  for (const StudyTrend* trend : trends_by_findings(facts, summary))
    for (const std::string& sentence : trend_sentences(*trend, facts.findings, on_index(facts)))
      if (++count <= kMostOnIndex) text += " " + sentence;
  return text;
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

/// "7.1 7.2": the findings of a group as commands name them.
std::string keys_of(const FindingGroup& group, int nightly_run) {
  std::string keys;
  for (const int number : group.numbers)
    keys += fmt::format("{}{}.{}", keys.empty() ? "" : " ", nightly_run, number);
  return keys;
}

bool is_on(const NightlyNote& note, const FindingGroup& group) {
  return std::ranges::find(group.numbers, note.finding) != group.numbers.end();
}

/// What got worse, what is new first; nothing if nothing did.
std::optional<Section> worse_section(const IndexFacts& facts, const NightlySummary& summary,
                                     NightlyLinks& links) {
  if (summary.groups.empty()) return std::nullopt;
  Section section{"worse", "What got worse", {}};
  for (const FindingGroup& group : shown_groups(summary.groups)) {
    const int before = group.commits.before.number, since = group.commits.since.number;
    std::vector<Phrase> to;
    if (facts.comparisons.contains(comparison_file(before, since, group.study)))
      to.push_back(links.comparison(before, since, group.study));
    to.push_back(links.trends(group.study));
    to.push_back(links.report(summary.facts.number, group.study));
    FindingBlock block = finding_block(group, std::move(to), links);
    if (!block.known) block.keys = keys_of(group, summary.facts.number);
    for (const NightlyNote& note : summary.notes)
      if (note.kind == NoteKind::kNote && is_on(note, group)) {
        block.text.phrases.push_back(
            {fmt::format(" Note on {}.{}: ", note.nightly_run, note.finding)});
        block.text.phrases.push_back({note.text, Emphasis::kData});
      }
    section.blocks.emplace_back(std::move(block));
  }
  add_rest(summary.groups, links, section);
  return section;
}

Section last_section(const IndexFacts& facts, const NightlySummary& summary, NightlyLinks& links) {
  Section last{"last", "The last nightly run", {}};
  const NightlyFacts& this_run = facts.nightly_runs.back();
  if (auto damage = reported_of(facts.lost)) last.blocks.emplace_back(std::move(*damage));
  for (const NightlyNote& note : notes_on(this_run.number, facts.notes)) {
    const bool is_with_its_finding =
        std::ranges::any_of(shown_groups(summary.groups),
                            [&](const FindingGroup& group) { return is_on(note, group); });
    if (note.kind == NoteKind::kKnown || is_with_its_finding) continue;
    std::string title = note.kind == NoteKind::kAccepted ? "Accepted" : "Note";
    if (note.finding > 0) title += fmt::format(" on {}.{}", note.nightly_run, note.finding);
    last.blocks.emplace_back(
        Callout{Callout::Tone::kNote, std::move(title), {{{note.text, Emphasis::kData}}}});
  }
  if (!facts.trends.empty())
    last.blocks.emplace_back(studies_table(facts, links));
  else if (const auto made = facts.studies.find(this_run.number); made != facts.studies.end())
    for (const std::string& study : made->second)
      last.blocks.emplace_back(Paragraph{{{study + ": ", Emphasis::kStrong},
                                          links.report(this_run.number, study),
                                          {", "},
                                          links.trends(study)}});
  Paragraph made{{{"Begun " + local_time(this_run)}}};
  if (!this_run.commit.empty()) {
    made.phrases.push_back({", commit "});
    made.phrases.push_back(links.commit(this_run));
  }
  made.phrases.push_back({". For readers of feeds: "});
  made.phrases.push_back(links.feed());
  made.phrases.push_back({"; for other pages: "});
  made.phrases.push_back(links.badge());
  made.phrases.push_back({"."});
  last.blocks.emplace_back(std::move(made));
  BulletList list;
  for (const std::string& remark : facts.remarks) list.items.push_back({{{remark + "."}}});
  if (!list.items.empty()) last.blocks.emplace_back(std::move(list));
  return last;
}

/// The command that compares two nightly runs, in which the page puts those that a reader chooses.
/// @param nightly_runs  Two or more.
Paragraph comparing_command(const std::vector<NightlyFacts>& nightly_runs) {
  const std::string store = store_word(nightly_runs.back().command);
  return {{{"Two of them are compared by "},
           {fmt::format("mapproof history {} --compare {} {}", store,
                        std::prev(nightly_runs.end(), 2)->number, nightly_runs.back().number),
            Emphasis::kCode},
           {store == kUnknownStore ? ", where STORE is the folder of the history." : "."}}};
}

Section lost_section(const LostNightlyRuns& lost, NightlyLinks& links) {
  BulletList list;
  for (const auto& [nightly_run, studies] : lost.reports)
    for (const std::string& study : studies)
      list.items.push_back({{{study + ": ", Emphasis::kStrong}, links.report(nightly_run, study)}});
  return {"lost", "Nightly runs of a damaged history", {std::move(list)}};
}

}  // namespace

NightlySummary last_summary(const IndexFacts& facts) {
  NightlySummary summary;
  if (facts.nightly_runs.empty()) return summary;
  summary.facts = facts.nightly_runs.back();
  const auto found = found_on(summary.facts.number, facts.findings);
  summary.groups = grouped(summary.facts.number, found, facts.trends, facts.notes);
  summary.trends = facts.trends;
  summary.remarks = facts.remarks;
  summary.notes = notes_on(summary.facts.number, facts.notes);
  summary.all_notes = facts.notes;
  return summary;
}

/// The first figure is that of the first screen, others are small ones.
void show_first(const std::vector<Figure>& figures, Opening& opening) {
  if (figures.empty()) return;
  opening.main_figure = figures.front().id;
  for (std::size_t i = 1; i < figures.size() && i <= kMostSmall; ++i)
    opening.figure_ids.push_back(figures[i].id);
}

/// Of what is new and got worse: the diffs of the nightly runs between which it did, and the search
/// for the first of their commits, where the command is complete; nothing if there are none.
std::optional<Paragraph> ways_to_cause(const IndexFacts& facts, const NightlySummary& summary,
                                       NightlyLinks& links) {
  Paragraph paragraph{{strong("What changed"), phrase(": ")}};
  std::set<std::string> files;
  std::string bisect;
  for (const FindingGroup& group : shown_groups(summary.groups)) {
    if (group.known) continue;
    if (bisect.empty() && group.commits.bisect_gaps().empty()) bisect = group.commits.bisect();
    const int before = group.commits.before.number, since = group.commits.since.number;
    const std::string file = comparison_file(before, since, group.study);
    if (!facts.comparisons.contains(file) || files.size() == kMostLinked ||
        !files.insert(file).second)
      continue;
    if (files.size() > 1) paragraph.phrases.push_back(phrase(", "));
    paragraph.phrases.push_back(links.comparison(before, since, group.study));
  }
  if (!bisect.empty()) {
    paragraph.phrases.push_back(
        phrase(files.empty() ? "search for the commit: " : "; search for the commit: "));
    paragraph.phrases.push_back({bisect, Emphasis::kCode});
  }
  return paragraph.phrases.size() > 2 ? std::optional(std::move(paragraph)) : std::nullopt;
}

/// Why it is the reference run, where that is known: ", the last one that passed".
const char* reason_of(const NightlyFacts& reference, const IndexFacts& facts) {
  if (reference.pinned) return ", which is pinned";
  const auto passed = std::find_if(
      std::next(facts.nightly_runs.rbegin()), facts.nightly_runs.rend(),
      [](const NightlyFacts& nightly_run) { return verdict_word(nightly_run) == "passed"; });
  return passed != facts.nightly_runs.rend() && passed->number == reference.number
             ? ", the last one that passed"
             : "";
}

/// What the last nightly run was compared with.
Paragraph compared_with(const IndexFacts& facts, NightlyLinks& links) {
  const NightlyFacts& this_run = facts.nightly_runs.back();
  const auto reference =
      std::ranges::find(facts.nightly_runs, this_run.reference.value_or(0), &NightlyFacts::number);
  if (reference == facts.nightly_runs.end()) return {{phrase(": no earlier nightly run.")}};
  Paragraph all{{phrase(": " + dated_name(*reference) + reason_of(*reference, facts) + ".")}};
  if (const CommitRange range{*reference, this_run}; !range.url().empty()) {
    all.phrases.push_back(phrase(" Commits since: "));
    all.phrases.push_back(links.commits(range));
    all.phrases.push_back(phrase("."));
  }
  return all;
}

/// What the last nightly run ran.
std::vector<Paragraph> last_findings(const IndexFacts& facts, const NightlySummary& summary,
                                     NightlyLinks& links) {
  const NightlyFacts& this_run = facts.nightly_runs.back();
  std::vector<std::string> studies;
  std::vector<Phrase> to;
  for (const StudyTrend& trend : facts.trends)
    if (trend.nightly_runs.back().number == this_run.number) {
      studies.push_back(trend.name);
      to.push_back(links.report(this_run.number, trend.name));
      to.push_back(links.trends(trend.name));
    }
  std::vector<Paragraph> findings = {
      {{strong("Last"), phrase(fmt::format(": {}, of {}.", dated_name(this_run),
                                           studies.empty() ? "no study that is still there"
                                                           : listed(studies, 4)))}}};
  if (auto cause = ways_to_cause(facts, summary, links)) findings.push_back(std::move(*cause));
  if (const std::string values = measured(facts, summary); !values.empty())
    findings.push_back({{strong("Measured"), phrase(":" + values)}});
  if (!to.empty() && to.size() <= kMostLinked)
    findings.push_back(ways(std::move(to), std::nullopt));
  return findings;
}

HistoryPage trend_page(const StudyTrend& trend, const NightlyFindings& findings, bool is_compared,
                       const HistoryFolders& folders, std::span<const NightlyNote> notes) {
  HistoryPage page;
  NightlyLinks links(folders);
  page.figures = trend_figures(trend, findings, notes);
  page.report.title = trend.name + ", by nightly run";
  const NightlyFacts& this_run = trend.nightly_runs.back();
  page.report.subtitle =
      fmt::format("Nightly runs {} to {}, the last one: {}", trend.nightly_runs.front().number,
                  this_run.number, dated_name(this_run));
  const std::vector<FindingGroup> groups =
      grouped(this_run.number, found_on(this_run.number, findings), std::span(&trend, 1), notes);
  page.report.opening.standing = study_standing(this_run, groups, trend.name, is_compared, links);
  std::optional<Phrase> reference;
  if (is_compared && this_run.reference) reference = links.report(*this_run.reference, trend.name);
  page.report.opening.findings.push_back(
      ways({links.index(), links.report(this_run.number, trend.name)}, reference));
  Section trends{"trends", "Trends", {}};
  if (!page.figures.empty()) trends.blocks.emplace_back(gallery_of(page.figures));
  BulletList values;
  for (std::string& sentence : trend_sentences(trend, findings))
    values.items.push_back({{{std::move(sentence)}}});
  if (!values.items.empty()) trends.blocks.emplace_back(std::move(values));
  trends.blocks.emplace_back(nightly_runs_shown(trend));
  page.report.sections.push_back(std::move(trends));
  page.report.sections.push_back(
      {"values", "Values", {accuracy_table(trend, found_on(this_run.number, findings))}});
  if (Table found = findings_table(findings, trend.name); !found.rows.empty())
    page.report.sections.push_back({"findings", "Findings", {std::move(found)}});
  show_first(page.figures, page.report.opening);
  page.link_words = links.words();
  return page;
}

HistoryPage index_page(const IndexFacts& facts, const HistoryFolders& folders) {
  HistoryPage page;
  Report& report = page.report;
  report.title = "Nightly runs";
  report.footer = fmt::format("Made by mapproof {} ({}).", version(), source_commit());
  if (facts.nightly_runs.empty()) {
    report.sections.push_back(
        {"last", "The last nightly run", {Paragraph{{{"No nightly run was recorded yet."}}}}});
    return page;
  }
  NightlyLinks links(folders);
  const NightlyFacts& this_run = facts.nightly_runs.back();
  report.subtitle =
      fmt::format("{}, the last begun {}",
                  counted(static_cast<long long>(facts.nightly_runs.size()), "nightly run"),
                  local_time(this_run));
  const NightlySummary summary = last_summary(facts);
  report.opening.standing = nightly_standing(summary, links);
  if (auto worse = worse_section(facts, summary, links))
    report.sections.push_back(std::move(*worse));
  report.sections.push_back(last_section(facts, summary, links));
  page.figures = course(facts, summary);
  report.opening.findings = last_findings(facts, summary, links);
  report.opening.compared_with = compared_with(facts, links);
  show_first(page.figures, report.opening);
  if (!page.figures.empty()) {
    report.sections.push_back(
        {"course",
         facts.nightly_runs.size() < 2 ? "What was measured" : "Trends over the nightly runs",
         {gallery_of(page.figures)}});
  }
  Section all{"nightly-runs", "All nightly runs", {nightly_runs_table(facts, links)}};
  if (facts.nightly_runs.size() > 1) all.blocks.emplace_back(comparing_command(facts.nightly_runs));
  report.sections.push_back(std::move(all));
  if (!facts.lost.reports.empty()) report.sections.push_back(lost_section(facts.lost, links));
  page.link_words = links.words();
  return page;
}

namespace {

/// What got worse of a study, at the head of its report.
Section worse_of_study(const StudyOfNightlyRun& study, NightlyLinks& links) {
  Section section{"worse", "What got worse", {}};
  std::vector<FindingGroup> of_study;
  std::ranges::copy_if(study.groups, std::back_inserter(of_study),
                       [&](const FindingGroup& group) { return group.study == study.name; });
  for (const FindingGroup& group : shown_groups(of_study)) {
    std::vector<Phrase> to;
    const int before = group.commits.before.number, since = group.commits.since.number;
    if (study.comparisons.contains(comparison_file(before, since, group.study)))
      to.push_back(links.comparison(before, since, group.study));
    to.push_back(links.trends(group.study));
    section.blocks.emplace_back(finding_block(group, std::move(to), links));
  }
  add_rest(of_study, links, section);
  return section;
}

/// Puts what got worse before everything else: its section, then in each study of the report the
/// sections that show it.
void put_regressed_first(Report& report, Section worse) {
  std::vector<Section>& sections = report.sections;
  for (auto begin = sections.begin(); begin != sections.end();) {
    const auto end = std::find_if(begin, sections.end(), [&](const Section& section) {
      return section.group != begin->group;
    });
    std::stable_partition(begin, end, shows_regression);
    begin = end;
  }
  if (!worse.blocks.empty()) sections.insert(sections.begin(), std::move(worse));
}

/// Makes the figure of the study's first group of findings that a figure shows the one of the first
/// screen; the one that was is a small one.
void show_regressed(Report& report, std::span<const FindingGroup> groups,
                    const std::string& study) {
  Opening& opening = report.opening;
  const auto all = figures(report);
  const auto main_figure = std::ranges::find(all, opening.main_figure, &FigureBlock::id);
  auto worse = all.end();
  for (const FindingGroup& group : groups) {
    if (group.study != study) continue;
    const auto is_worse = [&](const FigureBlock* figure) {
      return figure->regressed.find(group.headline()) != std::string::npos;
    };
    if (main_figure != all.end() && is_worse(*main_figure)) return;
    worse = std::ranges::find_if(all, is_worse);
    if (worse != all.end()) break;
  }
  if (worse == all.end()) return;
  std::erase(opening.figure_ids, (*worse)->id);
  if (!opening.main_figure.empty())
    opening.figure_ids.insert(opening.figure_ids.begin(), opening.main_figure);
  opening.main_figure = (*worse)->id;
  if (opening.figure_ids.size() > kMostSmall) opening.figure_ids.resize(kMostSmall);
}

}  // namespace

void add_nightly_run(Report& report, const StudyOfNightlyRun& study, NightlyLinks& links) {
  const NightlyRun& nightly_run = study.nightly_run;
  const LostNightlyRuns& lost = study.lost;
  Opening& opening = report.opening;
  report.subtitle +=
      fmt::format("{}{}", report.subtitle.empty() ? "" : "; ", dated_name(nightly_run.facts));
  opening.standing =
      study_standing(nightly_run.facts, study.groups, study.name, study.is_compared, links);
  mark_regressed(report, study.figures, study.groups, study.name);
  show_regressed(report, study.groups, study.name);
  put_regressed_first(report, worse_of_study(study, links));
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
