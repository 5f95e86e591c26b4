#include "reports/history/nightly_summary.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/sha256.hpp"
#include "core/base/text/percent.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "core/json/json_text.hpp"
#include "reports/history/shown_names.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLongestText = 2000;  ///< Characters of a sentence.

std::string text_of(const std::string& text) { return markdown_text(text, kLongestText); }

/// A link whose words are a text of ours.
std::string linked(const std::string& words, const std::string& url) {
  return url.empty() ? words : fmt::format("[{}]({})", words, url);
}

std::string markdown_item(const FindingGroup& group) {
  std::string item = fmt::format("- **{}**, {}", text_of(group.headline()), text_of(group.study));
  if (!group.setup.empty()) item += fmt::format(", {}", text_of(group.setup));
  if (const std::string count = group.count_text(); !count.empty()) item += ", " + count;
  item += ", " + text_of(group.commits.dated_words());
  if (group.commits.has_commits())
    item += ", commits " + linked("`" + group.commits.text() + "`", group.commits.url());
  if (group.known) item += ": known, " + text_of(group.known->text);
  item += "\n";
  // A command as it stands, which no fence of Markdown ends.
  if (const std::string bisect = group.commits.bisect(); !group.known && !bisect.empty()) {
    if (const std::string gaps = group.commits.bisect_gaps(); !gaps.empty())
      item += "\n  " + gaps + "\n";
    item += "\n  <pre>" + html_escaped(printable(bisect, kLongestText)) + "</pre>\n";
  }
  return item;
}

/// A test case of a study.
struct Case {
  std::string name;
  const FindingGroup* group = nullptr;  ///< That is about it.
};

/// The judged methods of a study with what is worse of them, then what else is worse.
std::vector<Case> cases_of(const StudyTrend& trend, const std::vector<FindingGroup>& groups) {
  std::map<std::string, Case> cases;
  for (const auto& [id, values] : trend.medians) {
    const NightlyRule rule = rule_of(id, trend.quantities, trend.medians);
    if (!is_accuracy(rule) && rule != NightlyRule::kDuration) continue;
    const Quantity& quantity = trend.quantities.at(id.quantity);
    Case one{shown_method_of(trend.labels, id) + ": " + quantity.label};
    const std::string line = shown_method(trend.labels, id.method);
    for (const FindingGroup& group : groups)
      if (group.study == trend.name && group.quantity_id == id.quantity &&
          group.setup == shown_setup(trend.labels, id.sensor) &&
          std::ranges::find(group.lines, line) != group.lines.end())
        one.group = &group;
    cases[one.name] = one;
  }
  std::vector<Case> all;
  std::set<const FindingGroup*> placed;
  for (const auto& [name, one] : cases) {
    all.push_back(one);
    placed.insert(one.group);
  }
  for (const FindingGroup& group : groups)
    if (group.study == trend.name && !placed.contains(&group))
      all.push_back({group.method + ": " + group.quantity, &group});
  return all;
}

std::string case_xml(const Case& one, const std::string& study) {
  const std::string head = fmt::format("    <testcase classname=\"{}\" name=\"{}\"",
                                       xml_line(study), xml_line(one.name));
  if (one.group == nullptr) return head + "/>\n";
  if (one.group->known)
    return fmt::format("{}>\n      <skipped message=\"{}\"/>\n    </testcase>\n", head,
                       xml_line(one.group->headline() + "; known: " + one.group->known->text));
  std::string text;
  for (const std::string& sentence : one.group->sentences) text += xml_line(sentence) + "\n";
  if (one.group->commits.has_commits())
    text += fmt::format("{}\n{}\n{}", xml_line(one.group->commits.text()),
                        xml_line(one.group->commits.bisect()), one.group->commits.bisect_gaps());
  return fmt::format(
      "{}>\n      <failure message=\"{}\" type=\"{}\">{}</failure>\n    </testcase>\n", head,
      xml_line(one.group->headline()), name(one.group->rule), text);
}

const char* colour_of(NightlyVerdict verdict, bool compared) {
  if (verdict == NightlyVerdict::kPassed) return compared ? "#2e7d32" : "#616161";
  return verdict == NightlyVerdict::kCost ? "#8a5a00" : "#b3261e";
}

}  // namespace

std::size_t NightlySummary::new_findings() const { return count_findings(groups, false); }
std::size_t NightlySummary::known_findings() const { return count_findings(groups, true); }

NightlyVerdict NightlySummary::verdict() const {
  NightlyVerdict verdict = NightlyVerdict::kPassed;
  for (const FindingGroup& group : groups)
    if (!group.known) verdict = std::max(verdict, verdict_of(group.rule));
  return verdict;
}

std::string NightlySummary::title() const { return verdict_title(facts, groups); }

