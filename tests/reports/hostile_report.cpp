#include "tests/reports/hostile_report.hpp"

#include <fmt/format.h>

#include "core/model/map_record.hpp"
#include "render/figures/maps/map.hpp"
#include "render/plot/layout.hpp"
#include "render/svg/svg.hpp"

namespace mapproof::test {
namespace {

/// Hands out hostile texts, each with a number of its own, and keeps them.
class Trap {
 public:
  explicit Trap(std::vector<std::string>& kept) : kept_(kept) {}

  std::string operator()() {
    kept_.push_back(fmt::format(
        "{{{{title}}}}{{{{{{style_element}}}}}}{{{{/sections}}}} trap{}</style></script></title>"
        "<script>document.title='pwned'</script><img src=x onerror=\"document.title='pwned'\">"
        "\" onmouseover=alert(1) x=' && ../../x %s \u202Eelpmis\u202C \u05D0\u05D1 end",
        kept_.size()));
    return kept_.back();
  }

 private:
  std::vector<std::string>& kept_;
};

Table table(Trap& text, Trap& attribute) {
  Table out{"table", text(), {}, {}, {text()}};
  out.columns = {
      {text(), text(), "", attribute()}, {text(), "", text(), attribute()}, {"n", "", "g", ""}};
  out.rows = {
      {{TextCell{text()}, TextCell{text(), Emphasis::kCode}, NumberCell{1.0}}, attribute(), true},
      {{TextCell{text() + std::string(10000, 'w')}, TextCell{text(), Emphasis::kData},
        MissingCell{}},
       attribute(),
       false}};
  return out;
}

StatusList statuses(Trap& text) {
  StatusList::Item item{text(), text(), text(), 1, 2, true, {{text(), text()}}};
  return {{item}};
}

/// A map by our own writers whose landmarks have such names.
std::string drawn_map(std::vector<std::string>& names) {
  Trap name(names);
  MapRecord record;
  record.id = "map/x";
  record.ground_truth_m = Points(5, 2);
  *record.ground_truth_m << 0, 0, 2, 0, 0, 2, 2, 2, 1, 1;
  // Long errors: a small image in which next to nothing is drawn is left out.
  record.estimate = record.ground_truth_m->rowwise().reverse().array() + 0.1;
  record.anchors = {0, 1};
  for (int i = 0; i < 5; ++i) record.names.push_back(name());
  return to_svg(lay_out(map_figure(record, "drawn"), report_theme()));
}

Opening opening(Trap& text) {
  return {.findings = {{{{text(), Emphasis::kPlain}, {text(), Emphasis::kStrong}}}},
          .figure_ids = {"drawn", "figure"},
          .standing = Standing{true, text(), {text(), text()}, {{{{text()}}}}, text()},
          .numbers = {{{text(), text(), text(), "provenance"}}},
          .main_figure = "drawn",
          .wrong = {{{text()}}},
          .compared_with = {{{text()}}}};
}

}  // namespace

HostileReport hostile_report() {
  HostileReport out;
  Trap text(out.texts);
  Trap attribute(out.attributes);
  Section section{"provenance", text(), {}};
  section.blocks.emplace_back(Paragraph{{{text(), Emphasis::kPlain},
                                         {text(), Emphasis::kStrong},
                                         {text(), Emphasis::kCode},
                                         {text(), Emphasis::kData}}});
  section.blocks.emplace_back(BulletList{{{{{text(), Emphasis::kPlain}}}}});
  section.blocks.emplace_back(Highlights{{{text(), text(), text()}}});
  section.blocks.emplace_back(
      Callout{Callout::Tone::kWarning, text(), {{{text(), Emphasis::kPlain}}}});
  section.blocks.emplace_back(table(text, attribute));
  section.blocks.emplace_back(FigureBlock{"figure", text(), text(), text(), {}});
  section.blocks.emplace_back(
      FigureBlock{"drawn", text(), text(), "", {}, "figure", {text(), text()}});
  section.blocks.emplace_back(Gallery{{{"in-gallery", text(), text(), text(), {}}}});
  section.blocks.emplace_back(
      KeyValues{{{text(), {text(), Emphasis::kCode}}, {text(), {text(), Emphasis::kData}}}});
  section.blocks.emplace_back(statuses(text));
  out.report = {text(), text(), {section}, text(), opening(text), text(), text()};
  const std::string drawing = drawn_map(out.landmarks);
  out.svg = [drawing](const std::string& id) { return id == "drawn" ? drawing : ""; };
  return out;
}

}  // namespace mapproof::test
