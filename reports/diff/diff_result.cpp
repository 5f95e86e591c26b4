#include "reports/diff/diff_result.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/text/words.hpp"

namespace mapproof {

namespace {

/// "VTK 9.1, llvmpipe 15.0 → 15.1": the common beginning appears once.
std::string change_of_words(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty())
    return fmt::format("{} \u2192 {}", a.empty() ? "unknown" : a, b.empty() ? "unknown" : b);
  std::size_t shared = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()) && a[i] == b[i]; ++i)
    if (a[i] == ' ') shared = i + 1;
  return fmt::format("{} \u2192 {}", a, b.substr(shared));
}

/// "Cairo 1.16.0 → 1.18.0": the renderers of both, from the files or else from the studies.
std::string renderers_text(const ImageDiff& diff, const RecordContext& context) {
  if (diff.baseline_renderer != diff.current_renderer)
    return "drawn by " + change_of_words(diff.baseline_renderer, diff.current_renderer);
  for (const RecordDiff* records : context.records)
    for (const SettingChange& change : records->provenance)
      for (const char* library : {"Cairo", "FreeType", "HarfBuzz"})
        if (change.pointer == library)
          return fmt::format("{} {} \u2192 {}", library, change.baseline, change.current);
  return diff.current_renderer.empty() ? "versions unknown"
                                       : "both drawn by " + diff.current_renderer;
}

/// Whether files and studies record that one renderer drew both. Where they record nothing, they do
/// not.
bool same_renderer(const std::vector<ImageFile>& files, const RecordContext& context) {
  for (const RecordDiff* records : context.records)
    for (const SettingChange& change : records->provenance)
      for (const char* library : {"mapproof", "Cairo", "FreeType", "HarfBuzz"})
        if (change.pointer == library) return false;
  const auto names_one = [](const ImageFile& file) { return !file.diff.current_renderer.empty(); };
  return std::ranges::any_of(files, names_one) &&
         std::ranges::all_of(files, [](const ImageFile& file) {
           return file.diff.baseline_renderer == file.diff.current_renderer;
         });
}

bool is_visible(const ImageFile& file) { return file.diff.state == ImageState::kDifferent; }

/// Whether an SVG shows changed styles: colours, texts or elements; or changed positions, where the
/// renderer is the same.
bool changes_style(const ImageFile& file, bool same_renderer) {
  if (!file.diff.svg || !is_visible(file)) return false;
  const SvgDiff& svg = *file.diff.svg;
  return same_renderer || svg.style + svg.text + svg.structure > 0;
}

/// The first change of an SVG that moves a mark, an element with an id, where the panels did not
/// move: their clip paths. A style may move the panels with all that they hold. Null: none.
const SvgChange* moved_mark(const ImageFile& file) {
  if (!file.diff.svg || !is_visible(file)) return nullptr;
  const auto& changes = file.diff.svg->changes;
  const auto is_panel = [](const SvgChange& change) {
    return change.element.find("clipPath") != std::string::npos;
  };
  if (std::ranges::any_of(changes, is_panel)) return nullptr;
  const auto found = std::ranges::find_if(changes, [](const SvgChange& change) {
    return change.kind == SvgChangeKind::kGeometry && !change.tolerated &&
           change.element.find('#', change.element.rfind('/')) != std::string::npos &&
           change.element.find("/defs[") == std::string::npos;
  });
  return found == changes.end() ? nullptr : &*found;
}

const ImageFile* first_with(const std::vector<ImageFile>& files, auto holds) {
  const auto found = std::ranges::find_if(files, holds);
  return found == files.end() ? nullptr : &*found;
}

/// The judgement of files that exist on only one side or cannot be read.
std::optional<Judgement> judge_presence(const std::vector<ImageFile>& files) {
  const auto there = [](const ImageFile& f) { return !f.baseline.empty() && !f.current.empty(); };
  if (const ImageFile* bad = first_with(files, [&](const ImageFile& f) {
        return there(f) && f.diff.state == ImageState::kUnreadable;
      }))
    return Judgement{Verdict::kUnreadable, true, bad->format + ": " + bad->diff.reason};
  if (const ImageFile* gone =
          first_with(files, [](const ImageFile& f) { return f.current.empty(); }))
    return Judgement{Verdict::kMissing, true, "its " + gone->format + " is missing"};
  if (const ImageFile* added =
          first_with(files, [](const ImageFile& f) { return f.baseline.empty(); }))
    return Judgement{Verdict::kNew, true, "its " + added->format + " is not in the baseline"};
  return std::nullopt;
}

/// The reasons of the visible differences: first of SVGs, which name what changed, then of the
/// other formats, which give the amount.
std::string words_alone(const std::vector<ImageFile>& files) {
  std::string words;
  for (const bool is_svg : {true, false})
    for (const ImageFile& file : files) {
      if (!is_visible(file) || (file.format == "svg") != is_svg) continue;
      if (words.empty())
        words = fmt::format("{}, by its {} alone: {}", file.format, is_svg ? "elements" : "pixels",
                            file.diff.reason);
      else
        words += fmt::format("; {}: {}", file.format, file.diff.reason);
    }
  return words;
}

