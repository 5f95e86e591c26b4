#include "reports/sections/wording.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "core/base/text/words.hpp"
#include "reports/model/format.hpp"

namespace mapproof {

std::string title_of(Sensor sensor) { return capitalised(std::string(name(sensor))); }

std::string_view meaning(StatusCode code) {
  switch (code) {
    case StatusCode::kBridged:
      return "The neighbour graph was in pieces; the shortest bridges joined them.";
    case StatusCode::kNotConverged:
      return "The limit of iterations came before the stop rule.";
    case StatusCode::kUncertified:
      return "The optimality of the solution of a semidefinite program was not certified.";
    case StatusCode::kRankDeficient:
      return "The data have fewer than two dimensions: the map is flat or a point.";
    case StatusCode::kUndetermined:
      return "Other maps fit equally well: which of them came out is arbitrary.";
    case StatusCode::kArbitraryNeighbours:
      return "Some landmarks have fewer than K others ever seen together with them: the rest of "
             "their neighbours are arbitrary.";
    case StatusCode::kLandmarkUnseen:
      return "Some landmarks were never observed; they are missing from the map.";
    case StatusCode::kDistancesCompleted:
      return "Pairs without a common step took the shortest path over the others.";
    case StatusCode::kNotEuclidean:
      return "No points have the observed distances, as with missing entries; the nearest that "
             "some have were taken.";
    case StatusCode::kAnchorsMissing:
      return "Too few anchors were mapped for an affine map: there is no score.";
    case StatusCode::kAnchorsDegenerate:
      return "The anchors lie nearly on one line in the embedding: the affine map is arbitrary.";
    case StatusCode::kDegenerateGeometry:
      return "Known landmarks or path lie in a special position, e.g. on one line or circle.";
    case StatusCode::kTooFewObservations:
      return "There are fewer steps, landmarks or measurements than the method needs.";
    case StatusCode::kLeftOut:
      return "The method gives no position to some landmarks: they are missing from the map.";
    case StatusCode::kFailed:
      return "No map came out.";
  }
  return "";
}

std::string code_words(std::string code) {
  constexpr std::string_view kName = "euclidean";
  std::ranges::replace(code, '_', ' ');
  if (const std::size_t at = code.find(kName); at != std::string::npos) code[at] = 'E';
  return code;
}

std::string words_of(StatusCode code) { return code_words(std::string(name(code))); }

std::string paper_number(std::string_view id) {
  const auto with = [&](std::string_view prefix, std::string_view word) {
    return id.starts_with(prefix) ? fmt::format("{} {}", word, id.substr(prefix.size())) : "";
  };
  const std::string figure = with("fig-", "Fig.");
  return figure.empty() ? with("table-", "Table") : figure;
}

std::string bracketed(std::string_view label) {
  const std::size_t comma = label.find(", ");
  if (comma == std::string_view::npos) return std::string(label);
  return fmt::format("{} ({})", label.substr(0, comma), label.substr(comma + 2));
}

std::string done_text(long long done, long long planned, std::string_view noun) {
  return fmt::format("{} {} done", part_text(done, planned, noun),
                     done == 1 || planned == 1 ? "is" : "are");
}

std::string incomplete_text(long long done, long long planned, std::string_view noun) {
  if (done >= planned) return "";
  return done_text(done, planned, noun) + "; every number below rests on these.";
}

void fold(Table table, Section& section) {
  table.secondary = true;
  section.blocks.emplace_back(std::move(table));
}

Paragraph plain(std::string text) { return {{{std::move(text), Emphasis::kPlain}}}; }

namespace {

constexpr const char* kDigest = "Digest of the solvers";

}  // namespace

KeyValues provenance_items(const Provenance& provenance) {
  KeyValues items;
  items.items.push_back({"mapproof", {provenance.version, Emphasis::kData}});
  items.items.push_back({"Commit", {provenance.commit, Emphasis::kCode}});
  items.items.push_back({kDigest, {provenance.solver_digest, Emphasis::kCode}});
  std::string libraries;
  for (const auto& [library, version] : provenance.libraries)
    libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", library, version);
  for (const MethodFiles& files : provenance.method_files)
    items.items.push_back(
        {"Digest of the files of " + files.method, {files.sha256, Emphasis::kCode}});
  if (!libraries.empty()) items.items.push_back({"Built with", {libraries, Emphasis::kData}});
  return items;
}

void add_renderer(Report& report, const std::string& renderer) {
  for (Section& section : report.sections)
    for (Block& block : section.blocks) {
      auto* items = std::get_if<KeyValues>(&block);
      if (items == nullptr) continue;
      const auto digest = std::ranges::find(items->items, kDigest, &KeyValues::Item::key);
      if (digest != items->items.end())
        items->items.push_back({"Scenes drawn by", {renderer, Emphasis::kData}});
    }
}

}  // namespace mapproof
