#include "app/nightly/nightly_outputs.hpp"

#include <unistd.h>

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "core/base/child_process.hpp"
#include "core/base/files/descriptor.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "reports/diff/folder_diff.hpp"
#include "reports/diff/records/record_diff.hpp"
#include "reports/history/nightly_standing.hpp"
#include "reports/history/pages/nightly_links.hpp"
#include "reports/html/diff/diff_html.hpp"
#include "reports/html/diff/shown_images.hpp"

namespace mapproof {

void write_summaries(const NightlySummary& summary, const NightlyWishes& wishes,
                     const Disclosure& disclosure) {
  if (!wishes.markdown.empty())
    write_file(wishes.markdown, disclosure.text(nightly_markdown(summary)));
  if (!wishes.junit.empty()) write_file(wishes.junit, disclosure.text(nightly_junit(summary)));
}

void run_on_worse(const NightlySummary& summary, const NightlyWishes& wishes,
                  const std::filesystem::path& index, const Console& console) {
  if (wishes.on_worse.empty() || summary.new_findings() == 0) return;
  ProgramCall call{.program = "/usr/bin/env",
                   .arguments = {fmt::format("MAPPROOF_NIGHTLY_RUN={}", summary.facts.number),
                                 fmt::format("MAPPROOF_VERDICT={}", name(summary.verdict())),
                                 "MAPPROOF_TITLE=" + summary.title(),
                                 "MAPPROOF_PAGE=" + index.string()}};
  if (const CommitRange& commits = summary.groups.front().commits; commits.has_commits())
    call.arguments.push_back("MAPPROOF_COMMITS=" + commits.text());
  for (const char* word : {"/bin/sh", "-c"}) call.arguments.emplace_back(word);
  call.arguments.push_back(wishes.on_worse);
  try {
    const Descriptor input = memory_file("mapproof-on-worse");
    if (!write_all(input, nightly_markdown(summary)) || ::lseek(input.get(), 0, SEEK_SET) != 0)
      throw ProcessError("its standard input cannot be written");
    const ProcessEnd end =
        ChildProcess(call, {.input = input.get(), .output = STDERR_FILENO}).wait();
    if (!end.is_success()) console.warning("--on-worse: " + end.text());
  } catch (const ProcessError& error) {
    console.warning(fmt::format("--on-worse: {}", error.what()));
  }
}

namespace fs = std::filesystem;

namespace {

/// Whether records call a series so at any step: "bearing/ekf/noise-0.1" of "ekf noise=0.1".
bool is_subject_of(const std::string& subject, const SeriesId& series) {
  const std::size_t end = levels_begin(series.method);
  std::string levels = series.method.substr(end);
  std::ranges::replace(levels, '=', '-');
  std::ranges::replace(levels, ' ', '/');
  const std::string parts = subject + "/";
  return parts.starts_with(series.sensor + "/" + series.method.substr(0, end) + "/") &&
         parts.find(levels + "/") != std::string::npos;
}

/// Gives the records that findings are about the outcome of these.
void judge_found(const std::vector<FindingGroup>& groups, const std::string& study,
                 RecordDiff& records) {
  for (const FindingGroup& group : groups)
    for (const SeriesId& series : group.series)
      for (Comparison& comparison : records.comparisons)
        if (group.study == study && comparison.quantity.id == group.quantity_id &&
            comparison.beyond > 0 && is_subject_of(comparison.subject, series))
          comparison.outcome = Outcome::kWorse;
}

/// Gives a comparison the verdict of the nightly run: one rule judges a nightly run and the page
/// that shows why.
void judge_as_nightly_run(const NightlyPair& pair, const std::string& study, DiffResult& result) {
  NightlyLinks links({});
  const Standing standing = study_standing(pair.after, pair.groups, study, true, links);
  if (standing.sentences.empty()) return;
  std::string cause = standing.title + ":";
  for (const std::string& sentence : standing.sentences) cause += " " + sentence;
  if (!standing.note.empty()) cause += " " + standing.note;
  for (DiffItem& item : result.items)
    if (item.records) judge_found(pair.groups, study, *item.records);
  judge_records_as(result, {Verdict::kWorse, true, cause});
}

}  // namespace

std::vector<FindingGroup> groups_between(const IndexFacts& facts, int before, int after) {
  const auto found = facts.findings.find(after);
  const auto nightly_run = std::ranges::find(facts.nightly_runs, after, &NightlyFacts::number);
  if (found == facts.findings.end() || nightly_run == facts.nightly_runs.end()) return {};
  std::vector<FindingGroup> groups = grouped(after, found->second, facts.trends, facts.notes);
  if (nightly_run->reference != before)
    std::erase_if(groups, [&](const FindingGroup& group) {
      return group.commits.before.number != before || group.commits.since.number != after;
    });
  return groups;
}

std::vector<std::string> write_comparisons(const NightlyPair& pair, const HistoryOutputs& outputs) {
  std::vector<std::string> written;
  const auto folder = [&](int number, const std::string& study) {
    return outputs.store / "nightly_runs" / fmt::format("{:04}", number) / study;
  };
  for (const std::string& study : pair.studies) {
    const fs::path before = folder(pair.before.number, study),
                   after = folder(pair.after.number, study);
    std::error_code error;
    if (!fs::exists(before / "study.json", error) || !fs::exists(after / "study.json", error))
      continue;
    DiffSettings settings;
    settings.heat_map_bytes = kPageBytes;
    DiffResult result = folder_diff(before, after, settings);
    result.baseline_title = dated_name(pair.before);
    result.current_title = dated_name(pair.after);
    judge_as_nightly_run(pair, study, result);
    const std::string file = comparison_file(pair.before.number, pair.after.number, study);
    make_folder((outputs.out / file).parent_path());
    OutputFolder(outputs.out)
        .write(file, outputs.disclosure.text(
                         diff_html(result, shown_images(result, settings), outputs.page)));
    written.push_back(file);
  }
  return written;
}

}  // namespace mapproof