std::string NightlySummary::short_verdict() const {
  const std::size_t count = new_findings();
  if (count == 0) return facts.reference ? "passed" : "not compared";
  const auto is_new = [](const FindingGroup& group) { return !group.known; };
  if (std::ranges::count_if(groups, is_new) == 1) return groups.front().change_text();
  return counted(static_cast<long long>(count), "finding");
}

namespace {

/// What a finding is of, in the order in which verdicts say it.
enum class WorseKind { kAccuracy, kLostResults, kTime, kMemory };

WorseKind kind_of(const FindingGroup& group) {
  if (group.rule == HistoryRule::kLostResults) return WorseKind::kLostResults;
  if (group.quantity_id == "memory") return WorseKind::kMemory;
  const bool grew =
      (group.is_time && !group.higher_is_better) || verdict_of(group.rule) == NightlyVerdict::kCost;
  return grew ? WorseKind::kTime : WorseKind::kAccuracy;
}

std::string new_words(WorseKind kind) {
  switch (kind) {
    case WorseKind::kAccuracy:
      return "accuracy got worse";
    case WorseKind::kLostResults:
      return "results are lost";
    case WorseKind::kTime:
      return "time grew";
    default:
      return "memory grew";
  }
}

std::string known_words(WorseKind kind) {
  switch (kind) {
    case WorseKind::kAccuracy:
      return "accuracy is worse";
    case WorseKind::kLostResults:
      return "results are lost";
    case WorseKind::kTime:
      return "time is longer";
    default:
      return "memory is larger";
  }
}

/// "accuracy got worse and time grew" of what is new, "accuracy is worse" of what is known.
std::string kinds_text(std::span<const FindingGroup> groups, bool known) {
  std::set<WorseKind> kinds;
  for (const FindingGroup& group : groups)
    if (group.known.has_value() == known) kinds.insert(kind_of(group));
  std::vector<std::string> words;
  for (const WorseKind kind : kinds) words.push_back(known ? known_words(kind) : new_words(kind));
  return listed(words, words.size());
}

/// What is new, or that nothing is.
std::string new_verdict(const NightlyFacts& nightly_run, std::span<const FindingGroup> groups) {
  if (const std::size_t count = count_findings(groups, false); count > 0)
    return capitalised(kinds_text(groups, false)) + ": " +
           counted(static_cast<long long>(count), "finding");
  if (!nightly_run.reference)
    return nightly_run.number == 1
               ? "Not compared: it is the first nightly run"
               : "Not compared: no nightly run to compare with has the same settings";
  return fmt::format("Nothing {}got worse since nightly run {}",
                     count_findings(groups, true) > 0 ? "new " : "", *nightly_run.reference);
}

}  // namespace

std::string verdict_sentence(const NightlyFacts& nightly_run,
                             std::span<const FindingGroup> groups) {
  std::string text = new_verdict(nightly_run, groups);
  if (const std::size_t count = count_findings(groups, true); count > 0)
    text += fmt::format("; {} as known: {}", kinds_text(groups, true),
                        counted(static_cast<long long>(count), "finding"));
  return text + ".";
}

std::string verdict_title(const NightlyFacts& nightly_run, std::span<const FindingGroup> groups) {
  std::string sentence = lower_case(verdict_sentence(nightly_run, groups));
  sentence.pop_back();  // A title has no full stop.
  return fmt::format("Nightly run {}: {}", nightly_run.number, sentence);
}

std::string nightly_markdown(const NightlySummary& summary) {
  std::string text = fmt::format("### {}\n\n", text_of(summary.title()));
  for (const FindingGroup& group : summary.groups) text += markdown_item(group);
  if (!summary.groups.empty()) text += "\n";
  for (const NightlyNote& note : summary.notes)
    if (note.kind != NoteKind::kKnown) text += fmt::format("Note: {}\n\n", text_of(note.text));
  text += text_of(fmt::format("Begun {}", local_time(summary.facts)));
  if (!summary.facts.commit.empty())
    text += ", commit " + linked("`" + short_commit(summary.facts.commit) + "`",
                                 commit_url(summary.facts.repository, summary.facts.commit));
  if (summary.facts.reference)
    text += fmt::format(", compared with nightly run {}", *summary.facts.reference);
  text += ".\n";
  for (const std::string& remark : summary.remarks) text += "\n(" + text_of(remark) + ")\n";
  return text;
}

std::string nightly_junit(const NightlySummary& summary) {
  std::string suites;
  int all_tests = 0, all_failures = 0;
  for (const StudyTrend& trend : summary.trends) {
    std::string cases;
    int failures = 0, skipped = 0, tests = 0;
    for (const Case& one : cases_of(trend, summary.groups)) {
      cases += case_xml(one, trend.name);
      ++tests;
      failures += one.group != nullptr && !one.group->known;
      skipped += one.group != nullptr && one.group->known;
    }
    suites += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" timestamp=\"{}\">\n{}"
        "  </testsuite>\n",
        xml_line(trend.name), tests, failures, skipped, xml_line(summary.facts.started_utc), cases);
    all_tests += tests;
    all_failures += failures;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"{}\" tests=\"{}\" "
      "failures=\"{}\">\n{}</testsuites>\n",
      xml_line(summary.title()), all_tests, all_failures, suites);
}

