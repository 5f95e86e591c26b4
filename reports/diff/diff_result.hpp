#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/diff/figures/figure_diff.hpp"
#include "reports/diff/images/picture_changes.hpp"
#include "reports/diff/records/record_diff.hpp"
#include "reports/diff/verdict/verdict.hpp"

namespace mapproof {

/// A picture file of an item.
struct PictureFile {
  std::string format;        ///< "png", "svg", "pdf".
  std::string baseline_key;  ///< Of several valid baselines, which; empty: the plain one.
  std::filesystem::path baseline, current;  ///< Empty: not there.
  PictureDiff diff;                         ///< If both are there.
};

enum class ItemKind {
  kRecords,   ///< The records of a study, or of one map.
  kFigure,    ///< A figure with its value, and its pictures.
  kPicture,   ///< Pictures without a value.
  kDocument,  ///< A table or a report's page: what follows from records and figures.
};

/// "records", "figure", "picture", "document".
std::string_view name(ItemKind kind);

/// One thing that was compared.
struct DiffItem {
  std::string id;  ///< "fig-7", "records"; below folders with '/'.
  ItemKind kind = ItemKind::kPicture;
  Judgement judgement;
  bool passes = false;  ///< What the exit code goes by.
  std::optional<RecordDiff> records;
  std::optional<FigureDiff> figure;
  /// The values that were compared, where there are some: a page redraws nothing, but its tables
  /// name what they show.
  std::filesystem::path baseline_figure, current_figure;
  std::vector<PictureFile> pictures;
  std::vector<OtherDiff> documents;  ///< Of a document, its files whose bytes differ.
};

/// The comparison of two studies, two folders or two files.
struct DiffResult {
  std::string baseline, current;  ///< As they were named.
  Judgement judgement;            ///< Of the whole: the heaviest verdict and how often.
  bool passes = false;
  std::vector<Verdict> allowed;
  std::vector<std::string> remarks;  ///< On what was not compared; a sentence each.
  std::vector<DiffItem> items;       ///< By weight of verdict, then records first, then by id.
};

/// Items of each verdict, in the order of kVerdicts.
std::vector<int> counts_of(const DiffResult& result);

}  // namespace mapproof
