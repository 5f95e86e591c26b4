#include "reports/history/nightly_feed.hpp"

#include <fmt/format.h>

#include "core/base/sha256.hpp"
#include "core/base/text/percent.hpp"
#include "core/base/text/unit_text.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

/// A name-based UUID of what an entry is about: it stays the same however often the feed is written.
std::string entry_identifier(const std::string& identifier, const NightlyFacts& facts) {
  const std::string hash =
      sha256_hex(fmt::format("{} {} {}", identifier, facts.number, facts.started_utc));
  return fmt::format("urn:uuid:{}-{}-8{}-a{}-{}", hash.substr(0, 8), hash.substr(8, 4),
                     hash.substr(13, 3), hash.substr(17, 3), hash.substr(20, 12));
}

std::string content_of(const NightlySummary& summary) {
  std::string text;
  for (const FindingGroup& group : summary.groups) {
    text += fmt::format("{}: {}, since nightly run {}", group.study, group.headline(),
                        group.commits.since.number);
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
  for (const NightlySummary& summary : facts.summaries)
    entries += entry_of(summary, facts);
  const std::string updated = facts.summaries.empty() ? "1970-01-01T00:00:00Z"
                              : facts.summaries.front().facts.ended_utc;
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<feed xmlns=\"http://www.w3.org/2005/Atom\">\n"
      "  <title>Nightly runs</title>\n  <id>{}</id>\n  <updated>{}</updated>\n"
      "  <author><name>mapproof</name></author>\n"
      "  <link rel=\"self\" href=\"feed.xml\"/>\n  <link href=\"index.html\"/>\n{}</feed>\n",
      xml_line(facts.identifier), xml_line(updated), entries);
}

}  // namespace mapproof
