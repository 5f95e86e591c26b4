#include "reports/diff/item_diff.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/text/words.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"
#include "render/plot/figure_json.hpp"
#include "render/scene/scene_json.hpp"
#include "reports/diff/diff_result.hpp"
#include "reports/diff/figures/figure_log.hpp"
#include "reports/diff/images/image_diff.hpp"
#include "reports/diff/records/numbers_in_text.hpp"

namespace mapproof {

namespace {

using ParsedJson = nlohmann::json;

constexpr std::array<std::string_view, 8> kData = {"points", "from",   "to",     "at",
                                                   "values", "levels", "limits", "triangles"};
constexpr std::array<std::string_view, 4> kWords = {"title", "caption", "alt", "id"};
constexpr std::size_t kMostSceneNames = 3;

/// The kind of a change under a key of a part or of the scene. Lights and rules have `from` and
/// `to` as well.
ChangeKind kind_of(std::string_view key, std::string_view location) {
  const bool is_part = location.starts_with("part ");
  if (is_part && std::ranges::find(kData, key) != kData.end()) return ChangeKind::kData;
  if (location == "scene" && std::ranges::find(kWords, key) != kWords.end())
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

  void compare(const ParsedJson& a, const ParsedJson& b, const std::string& location) {
    for (const auto& [key, value] : a.items()) {
      if (key == "schema" || key == "records") continue;
      const auto other = b.find(key);
      if (other == b.end())
        log_.change(kind_of(key, location), location, key, short_text(value), "");
      else if (key == "parts" && location == "scene")
        compare_parts(value, *other);
      else if (value.is_object() && other->is_object())
        compare(value, *other, location);
      else
        compare_value(value, *other, location, key);
    }
    // What is written only where it is set.
    for (const auto& [key, value] : b.items())
      if (!a.contains(key) && key != "schema" && key != "records")
        log_.change(kind_of(key, location), location, key, "", short_text(value));
  }

 private:
  void compare_parts(const ParsedJson& a, const ParsedJson& b) {
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
      const ParsedJson& part = i < a.size() ? a[i] : b[i];
      const std::string location = fmt::format("part {}, {}", i + 1, text_of(part.at("kind")));
      const bool both = i < a.size() && i < b.size() && a[i].at("kind") == b[i].at("kind");
      if (both)
        compare(a[i], b[i], location);
      else
        log_.change(ChangeKind::kData, location, "part",
                    i < a.size() ? text_of(a[i].at("kind")) : "",
                    i < b.size() ? text_of(b[i].at("kind")) : "");
    }
  }

