#include "reports/history/history_prune.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "reports/history/object_folder.hpp"

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

std::vector<int> nights_to_remove(std::span<const NightFacts> nights, const PruneRule& rule) {
  std::set<int> kept;
  for (std::size_t i = 0; i < nights.size(); ++i) {
    const bool is_last = nights.size() - i <= static_cast<std::size_t>(rule.last);
    const bool is_every = rule.every > 0 && nights[i].number % rule.every == 0;
    if (is_last || is_every || nights[i].pinned) kept.insert(nights[i].number);
  }
  for (const NightFacts& night : nights)
    if (kept.contains(night.number) && night.reference) kept.insert(*night.reference);
  std::vector<int> removed;
  for (const NightFacts& night : nights)
    if (!kept.contains(night.number)) removed.push_back(night.number);
  return removed;
}

fs::path night_folder(const fs::path& store, int night) {
  return store / "nights" / fmt::format("{:04}", night);
}

Pruned prune(HistoryStore& history, const fs::path& store, const PruneRule& rule) {
  Pruned pruned;
  pruned.nights = nights_to_remove(history.nights(), rule);
  for (const int night : pruned.nights) {
    std::error_code error;
    fs::remove_all(night_folder(store, night), error);
    if (error)
      throw IoError(night_folder(store, night).string(), "cannot be removed: " + error.message());
  }
  history.remove(pruned.nights);
  pruned.files = ObjectFolder(store / "objects").remove_others(history.digests());
  history.compact();
  return pruned;
}

}  // namespace mapproof
