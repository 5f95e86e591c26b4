#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/diff/figures/figure_diff.hpp"
#include "reports/diff/images/image_changes.hpp"
#include "reports/diff/records/record_diff.hpp"
#include "reports/diff/records/record_tie.hpp"
#include "reports/diff/verdict/verdict.hpp"

namespace mapproof {

/// Where two images differ: heat_map() in image_diff.hpp.
struct HeatMapFile {
  std::string png;
  ImageSize size;
  double changed_share = 0.0;  ///< Of its pixels.
};

/// An image file of an item.
struct ImageFile {
  std::string format;        ///< "png", "svg", "pdf".
  std::string baseline_key;  ///< Which of several valid baselines; empty: the plain one.
  std::filesystem::path baseline, current;  ///< Empty: missing.
  ImageDiff diff;                           ///< Set if both files exist.
  /// If the comparison kept it: it would have to decode both files again (heat_map_file()).
  std::optional<HeatMapFile> heat = {};
};

enum class ItemKind {
  kRecords,   ///< The records of a study, or of one map.
  kFigure,    ///< A figure with its value, and its images.
  kImage,     ///< Images without a value.
  kDocument,  ///< A table or a report's page, which follow from records and figures.
};

/// "records", "figure", "image", "document".
std::string_view name(ItemKind kind);

/// One thing that was compared.
struct DiffItem {
  std::string id;  ///< "fig-7", "records"; below folders with '/'.
  ItemKind kind = ItemKind::kImage;
  Judgement judgement;
  bool passes = false;    ///< The exit code depends on it.
  bool is_stale = false;  ///< A figure that is equal although the records it shows differ.
  std::optional<RecordDiff> records;
  std::optional<FigureDiff> figure;
  /// The files of the values that were compared, if there are any. A page draws nothing again, but
  /// its tables name what these files show.
  std::filesystem::path baseline_figure, current_figure;
  std::vector<ImageFile> images;
  std::vector<OtherDiff> documents;  ///< For a document: its files whose bytes differ.
};

/// One cause of several items.
struct SharedCause {
  std::string cause;
  Verdict verdict = Verdict::kIdentical;
  std::vector<std::string> ids;
};

/// How the cause of what follows from an item begins, before that item's own: "it follows from
/// records: ".
inline std::string follows_from(const DiffItem& item) {
  return "it follows from " + item.id + ": ";
}

/// The comparison of two studies, two folders or two files.
struct DiffResult {
  std::string baseline, current;  ///< As the user named them.
  /// What pages call them: "nightly run 2"; empty: as the user named them.
  std::string baseline_title = {}, current_title = {};
  bool has_baseline = true;       ///< Else there is nothing yet to compare with.
  Judgement judgement;            ///< On the whole: the heaviest verdict and the counts.
  bool passes = false;
  std::vector<Verdict> allowed;
  std::vector<std::string> remarks;  ///< One sentence on each thing that was not compared.
  std::vector<SharedCause> shared;   ///< Causes that three or more items have in common.
  std::vector<DiffItem> items;       ///< By weight of verdict, then records first, then by id.
};

/// What a page calls a side.
inline const std::string& shown_baseline(const DiffResult& result) {
  return result.baseline_title.empty() ? result.baseline : result.baseline_title;
}
inline const std::string& shown_current(const DiffResult& result) {
  return result.current_title.empty() ? result.current : result.current_title;
}

/// The number of items of each verdict, in the order of kVerdicts.
std::vector<int> counts_of(const DiffResult& result);
/// "1 data, worse, 2 style, 51 identical": those that occur, the heaviest first.
std::string counts_text(const DiffResult& result);
/// "1 data, worse, 51 identical. The first is fig-7": the counts and the first item that differs;
/// the counts alone where none does.
std::string counts_and_first(const DiffResult& result);

/// The versions that the records name and that differ, each once: "FreeType 2.12 → 2.13". They are
/// not judged.
std::vector<std::string> version_changes(const DiffResult& result);

/// Combines the judgement of a figure's value with what its images show. Without a value the images
/// alone decide.
/// @param has_value  Whether the figure's value was compared.
Judgement judge_images(const Judgement& value, bool has_value, const std::vector<ImageFile>& images,
                       const RecordContext& context);

}  // namespace mapproof
