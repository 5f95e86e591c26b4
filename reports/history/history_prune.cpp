#include "reports/history/history_prune.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "reports/history/store/object_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// The number of "NAME=NUMBER", from 1 on.
std::optional<int> number_of(std::string_view part, std::string_view name) {
  if (!part.starts_with(name)) return std::nullopt;
  part.remove_prefix(name.size());
  int value = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
  if (error != std::errc() || end != part.data() + part.size() || value < 1) return std::nullopt;
  return value;
}

}  // namespace

PruneRule parse_prune_rule(const std::string& text) {
  const std::size_t comma = text.find(',');
  const std::string_view all = text;
  const auto last = number_of(all.substr(0, comma), "last=");
  const auto every = comma == std::string::npos ? std::optional<int>(0)
                                                : number_of(all.substr(comma + 1), "every=");
  if (!last || !every)
    throw InvalidInput("\"" + printable(text) +
                       "\" is not a rule; there is last=N and last=N,every=K");
  return {*last, *every};
}

std::vector<int> nightly_runs_to_remove(std::span<const NightlyFacts> nightly_runs,
                                        const PruneRule& rule) {
  std::set<int> kept;
  for (std::size_t i = 0; i < nightly_runs.size(); ++i) {
    const bool is_last = nightly_runs.size() - i <= static_cast<std::size_t>(rule.last);
    const bool is_every = rule.every > 0 && nightly_runs[i].number % rule.every == 0;
    if (is_last || is_every || nightly_runs[i].pinned) kept.insert(nightly_runs[i].number);
  }
  for (const NightlyFacts& nightly_run : nightly_runs)
    if (kept.contains(nightly_run.number) && nightly_run.reference)
      kept.insert(*nightly_run.reference);
  std::vector<int> removed;
  for (const NightlyFacts& nightly_run : nightly_runs)
    if (!kept.contains(nightly_run.number)) removed.push_back(nightly_run.number);
  return removed;
}

fs::path nightly_folder(const fs::path& store, int nightly_run) {
  return store / "nightly_runs" / fmt::format("{:04}", nightly_run);
}

Pruned prune(HistoryStore& history, const fs::path& store, const PruneRule& rule) {
  Pruned pruned;
  pruned.nightly_runs = nightly_runs_to_remove(history.nightly_runs(), rule);
  for (const int nightly_run : pruned.nightly_runs) {
    std::error_code error;
    fs::remove_all(nightly_folder(store, nightly_run), error);
    if (error)
      throw IoError(nightly_folder(store, nightly_run).string(),
                    "cannot be removed: " + error.message());
  }
  history.remove(pruned.nightly_runs);
  pruned.files = ObjectFolder(store / "objects").remove_others(history.digests());
  history.compact();
  return pruned;
}

}  // namespace mapproof