  void compare_value(const ParsedJson& a, const ParsedJson& b, const std::string& location,
                     const std::string& key) {
    Difference difference;
    walk(a, b, difference);
    if (difference.within) log_.within();
    if (difference.count == 0) return;
    const std::string what =
        difference.count == 1 ? key : fmt::format("{}, {} values", key, difference.count);
    ChangeKind kind = kind_of(key, location);
    // Texts are not data, but the numbers in them are.
    if (kind == ChangeKind::kMetadata && a.is_string() && b.is_string() &&
        !same_numbers(text_of(a), text_of(b)))
      kind = ChangeKind::kData;
    log_.change(kind, location, what, difference.baseline, difference.current);
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
          distinguished(a.get<double>(), b.get<double>(), 6);
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
  return parse_json(scene_to_json(scene), file.name).tree();  // Every key is there.
}

constexpr std::size_t kMostBytes = std::size_t{1} << 28;
constexpr std::size_t kMostPdfText = 200;

std::string problem_of(std::string_view bytes) {
  if (bytes.empty()) return "is empty";
  if (!bytes.starts_with("%PDF-")) return "is not a PDF";
  const std::size_t last = bytes.find_last_not_of(" \r\n");
  return bytes.substr(0, last + 1).ends_with("%%EOF") ? "" : "is truncated";
}

/// "cairo 1.16.0 (https://cairographics.org)", as stored in the file; may be empty.
std::string producer_of(std::string_view bytes) {
  constexpr std::string_view kKey = "/Producer (";
  const std::size_t at = bytes.find(kKey);
  if (at == std::string_view::npos) return "";
  const std::string_view rest = bytes.substr(at + kKey.size());
  return printable(std::string(rest.substr(0, rest.find(" ("))), kMostPdfText);
}

/// Compares two PDFs by their bytes: the figure's value and its other images show what they
/// contain. Files that two versions of the library wrote are within tolerance; the reason names
/// both versions.
/// @throws IoError if either cannot be read.
ImageDiff pdf_diff(const std::filesystem::path& baseline, const std::filesystem::path& current) {
  const std::string before = read_input(baseline, kMostBytes);
  const std::string after = read_input(current, kMostBytes);
  ImageDiff diff;
  diff.baseline_bytes = before.size();
  diff.current_bytes = after.size();
  for (const auto& [name, bytes] :
       {std::pair("the baseline: ", &before), std::pair("the current file: ", &after)})
    if (const std::string problem = problem_of(*bytes); !problem.empty())
      diff.reason += (diff.reason.empty() ? "" : "; ") + std::string(name) + problem;
  if (!diff.reason.empty()) return diff;
  diff.baseline_renderer = producer_of(before);
  diff.current_renderer = producer_of(after);
  if (before == after) {
    diff.state = ImageState::kIdentical;
    diff.reason = "the files are equal";
  } else if (diff.baseline_renderer != diff.current_renderer) {
    diff.state = ImageState::kWithinTolerance;
    diff.reason =
        fmt::format("written by {} \u2192 {}", diff.baseline_renderer, diff.current_renderer);
  } else {
    diff.state = ImageState::kDifferent;
    diff.reason = "its bytes differ";
  }
  return diff;
}

constexpr std::size_t kLargestFigure = std::size_t{1} << 28;  // Bytes.

Figure read_figure(const std::filesystem::path& path) {
  return figure_from_json(read_input(path, kLargestFigure), path.string());
}

/// Compares images of a format that nothing here decodes: equal bytes are equal images; other
/// images cannot be compared.
ImageDiff bytes_diff(const std::string& format, const std::filesystem::path& baseline,
                     const std::filesystem::path& current) {
  const std::string before = read_input(baseline, kLargestFigure);
  const std::string after = read_input(current, kLargestFigure);
  ImageDiff diff;
  diff.baseline_bytes = before.size();
  diff.current_bytes = after.size();
  if (before == after) {
    diff.state = ImageState::kIdentical;
    diff.reason = "the files are equal";
    return diff;
  }
  diff.reason = fmt::format("images of format {} are not compared, and the bytes differ", format);
  return diff;
}

/// What the comparison of an item's images needs besides their files.
struct ImageJob {
  ImageOptions options;
  bool has_value = false;  ///< Whether both sides have the figure's value.
  HeatMapRoom* room = nullptr;
};

/// Compares both files. A file that cannot be read makes its image unreadable and stops nothing
/// else.
void compare_files(ImageFile& file, const ImageJob& job) {
  try {
    if (is_not_compared(file.format))
      file.diff = bytes_diff(file.format, file.baseline, file.current);
    else if (file.format == "pdf" && job.has_value)
      file.diff = pdf_diff(file.baseline, file.current);
    else
      compare_and_keep(file, job.options, *job.room);
  } catch (const IoError& error) {
    file.diff = {};
    file.diff.reason = error.what();
  }
}

/// Compares with the plain baseline and the other valid ones, and keeps the one that differs least.
ImageFile compare_image(const std::string& format,
                        const std::map<std::string, std::filesystem::path>& baselines,
                        const std::filesystem::path& current, const ImageJob& job) {
  ImageFile best;
  bool first = true;
  for (const auto& [key, baseline] : baselines) {
    ImageFile file{.format = format,
                   .baseline_key = key,
                   .baseline = baseline,
                   .current = current,
                   .diff = {}};
    compare_files(file, job);
    if (first || file.diff.state < best.diff.state) best = std::move(file);
    first = false;
    if (best.diff.state == ImageState::kIdentical) break;
  }
  return best;
}

/// Compares the images of both sides, format by format.
std::vector<ImageFile> compare_images(const ItemFiles& baseline, const ItemFiles& current,
                                      const ImageJob& job) {
  std::vector<ImageFile> files;
  std::set<std::string> formats;
  for (const ItemFiles* side : {&baseline, &current})
    for (const auto& [format, by_key] : side->images) formats.insert(format);
  for (const std::string& format : formats) {
    const auto before = baseline.images.find(format), after = current.images.find(format);
    if (before != baseline.images.end() && after != current.images.end())
      files.push_back(compare_image(format, before->second, after->second.begin()->second, job));
    else if (before != baseline.images.end())
      files.push_back({format, "", before->second.begin()->second, {}, {}});
    else if (after != current.images.end())
      files.push_back({format, "", {}, after->second.begin()->second, {}});
  }
  return files;
}

/// An item of one side only.
DiffItem lone_item(DiffItem item, const ItemFiles& files, bool is_new) {
  item.kind = files.figure.empty() ? ItemKind::kImage : ItemKind::kFigure;
  (is_new ? item.current_figure : item.baseline_figure) = files.figure;
  item.images = is_new ? compare_images({}, files, {}) : compare_images(files, {}, {});
  item.judgement = {is_new ? Verdict::kNew : Verdict::kMissing, true,
                    is_new ? "is not in the baseline" : "is not in the current"};
  return item;
}

std::vector<std::string> records_of(const Figure& a, const Figure& b) {
  std::vector<std::string> ids = a.record_ids;
  for (const std::string& id : b.record_ids)
    if (std::ranges::find(ids, id) == ids.end()) ids.push_back(id);
  return ids;
}

/// The images of a figure that varies follow from values that vary. The values are judged, not the
/// styles of the images.
void leave_to_value(std::vector<ImageFile>& images) {
  for (ImageFile& file : images) {
    if (file.diff.state != ImageState::kDifferent) continue;
    file.diff.state = ImageState::kWithinTolerance;
    file.diff.reason = "varies from run to run: not judged";
  }
}

bool is_scene(const std::filesystem::path& file) {
  return file.filename().string().ends_with(".scene.json");
}

void compare_scenes(DiffItem& item, const RecordContext& context, const DiffSettings& settings) {
  SceneWords words;
  try {
    item.figure = scene_diff(
        {read_input(item.baseline_figure, kLargestFigure), item.baseline_figure.string()},
        {read_input(item.current_figure, kLargestFigure), item.current_figure.string()},
        settings.figures_of(item.id), words);
  } catch (const IoError& error) {
    item.judgement = {Verdict::kUnreadable, true, error.what()};
    return;
  }
  item.judgement = judge(*item.figure);
  if (item.figure->has(ChangeKind::kData))
    item.judgement =
        tied_judgement(item.id, *item.figure, item.judgement, words.record_ids, context);
  else
    item.is_stale = item.figure->equal && is_stale(item.id, words.record_ids, context);
}

void compare_values(DiffItem& item, const RecordContext& context, const DiffSettings& settings) {
  if (is_scene(item.baseline_figure) || is_scene(item.current_figure))
    return compare_scenes(item, context, settings);
  Figure a, b;
  try {
    a = read_figure(item.baseline_figure);
    b = read_figure(item.current_figure);
  } catch (const IoError& error) {
    item.judgement = {Verdict::kUnreadable, true, error.what()};
    return;
  }
  item.figure = figure_diff(a, b, settings.figures_of(item.id));
  item.judgement = judge(*item.figure);
  if (item.figure->has(ChangeKind::kData))
    item.judgement =
        tied_judgement(item.id, *item.figure, item.judgement, records_of(a, b), context);
  else
    item.is_stale = item.figure->equal && is_stale(item.id, records_of(a, b), context);
}

/// The bytes of a PDF change with its figure's value, however small that change is.
void leave_pdf_to_value(DiffItem& item) {
  for (ImageFile& file : item.images)
    if (item.figure && !item.figure->equal && file.format == "pdf" &&
        file.diff.state == ImageState::kDifferent)
      file.diff.state = ImageState::kWithinTolerance;
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

DiffItem item_diff(const std::string& id, const ItemSides& sides, const RecordContext& context,
                   const DiffSettings& settings, HeatMapRoom& room) {
  DiffItem item;
  item.id = id;
  const ItemFiles *const baseline = sides.baseline, *const current = sides.current;
  if (baseline == nullptr || current == nullptr) {
    item =
        lone_item(std::move(item), baseline == nullptr ? *current : *baseline, baseline == nullptr);
  } else {
    item.baseline_figure = baseline->figure;
    item.current_figure = current->figure;
    const bool some = !baseline->figure.empty() || !current->figure.empty();
    const bool both = !baseline->figure.empty() && !current->figure.empty();
    item.kind = some ? ItemKind::kFigure : ItemKind::kImage;
    item.images = compare_images(*baseline, *current, {settings.images_of(id), both, &room});
    if (both) compare_values(item, context, settings);
    leave_pdf_to_value(item);
    if (item.figure && item.figure->masked > 0) leave_to_value(item.images);
    if (item.judgement.verdict != Verdict::kUnreadable)
      item.judgement = judge_images(item.judgement, both, item.images, context);
    if (some && !both)
      item.judgement = {heavier(item.judgement.verdict,
                                current->figure.empty() ? Verdict::kMissing : Verdict::kNew),
                        true,
                        current->figure.empty() ? "its figure.json is missing"
                                                : "its figure.json is not in the baseline"};
  }
  item.passes = passes(item.judgement, settings.allowed_of(id));
  return item;
}

}  // namespace mapproof