/// Judges images without a value.
Judgement judge_alone(const std::vector<ImageFile>& files) {
  if (std::ranges::any_of(files, is_visible)) return {Verdict::kChanged, true, words_alone(files)};
  if (const ImageFile* near = first_with(
          files, [](const ImageFile& f) { return f.diff.state == ImageState::kWithinTolerance; }))
    return {Verdict::kWithinTolerance, false, near->format + ": " + near->diff.reason};
  return {};
}

/// Judges images whose figure's value is equal or within tolerance.
Judgement judge_drawing(const Judgement& value, const std::vector<ImageFile>& files,
                        const RecordContext& context) {
  const char* equal = value.verdict == Verdict::kIdentical ? "equal" : "equal within tolerance";
  for (const ImageFile& file : files)
    if (const SvgChange* moved = moved_mark(file))
      return {
          Verdict::kChanged, true,
          fmt::format("the figure's value is {}, its {} does not show it: {}; {}: {} {} \u2192 {}",
                      equal, file.format, file.diff.reason, moved->element, moved->what,
                      moved->baseline, moved->current)};
  const bool same = same_renderer(files, context);
  if (const ImageFile* style =
          first_with(files, [&](const ImageFile& file) { return changes_style(file, same); })) {
    const SvgChange* first =
        style->diff.svg->changes.empty() ? nullptr : &style->diff.svg->changes[0];
    return {
        Verdict::kStyle, true,
        fmt::format("the figure's value is {}, its styles differ: {}{}", equal, style->diff.reason,
                    first ? fmt::format("; {}: {} {} \u2192 {}", first->element, first->what,
                                        first->baseline, first->current)
                          : "")};
  }
  const ImageFile* file = first_with(files, is_visible);
  const bool visible = file != nullptr;
  if (!visible)
    file = first_with(
        files, [](const ImageFile& f) { return f.diff.state == ImageState::kWithinTolerance; });
  if (file == nullptr) return {};
  if (visible && same)
    return {Verdict::kChanged, true,
            fmt::format("the figure's value is {}, its {} shows something else: {}; {}", equal,
                        file->format, file->diff.reason, renderers_text(file->diff, context))};
  Judgement judgement{
      Verdict::kRenderer, visible,
      fmt::format("the figure's value is {}, its {} is rendered differently: {}; {}", equal,
                  file->format, file->diff.reason, renderers_text(file->diff, context))};
  if (file->diff.baseline_renderer != file->diff.current_renderer)
    judgement.shared_cause = renderers_text(file->diff, context);
  return judgement;
}

}  // namespace

std::string_view name(ItemKind kind) {
  switch (kind) {
    case ItemKind::kRecords:
      return "records";
    case ItemKind::kFigure:
      return "figure";
    case ItemKind::kImage:
      return "image";
    case ItemKind::kDocument:
      return "document";
  }
  return "";
}

std::vector<int> counts_of(const DiffResult& result) {
  std::vector<int> counts(kVerdicts.size(), 0);
  for (const DiffItem& item : result.items)
    ++counts[static_cast<std::size_t>(item.judgement.verdict)];
  return counts;
}

std::string counts_text(const DiffResult& result) {
  const std::vector<int> counts = counts_of(result);
  std::string text;
  for (std::size_t v = kVerdicts.size(); v-- > 0;)
    if (counts[v] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[v], label(kVerdicts[v]));
  return text;
}

std::string counts_and_first(const DiffResult& result) {
  const auto first = std::ranges::find_if(result.items, [](const DiffItem& item) {
    return item.judgement.verdict != Verdict::kIdentical;
  });
  const std::string counts = counts_text(result);
  return first == result.items.end() ? counts : counts + ". The first is " + first->id;
}

std::vector<std::string> version_changes(const DiffResult& result) {
  std::vector<std::string> changes;
  for (const DiffItem& item : result.items) {
    if (!item.records) continue;
    for (const SettingChange& change : item.records->provenance) {
      const auto shown = [](const std::string& text) { return text.empty() ? "none" : text; };
      std::string text = fmt::format("{} {} \u2192 {}", change.pointer, shown(change.baseline),
                                     shown(change.current));
      if (std::ranges::find(changes, text) == changes.end()) changes.push_back(std::move(text));
    }
  }
  return changes;
}

Judgement judge_images(const Judgement& value, bool has_value, const std::vector<ImageFile>& images,
                       const RecordContext& context) {
  if (const auto presence = judge_presence(images)) {
    const Verdict verdict = heavier(presence->verdict, value.verdict);
    return verdict == presence->verdict ? *presence : value;
  }
  if (!has_value) return judge_alone(images);
  if (value.verdict > Verdict::kWithinTolerance && value.visible) {
    Judgement reported = value;
    const bool unmoved = !images.empty() && std::ranges::all_of(images, [](const ImageFile& file) {
      return file.diff.state == ImageState::kIdentical;
    });
    if (unmoved) reported.cause += "; its images are the same: they do not show this value";
    return reported;
  }
  const Judgement drawing = judge_drawing(value, images, context);
  // An invisible difference does not replace a difference of the value.
  const bool says_more = value.verdict == Verdict::kIdentical || drawing.visible;
  return says_more && drawing.verdict > value.verdict ? drawing : value;
}

}  // namespace mapproof
