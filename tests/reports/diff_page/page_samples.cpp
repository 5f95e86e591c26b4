#include "tests/reports/diff_page/page_samples.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "render/image/png.hpp"
#include "reports/diff/folder_diff.hpp"
#include "reports/diff/images/image_diff.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

std::string circle_svg(int x) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 100 80\" width=\"100\" "
      "height=\"80\"><circle id=\"m\" cx=\"{}\" cy=\"40\" r=\"9\" fill=\"#0b5ea8\"/></svg>",
      x);
}

constexpr const char* kTrappedSvg =
    "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
    "viewBox=\"0 0 100 80\" onload=\"top.document.title='pwned'\"><script>"
    "parent.document.title='pwned'</script><image xlink:href=\"http://127.0.0.1:9/x.png\" "
    "width=\"9\" height=\"9\"/><rect width=\"50\" height=\"50\"/></svg>";

/// Hands out hostile texts, each with a number of its own, and keeps them.
class Trap {
 public:
  explicit Trap(std::vector<std::string>& kept) : kept_(kept) {}

  std::string operator()() {
    kept_.push_back(fmt::format(
        "{{{{id}}}}{{{{/items_list}}}}{{{{{{style_element}}}}}} trap{}</style></script></title>"
        "<script>document.title='pwned'</script><img src=x onerror=\"document.title='pwned'\">"
        "\" onmouseover=alert(1) x=' && $(id) `id` ../../x %s%00 end",
        kept_.size()));
    return kept_.back();
  }

 private:
  std::vector<std::string>& kept_;
};

FigureDiff figure(Trap& text) {
  FigureDiff diff;
  diff.changes = {{ChangeKind::kData, text(), text(), text(), text()}};
  diff.total_changes = 1;
  MarkMove move;
  move.location = text();
  move.landmark = text();
  move.distance = 0.041;
  move.distance_px = 9.1;
  MarkMove other = move;
  other.landmark = "";
  other.mark = text();
  MarkMove of_curve = other;
  of_curve.mark = "";
  of_curve.curve = text();
  diff.moves = {move, other, of_curve};
  diff.moved = 3;
  return diff;
}

RecordDiff records(Trap& text) {
  RecordDiff diff;
  diff.settings = {{text(), text(), text()}};
  diff.provenance = {{text(), text(), text()}};
  diff.missing_runs = {text()};
  diff.new_runs = {text()};
  diff.missing_subjects = {text()};
  diff.new_subjects = {text()};
  diff.anchors = {text()};
  Comparison comparison;
  comparison.subject = text();  // Shown by its label alone.
  comparison.label = {comparison.subject};
  comparison.current_subject = comparison.subject;
  comparison.quantity = known_quantity("mpe_m");
  comparison.outcome = Outcome::kWorse;
  comparison.test = PairedTest{"layout", {}, 0.003};
  diff.comparisons = {comparison};
  PointsDiff points;
  points.record = text();
  points.quantity = "landmark_m";
  points.moves = {{"L1", {0, 0}, {1, 1}, 0.041, {}, {}}};
  diff.points = {points};
  diff.statuses = {{text(), text(), text()}};
  diff.others = {{.file = text(),
                  .numbers = 3,
                  .within = 1,
                  .beyond = 2,
                  .first = text(),
                  .baseline = text(),
                  .current = text()}};
  diff.problems = {{text(), text()}};
  return diff;
}

ImageFile image(Trap& text, const fs::path& baseline, const fs::path& current) {
  ImageFile file;
  file.format = "png";
  file.baseline_key = text();
  file.baseline = baseline;
  file.current = current;
  file.diff.state = ImageState::kDifferent;
  file.diff.reason = text();
  file.diff.baseline_renderer = text();
  file.diff.current_renderer = text();
  file.diff.svg = SvgDiff{};
  file.diff.svg->changes = {{SvgChangeKind::kText, text(), text(), text(), text(), 1.5, false}};
  file.diff.svg->total = 1;
  return file;
}

DiffItem hostile_item(Trap& text, ItemKind kind, Verdict verdict) {
  DiffItem item;
  item.id = text();
  item.kind = kind;
  item.judgement = {verdict, true, text()};
  return item;
}

/// Two SVGs that differ, by hand: whatever a folder's comparison says of them.
DiffItem drawn_item(const fs::path& folder) {
  ImageFile file;
  file.format = "svg";
  file.baseline = folder / "drawn-a.svg";
  file.current = folder / "drawn-b.svg";
  write_file(file.baseline, circle_svg(30));
  write_file(file.current, circle_svg(60));
  file.diff = image_diff(file.baseline, file.current);
  DiffItem item;
  item.id = "drawn";
  item.judgement = {Verdict::kChanged, true, file.diff.reason};
  item.images = {std::move(file)};
  return item;
}

}  // namespace

std::string square_png(int width, int height, int x, int y) {
  Image image{width, height,
              std::vector<std::uint32_t>(static_cast<std::size_t>(width) * height, 0xffffff)};
  for (int j = y; j < std::min(y + 8, height); ++j)
    std::fill_n(image.row(j) + x, std::min(8, width - x), 0x0b5ea8);
  return encode_png(image);
}

DiffResult compared_folders(const fs::path& folder, int same) {
  const fs::path a = folder / "a", b = folder / "b";
  write_file(a / "moved.png", square_png(160, 120, 20, 30));
  write_file(b / "moved.png", square_png(160, 120, 100, 70));
  write_file(a / "resized.png", square_png(160, 120, 50, 60));
  write_file(b / "resized.png", square_png(160, 140, 50, 60));
  write_file(a / "gone.png", square_png(90, 60, 9, 9));
  write_file(b / "added.png", square_png(80, 60, 3, 3));
  write_file(a / "broken.png", square_png(70, 60, 3, 3));
  write_file(b / "broken.png", square_png(70, 60, 3, 3).substr(0, 60));
  for (int i = 1; i <= same; ++i)
    for (const fs::path& side : {a, b})
      write_file(side / fmt::format("same-{}.png", i), square_png(64, 48, i % 50, 5));
  DiffResult result = folder_diff(a, b);
  result.items.insert(std::ranges::find(result.items, "resized", &DiffItem::id),
                      drawn_item(folder));
  write_file(b / "drawn.svg", read_file(folder / "drawn-b.svg"));  // To be approved.
  return result;
}

HostileDiff hostile_diff(const fs::path& folder) {
  HostileDiff out;
  Trap text(out.texts);
  write_file(folder / "before.png", square_png(160, 120, 20, 30));
  write_file(folder / "after.png", square_png(160, 120, 100, 70));
  write_file(folder / "trapped.svg", kTrappedSvg);
  DiffResult& result = out.result;
  result.baseline = text();
  result.current = text();
  result.judgement = {Verdict::kWorse, true, ""};

  DiffItem first = hostile_item(text, ItemKind::kRecords, Verdict::kWorse);
  first.records = records(text);
  DiffItem second = hostile_item(text, ItemKind::kFigure, Verdict::kWorse);
  second.figure = figure(text);
  second.images = {image(text, folder / "before.png", folder / "after.png")};
  DiffItem third = hostile_item(text, ItemKind::kImage, Verdict::kNew);
  ImageFile svg;
  svg.format = "svg";
  svg.current = folder / "trapped.svg";
  third.images = {svg};
  DiffItem last = hostile_item(text, ItemKind::kImage, Verdict::kIdentical);
  last.judgement.cause.clear();
  out.texts.pop_back();  // An identical item has no cause to show.
  result.items = {first, second, third, last};
  return out;
}

}  // namespace mapproof::test
