#include "reports/diff/diff_result.hpp"

namespace mapproof {

std::string_view name(ItemKind kind) {
  switch (kind) {
    case ItemKind::kRecords:
      return "records";
    case ItemKind::kFigure:
      return "figure";
    case ItemKind::kPicture:
      return "picture";
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

}  // namespace mapproof
