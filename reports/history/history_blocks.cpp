#include "reports/history/history_blocks.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "reports/history/nightly_run.hpp"

namespace mapproof {

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

FindingBlock finding_block(const FindingGroup& group, std::vector<Phrase> to, NightlyLinks& links) {
  const CommitRange& commits = group.commits;
  FindingBlock block;
  block.title = group.headline();
  block.details = group.sentences;
  block.known = group.known.has_value();
  block.command = block.known ? "" : commits.bisect();
  auto& phrases = block.text.phrases;
  phrases.push_back({group.study, Emphasis::kData});
  if (!group.setup.empty()) phrases.push_back({", " + group.setup});
  if (const std::string count = group.count_text(); !count.empty())
    phrases.push_back({", " + count});
  phrases.push_back({fmt::format(", since nightly run {}", commits.since.number)});
  if (!commits.since.started_utc.empty())
    phrases.push_back({" (" + local_time(commits.since) + ")"});
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

std::span<const FindingGroup> shown_groups(std::span<const FindingGroup> groups) {
  return groups.first(std::min(groups.size(), kMostGroups));
}

void add_rest(std::size_t groups, Section& section) {
  if (groups > kMostGroups)
    section.blocks.emplace_back(Paragraph{
        {{fmt::format("And {} more, among the findings of the trends.", groups - kMostGroups)}}});
}

}  // namespace mapproof
