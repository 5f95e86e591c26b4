#include "core/records/experiments/profiles.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

/// "it has "a", "b" and 3 more": at most five of them.
std::string known_profiles(const std::vector<std::pair<std::string, JsonCursor>>& profiles) {
  constexpr std::size_t kShown = 5;
  if (profiles.empty()) return "it has none";
  std::vector<std::string> shown;
  for (std::size_t i = 0; i < std::min(profiles.size(), kShown); ++i)
    shown.push_back(in_quotes(profiles[i].first));
  const std::string rest =
      profiles.size() > kShown ? fmt::format(" and {} more", profiles.size() - kShown) : "";
  return fmt::format("it has {}{}", fmt::join(shown, ", "), rest);
}

/// The document's profiles; an object of patches, empty if it has none.
std::vector<std::pair<std::string, JsonCursor>> profile_members(const JsonCursor& document) {
  const std::optional<JsonCursor> profiles = document.find("profiles");
  if (!profiles) return {};
  for (const auto& [key, patch] : profiles->members()) {
    if (!patch.is_object()) patch.fail("expected an object: a merge patch of the experiment");
    for (const char* fixed : {"schema", "profiles"})
      if (const auto found = patch.find(fixed)) found->fail("a profile cannot change this");
  }
  return profiles->members();
}

}  // namespace

JsonDocument parse_with_profile(std::string_view text, const std::string& source,
                                std::string_view schema, const std::string& profile) {
  JsonDocument document = parse_json(text, source);
  expect_schema(document.cursor(), schema);
  const auto members = profile_members(document.cursor());
  const auto is_it = [&](const auto& member) { return member.first == profile; };
  if (!profile.empty() && std::ranges::none_of(members, is_it))
    throw IoError(source, "/profiles",
                  "no profile " + in_quotes(profile) + ": " + known_profiles(members));
  if (!document.cursor().find("profiles")) return document;
  nlohmann::json root = document.tree();
  const nlohmann::json profiles = root.at("profiles");
  root.erase("profiles");
  if (profile.empty()) return parse_json(root.dump(), source);
  root.merge_patch(profiles.at(profile));
  return parse_json(root.dump(), fmt::format("{} with profile {}", source, printable(profile, 40)));
}

std::vector<std::string> profile_names(std::string_view text, const std::string& source,
                                       std::string_view schema) {
  const JsonDocument document = parse_json(text, source);
  expect_schema(document.cursor(), schema);
  std::vector<std::string> names;
  for (const auto& [key, patch] : profile_members(document.cursor())) names.push_back(key);
  return names;
}

}  // namespace mapproof