std::string nightly_badge(const NightlySummary& summary) {
  constexpr int kLabelWidth = 50, kMargin = 16;
  constexpr double kCharacter = 6.7;  // Of Verdana at 11 pixels, on the mean.
  const std::string verdict = summary.short_verdict();
  const auto characters = std::ranges::count_if(verdict, [](char c) { return (c & 0xC0) != 0x80; });
  const int width = kMargin + static_cast<int>(kCharacter * static_cast<double>(characters));
  const std::string shown = xml_line(verdict);
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"20\" role=\"img\" "
      "aria-label=\"nightly: {1}\">\n"
      "<title>nightly: {1}</title>\n"
      "<rect width=\"{2}\" height=\"20\" fill=\"#424242\"/>\n"
      "<rect x=\"{2}\" width=\"{3}\" height=\"20\" fill=\"{4}\"/>\n"
      "<g fill=\"#fff\" font-family=\"Verdana,DejaVu Sans,sans-serif\" font-size=\"11\" "
      "text-anchor=\"middle\">\n"
      "<text x=\"{5}\" y=\"14\">nightly</text>\n"
      "<text x=\"{6}\" y=\"14\">{1}</text>\n</g>\n</svg>\n",
      kLabelWidth + width, shown, kLabelWidth, width,
      colour_of(summary.verdict(), summary.facts.reference.has_value()), kLabelWidth / 2,
      kLabelWidth + width / 2);
}

std::string nightly_badge_json(const NightlySummary& summary) {
  std::string colour = colour_of(summary.verdict(), summary.facts.reference.has_value());
  return json_text({{"schemaVersion", 1},
                    {"label", "nightly"},
                    {"message", with_plain_spaces(summary.short_verdict())},
                    {"color", colour.substr(1)}});
}

namespace {

/// A name-based UUID of what an entry is about: it stays the same however often the feed is
/// written.
std::string entry_identifier(const std::string& identifier, const NightlyFacts& facts) {
  const std::string hash =
      sha256_hex(fmt::format("{} {} {}", identifier, facts.number, facts.started_utc));
  return fmt::format("urn:uuid:{}-{}-8{}-a{}-{}", hash.substr(0, 8), hash.substr(8, 4),
                     hash.substr(13, 3), hash.substr(17, 3), hash.substr(20, 12));
}

std::string content_of(const NightlySummary& summary) {
  std::string text;
  for (const FindingGroup& group : summary.groups) {
    text += fmt::format("{}: {}, {}", group.study, group.headline(), group.commits.words());
    if (group.commits.has_commits()) text += ", commits " + group.commits.text();
    if (group.known) text += "; known: " + group.known->text;
    text += ".\n";
  }
  for (const NightlyNote& note : summary.notes)
    if (note.kind != NoteKind::kKnown) text += note.text + "\n";
  for (const std::string& remark : summary.remarks) text += remark + ".\n";
  if (text.empty()) text = summary.title() + ".\n";
  return with_plain_spaces(std::move(text));
}

std::string entry_of(const NightlySummary& summary, const FeedFacts& feed) {
  const NightlyFacts& facts = summary.facts;
  const std::string ended = facts.ended_utc.empty() ? facts.started_utc : facts.ended_utc;
  return fmt::format(
      "  <entry>\n    <title>{}</title>\n    <id>{}</id>\n    <updated>{}</updated>\n"
      "    <link href=\"{}nightly_runs/{:04}/\"/>\n    <content type=\"text\">{}</content>\n"
      "  </entry>\n",
      xml_line(summary.title()), entry_identifier(feed.identifier, facts), xml_line(ended),
      percent_encoded(feed.nightly_runs, [](char c) { return is_plain(c, "-._~/"); }), facts.number,
      html_escaped(content_of(summary)));
}

}  // namespace

std::string nightly_feed(const FeedFacts& facts) {
  std::string entries;
  for (const NightlySummary& summary : facts.summaries) entries += entry_of(summary, facts);
  const std::string updated =
      facts.summaries.empty() ? "1970-01-01T00:00:00Z" : facts.summaries.front().facts.ended_utc;
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<feed xmlns=\"http://www.w3.org/2005/Atom\">\n"
      "  <title>Nightly runs</title>\n  <id>{}</id>\n  <updated>{}</updated>\n"
      "  <author><name>mapproof</name></author>\n"
      "  <link rel=\"self\" href=\"feed.xml\"/>\n  <link href=\"index.html\"/>\n{}</feed>\n",
      xml_line(facts.identifier), xml_line(updated), entries);
}

}  // namespace mapproof
