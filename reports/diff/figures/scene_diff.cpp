#include "reports/diff/figures/scene_diff.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "core/json/json_cursor.hpp"
#include "render/scene/scene_json.hpp"
#include "reports/diff/figures/figure_log.hpp"
#include "reports/diff/records/number_words.hpp"

namespace mapproof {
namespace {

using ParsedJson = nlohmann::json;

constexpr std::array<std::string_view, 8> kData = {"points", "from",   "to",     "at",
                                                   "values", "levels", "limits", "triangles"};
constexpr std::array<std::string_view, 4> kWords = {"title", "caption", "alt", "id"};
constexpr std::size_t kMostSceneNames = 3;

/// The kind of a change under a key of a part or of the scene. Lights and rules have `from` and
/// `to` as well.
ChangeKind kind_of(std::string_view key, std::string_view place) {
  const bool is_part = place.starts_with("part ");
  if (is_part && std::ranges::find(kData, key) != kData.end()) return ChangeKind::kData;
  if (place == "scene" && std::ranges::find(kWords, key) != kWords.end())
    return ChangeKind::kMetadata;
  return ChangeKind::kStyle;
}

std::string text_of(const ParsedJson& value) {
  return value.is_string() ? value.get<std::string>()
                           : value.dump(-1, ' ', false, ParsedJson::error_handler_t::replace);
}

class SceneComparer {
 public:
  SceneComparer(const FigureOptions& options, FigureLog& log) : options_(options), log_(log) {}

  void compare(const ParsedJson& a, const ParsedJson& b, const std::string& place) {
    for (const auto& [key, value] : a.items()) {
      if (key == "schema" || key == "records") continue;
      if (key == "parts" && place == "scene")
        compare_parts(value, b.at(key));
      else if (value.is_object())
        compare(value, b.at(key), place);
      else
        compare_value(value, b.at(key), place, key);
    }
  }

 private:
  void compare_parts(const ParsedJson& a, const ParsedJson& b) {
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      const ParsedJson& part = i < a.size() ? a[i] : b[i];
      const std::string place = fmt::format("part {}, {}", i + 1, text_of(part.at("kind")));
      const bool both = i < a.size() && i < b.size() && a[i].at("kind") == b[i].at("kind");
      if (both)
        compare(a[i], b[i], place);
      else
        log_.change(ChangeKind::kData, place, "part", i < a.size() ? text_of(a[i].at("kind")) : "",
                    i < b.size() ? text_of(b[i].at("kind")) : "");
    }
  }

  void compare_value(const ParsedJson& a, const ParsedJson& b, const std::string& place,
                     const std::string& key) {
    Difference difference;
    walk(a, b, difference);
    if (difference.within) log_.within();
    if (difference.count == 0) return;
    const std::string what =
        difference.count == 1 ? key : fmt::format("{}, {} values", key, difference.count);
    ChangeKind kind = kind_of(key, place);
    // Texts are not data, but the numbers in them are.
    if (kind == ChangeKind::kMetadata && a.is_string() && b.is_string() &&
        !same_numbers(text_of(a), text_of(b)))
      kind = ChangeKind::kData;
    log_.change(kind, place, what, difference.baseline, difference.current);
  }

  struct Difference {
    long count = 0;
    bool within = false;
    std::string baseline, current;  ///< The first values that differ.
  };

  void walk(const ParsedJson& a, const ParsedJson& b, Difference& difference) const {
    if (a == b) return;
    if (a.is_number() && b.is_number() &&
        options_.position.holds(a.get<double>(), b.get<double>())) {
      difference.within = true;
      return;
    }
    if (a.is_structured() && a.type() == b.type() && a.size() == b.size()) {
      for (auto x = a.begin(), y = b.begin(); x != a.end(); ++x, ++y) walk(*x, *y, difference);
      return;
    }
    if (difference.count++ > 0) return;
    if (a.is_number() && b.is_number()) {
      std::tie(difference.baseline, difference.current) =
          told_apart(a.get<double>(), b.get<double>(), 6);
      return;
    }
    difference.baseline = short_text(a);
    difference.current = short_text(b);
    if (difference.baseline == difference.current) difference.current += ", others";
  }

  static std::string short_text(const ParsedJson& value) {
    if (value.is_structured()) return counted(static_cast<long long>(value.size()), "value");
    return text_of(value);
  }

  const FigureOptions& options_;
  FigureLog& log_;
};

ParsedJson parse(const SceneText& file, SceneWords& words) {
  const Scene scene = scene_from_json(file.text, file.name);
  for (const std::string& id : scene.record_ids)
    if (std::ranges::find(words.record_ids, id) == words.record_ids.end())
      words.record_ids.push_back(id);
  words.varies = scene.varies;
  return parse_json(scene_to_json(scene), file.name).root;  // Every key is there.
}

}  // namespace

FigureDiff scene_diff(const SceneText& baseline, const SceneText& current,
                      const FigureOptions& options, SceneWords& words) {
  const ParsedJson a = parse(baseline, words);
  const ParsedJson b = parse(current, words);
  FigureLog log(a.value("varies", false) && b.value("varies", false));
  if (a.at("records") != b.at("records"))
    log.change(
        ChangeKind::kData, "figure", kRecordsWord,
        listed(a.at("records").get<std::vector<std::string>>(), kMostSceneNames),
        "others: " + listed(b.at("records").get<std::vector<std::string>>(), kMostSceneNames));
  SceneComparer(options, log).compare(a, b, "scene");
  return log.take();
}

}  // namespace mapproof
