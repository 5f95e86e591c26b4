#include "render/svg/svg.hpp"

#include <set>

#include <gtest/gtest.h>

#include "render/figures/maps/map.hpp"
#include "render/output/write_figure.hpp"
#include "tests/support/samples/sample_figures.hpp"
#include "tests/support/xml.hpp"

namespace mapproof::test {
namespace {

std::string xml(std::string_view text) {
  std::string out;
  append_xml(out, text);
  return out;
}

std::string number(double value) {
  std::string out;
  append_number(out, value);
  return out;
}

TEST(XmlText, KeepsMarkupFromBeingMarkup) {
  EXPECT_EQ(xml("<a b='c' d=\"e\">&"), "&lt;a b='c' d=&quot;e&quot;&gt;&amp;");
}

TEST(XmlText, ReplacesWhatXmlForbids) {
  EXPECT_EQ(xml(std::string_view("a\0b\x1F", 4)), "a\uFFFDb\uFFFD");
  EXPECT_EQ(xml("\xFF\xC3"), "\uFFFD\uFFFD");
  EXPECT_EQ(xml("\uFFFE"), "\uFFFD");
}

TEST(XmlText, ShowsInTheSourceWhatWouldTurnTheDirection) {
  EXPECT_EQ(xml("a\u202Eb\u200Fc\n"), "a&#x202E;b&#x200F;c&#xA;");
}

TEST(SvgNumber, HasAtMostTwoDecimalsAndNoTrailingZeros) {
  EXPECT_EQ(number(0.0), "0");
  EXPECT_EQ(number(-0.001), "0");
  EXPECT_EQ(number(12.3456), "12.35");
  EXPECT_EQ(number(-0.5), "-.5");
  EXPECT_EQ(number(3.10), "3.1");
  EXPECT_EQ(number(7.0), "7");
  EXPECT_EQ(number(0.05), ".05");
}

class EverySvg : public ::testing::TestWithParam<Figure> {};

TEST_P(EverySvg, IsXmlWhoseIdsAreUniqueAndBeginWithTheFigures) {
  const std::string& own = GetParam().id;
  std::set<std::string> ids;
  for (const XmlElement& element : parse_xml(figure_svg(GetParam(), report_theme()))) {
    const auto id = element.attributes.find("id");
    if (id == element.attributes.end()) continue;
    EXPECT_TRUE(id->second == own || id->second.starts_with(own + "-")) << id->second;
    EXPECT_TRUE(ids.insert(id->second).second) << id->second << " is there twice";
  }
  EXPECT_GT(ids.size(), 10u);
}

TEST_P(EverySvg, RefersToNothingOutsideItself) {
  std::set<std::string> ids;
  const std::vector<XmlElement> elements = parse_xml(figure_svg(GetParam(), report_theme()));
  for (const XmlElement& element : elements)
    if (element.attributes.contains("id")) ids.insert(element.attributes.at("id"));
  for (const XmlElement& element : elements) {
    EXPECT_NE(element.name, "script");
    const auto target = element.attributes.find("href");
    if (target == element.attributes.end()) continue;
    EXPECT_TRUE(ids.contains(target->second.substr(1))) << target->second;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EverySvg, ::testing::ValuesIn(sample_figures()), [](const auto& one) {
  std::string text = one.param.id;
  std::ranges::replace(text, '-', '_');
  return text;
});

TEST(Svg, SaysWhatItShowsToThoseWhoCannotSee) {
  const Figure figure = map_figure(sample_map(20, 0.1, 1), "map");
  const std::vector<XmlElement> elements = parse_xml(figure_svg(figure, report_theme()));
  EXPECT_EQ(elements[0].attributes.at("role"), "img");
  EXPECT_EQ(elements[0].attributes.at("aria-labelledby"), "map-title map-desc");
  EXPECT_EQ(elements[1].text, figure.title);
  EXPECT_EQ(elements[2].text, figure.alt);
}

TEST(Svg, CarriesTheDataOfEachMark) {
  MapRecord map = sample_map(20, 0.1, 1);
  map.names[6] = "<door> & \"window\"\u202E";
  map.ground_truth_m->row(6) << 1.0, 2.0;
  map.estimate.row(6) << 1.3, 2.4;
  std::map<std::string, XmlElement> by_id;
  for (const XmlElement& element : parse_xml(figure_svg(map_figure(map, "map"), report_theme())))
    if (element.attributes.contains("id")) by_id[element.attributes.at("id")] = element;
  const auto& ground_truth = by_id.at("map-true-7").attributes;
  EXPECT_EQ(ground_truth.at("data-landmark"), map.names[6]);
  EXPECT_EQ(ground_truth.at("data-x"), "1");
  EXPECT_EQ(ground_truth.at("data-y"), "2");
  const auto& estimate = by_id.at("map-estimate-7").attributes;
  EXPECT_EQ(estimate.at("data-kind"), "estimate");
  EXPECT_EQ(estimate.at("data-error"), "0.5");
  EXPECT_EQ(by_id.at("map-error-7").attributes.at("data-error"), "0.5");
}

TEST(Svg, GivesLongNamesBackWhole) {
  MapRecord map = sample_map(3, 0.1, 1);
  map.anchors.clear();
  map.names[1] = std::string(10240, 'W');
  bool found = false;
  for (const XmlElement& element : parse_xml(figure_svg(map_figure(map, "map"), report_theme())))
    if (element.attributes.contains("aria-label"))
      found = found || element.attributes.at("aria-label") == map.names[1];
  EXPECT_TRUE(found);
}

TEST(Svg, KeepsItsSymbolsFreeOfTheLinesTheyStandOn) {
  const std::string svg = figure_svg(error_curve_figure(sample_curves(2, 1)), report_theme());
  const std::size_t group = svg.find("<g id=\"curve-method-2-mean\"");
  ASSERT_NE(group, std::string::npos);
  EXPECT_EQ(svg.substr(group, svg.find('>', group) - group).find("stroke"), std::string::npos);
  EXPECT_EQ(svg.substr(0, group).rfind("</g>"), group - 5);  // Within no other group.
}

TEST(Svg, HoldsNoDateHostOrCounter) {
  const Figure figure = map_figure(sample_map(20, 0.1, 1), "map");
  const std::string first = figure_svg(figure, report_theme());
  EXPECT_EQ(first, figure_svg(figure, report_theme()));
  EXPECT_EQ(first.find("<!--"), std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
