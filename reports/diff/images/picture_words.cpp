#include <algorithm>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/diff/item_diff.hpp"
#include "reports/diff/svg/svg_diff.hpp"

namespace mapproof {
namespace {

/// "VTK 9.1, llvmpipe 15.0 → 15.1": words that both begin with stand once.
std::string change_of_words(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty())
    return fmt::format("{} \u2192 {}", a.empty() ? "unknown" : a, b.empty() ? "unknown" : b);
  std::size_t shared = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()) && a[i] == b[i]; ++i)
    if (a[i] == ' ') shared = i + 1;
  return fmt::format("{} \u2192 {}", a, b.substr(shared));
}

/// "Cairo 1.16.0 → 1.18.0": what drew the two, by the files or else by the studies.
std::string renderers_text(const PictureDiff& diff, const RecordContext& context) {
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

/// Whether both were drawn by the same, as far as files and studies say.
bool same_renderer(const std::vector<PictureFile>& files, const RecordContext& context) {
  for (const RecordDiff* records : context.records)
    for (const SettingChange& change : records->provenance)
      for (const char* library : {"mapproof", "Cairo", "FreeType", "HarfBuzz"})
        if (change.pointer == library) return false;
  return std::ranges::all_of(files, [](const PictureFile& file) {
    return file.diff.baseline_renderer == file.diff.current_renderer;
  });
}

/// Whether an SVG shows that styles changed: other colours, texts or elements; or other places,
/// where the same renderer laid them out.
bool changes_style(const PictureFile& file, bool same_renderer) {
  if (!file.diff.svg || file.diff.state != PictureState::kDifferent) return false;
  const SvgDiff& svg = *file.diff.svg;
  return same_renderer || svg.style + svg.text + svg.structure > 0;
}

bool is_visible(const PictureFile& file) { return file.diff.state == PictureState::kDifferent; }

const PictureFile* first_with(const std::vector<PictureFile>& files, auto holds) {
  const auto found = std::ranges::find_if(files, holds);
  return found == files.end() ? nullptr : &*found;
}

/// Of files that are there on one side alone or cannot be read.
std::optional<Judgement> judge_presence(const std::vector<PictureFile>& files) {
  const auto there = [](const PictureFile& f) { return !f.baseline.empty() && !f.current.empty(); };
  if (const PictureFile* bad = first_with(files, [&](const PictureFile& f) {
        return there(f) && f.diff.state == PictureState::kUnreadable;
      }))
    return Judgement{Verdict::kUnreadable, true, bad->format + ": " + bad->diff.reason};
  if (const PictureFile* gone =
          first_with(files, [](const PictureFile& f) { return f.current.empty(); }))
    return Judgement{Verdict::kMissing, true, "its " + gone->format + " is missing"};
  if (const PictureFile* added =
          first_with(files, [](const PictureFile& f) { return f.baseline.empty(); }))
    return Judgement{Verdict::kNew, true, "its " + added->format + " is not in the baseline"};
  return std::nullopt;
}

/// An SVG says what changed, the other kinds how much.
std::string words_alone(const std::vector<PictureFile>& files) {
  std::string words;
  for (const bool is_svg : {true, false})
    for (const PictureFile& file : files) {
      if (!is_visible(file) || (file.format == "svg") != is_svg) continue;
      if (words.empty())
        words = fmt::format("{}, by its {} alone: {}", file.format,
                            is_svg                 ? "elements"
                            : file.format == "png" ? "pixels"
                                                   : "bytes",
                            file.diff.reason);
      else
        words += fmt::format("; {}: {}", file.format, file.diff.reason);
    }
  return words;
}

/// Of pictures without a value.
Judgement judge_alone(const std::vector<PictureFile>& files) {
  if (std::ranges::any_of(files, is_visible)) return {Verdict::kChanged, true, words_alone(files)};
  if (const PictureFile* near = first_with(files, [](const PictureFile& f) {
        return f.diff.state == PictureState::kWithinTolerance;
      }))
    return {Verdict::kWithinTolerance, false, near->format + ": " + near->diff.reason};
  return {};
}

/// Of pictures whose figure's value is equal, or within tolerance.
Judgement judge_drawing(const Judgement& value, const std::vector<PictureFile>& files,
                        const RecordContext& context) {
  const char* equal = value.verdict == Verdict::kIdentical ? "equal" : "equal within tolerance";
  const bool same = same_renderer(files, context);
  if (const PictureFile* style =
          first_with(files, [&](const PictureFile& file) { return changes_style(file, same); })) {
    const SvgChange* first =
        style->diff.svg->changes.empty() ? nullptr : &style->diff.svg->changes[0];
    return {
        Verdict::kStyle, true,
        fmt::format("the figure's value is {}, its styles are not: {}{}", equal, style->diff.reason,
                    first ? fmt::format("; {}: {} {} \u2192 {}", first->element, first->what,
                                        first->baseline, first->current)
                          : "")};
  }
  const PictureFile* file = first_with(files, is_visible);
  const bool visible = file != nullptr;
  if (!visible)
    file = first_with(
        files, [](const PictureFile& f) { return f.diff.state == PictureState::kWithinTolerance; });
  if (file == nullptr) return {};
  return {Verdict::kRenderer, visible,
          fmt::format("the figure's value is {}, its {} is drawn otherwise: {}; {}", equal,
                      file->format, file->diff.reason, renderers_text(file->diff, context))};
}

}  // namespace

Judgement judge_pictures(const Judgement& value, bool has_value,
                         const std::vector<PictureFile>& pictures, const RecordContext& context) {
  if (const auto presence = judge_presence(pictures)) {
    const Verdict verdict = heavier(presence->verdict, value.verdict);
    return verdict == presence->verdict ? *presence : value;
  }
  if (!has_value) return judge_alone(pictures);
  if (value.verdict > Verdict::kWithinTolerance && value.visible) {
    Judgement told = value;
    const bool unmoved =
        !pictures.empty() && std::ranges::all_of(pictures, [](const PictureFile& file) {
          return file.diff.state == PictureState::kIdentical;
        });
    if (unmoved) told.cause += "; its pictures are the same: they are not of this value";
    return told;
  }
  const Judgement drawing = judge_drawing(value, pictures, context);
  // What nobody sees is not a news where the value says more.
  const bool says_more = value.verdict == Verdict::kIdentical || drawing.visible;
  return says_more && drawing.verdict > value.verdict ? drawing : value;
}

}  // namespace mapproof
