#include "tests/reports/hostile_report.hpp"

#include <fmt/format.h>

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

}  // namespace

HostileReport hostile_report() {
  HostileReport out;
  Trap text(out.texts);
  Trap attribute(out.attributes);
  Section section{"s", text(), {}};
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
  section.blocks.emplace_back(Gallery{{{"in-gallery", text(), text(), text(), {}}}});
  section.blocks.emplace_back(
      KeyValues{{{text(), {text(), Emphasis::kCode}}, {text(), {text(), Emphasis::kData}}}});
  section.blocks.emplace_back(statuses(text));
  out.report = {text(), text(), {section}, text()};
  return out;
}

}  // namespace mapproof::test
