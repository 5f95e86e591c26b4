#include "reports/diff/svg/svg_diff.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/base/errors.hpp"
#include "render/figures/maps/map.hpp"
#include "render/plot/layout.hpp"
#include "render/svg/svg.hpp"
#include "reports/diff/svg/svg_attributes.hpp"
#include "reports/diff/svg/svg_parser.hpp"
#include "tests/support/samples/sample_figures.hpp"

namespace mapproof::test {
namespace {

std::string svg(const std::string& body) {
  return R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink">)" +
         body + "</svg>";
}

SvgDiff diff_of(const std::string& a, const std::string& b, const SvgTolerances& options = {}) {
  return svg_diff(parse_svg(a), parse_svg(b), options);
}

SvgDiff body_diff(const std::string& a, const std::string& b) { return diff_of(svg(a), svg(b)); }

Drawing usual_map() { return lay_out(map_figure(sample_map(30, 0.12, 1), "map"), report_theme()); }

/// Circles in a row without ids, as other programs write them.
std::string row_of_circles(int count, int without, double shift) {
  std::string body;
  for (int i = 0; i < count; ++i)
    if (i != without)
      body += fmt::format(R"(<circle cx="{}" cy="{}" r="2"/>)", 10 * i + shift, i * i % 17);
  return "<g>" + body + "</g>";
}

TEST(SvgDiff, AFileIsLikeItself) {
  const std::string text = to_svg(usual_map());
  EXPECT_EQ(diff_of(text, text).total, 0);
}

TEST(SvgDiff, WhatIsWrittenOtherwiseAndMeansTheSameIsNoChange) {
  for (const auto& [a, b] : {
           std::pair{"<rect fill='#f00' x='1'/>", "<rect x='1.0' style='fill: red'/>"},
           {"<rect fill='#abc'/>", "<rect fill='rgb(170, 187,204)'/>"},
           {"<rect fill='rgb(100%,0%,0%)'/>", "<rect fill='RED'/>"},
           {"<path d='M10-5l1 1 2 2z'/>", "<path d='M 10,-5 L 11,-4 l 2 2 Z'/>"},
           {"<path d='M0 0A1 1 0 0 1 2 2'/>", "<path d='m0,0a1,1,0,012,2'/>"},
           {"<g transform='translate(3)'/>", "<g transform='matrix(1 0 0 1 3 0)'/>"},
           {"<g transform='rotate(0 5 5)scale(2)'/>", "<g transform='scale(2,2)'/>"},
           {"<rect width='5px'/>", "<rect   width='5'></rect>"},
           {"<text>a  b</text>", "<text> a b\n</text>"},
       })
    EXPECT_EQ(body_diff(a, b).total, 0) << a << " " << b;
}

TEST(SvgDiff, OneElementThatIsGoneIsOneChange) {
  for (const double shift : {0.0, 0.01}) {
    const SvgDiff found = body_diff(row_of_circles(40, -1, 0.0), row_of_circles(40, 17, shift));
    EXPECT_EQ(found.total - found.tolerated, 1);
    ASSERT_FALSE(found.changes.empty());
    EXPECT_EQ(found.changes[0].what, "removed");
    EXPECT_EQ(found.changes[0].element, "svg/g[1]/circle[18]");
    EXPECT_EQ(found.structure, 1);
  }
}

TEST(SvgDiff, AMarkerLostFromAFigureIsNamedByItsId) {
  Drawing drawing = usual_map();
  const std::string before = to_svg(drawing);
  const auto marker = std::ranges::find_if(drawing.items, [](const Item& item) {
    return item.item_class == ItemClass::kMarker && item.mark;
  });
  ASSERT_NE(marker, drawing.items.end());
  drawing.items.erase(marker);
  const SvgDiff found = diff_of(before, to_svg(drawing));
  EXPECT_GE(found.structure, 1);
  EXPECT_LE(found.total - found.tolerated, 2);
}

TEST(SvgDiff, NumbersHaveATolerance) {
  const SvgDiff near = body_diff(R"(<circle cx="1"/>)", R"(<circle cx="1.04"/>)");
  EXPECT_EQ(near.geometry, 1);
  EXPECT_EQ(near.tolerated, 1);
  const SvgDiff far = body_diff(R"(<path d="M0 0L5 5"/>)", R"(<path d="M0 0L5 6.5"/>)");
  EXPECT_EQ(far.tolerated, 0);
  EXPECT_DOUBLE_EQ(far.changes.at(0).distance, 1.5);
  EXPECT_EQ(body_diff(R"(<g opacity="0.2"/>)", R"(<g opacity="0.21"/>)").tolerated, 0);
  EXPECT_EQ(body_diff(R"(<g stroke-width="1"/>)", R"(<g/>)").style, 1);
}

/// A page of a width and a viewBox, with circles in a group.
std::string page(const std::string& width, double box, const std::string& group, double shift) {
  return fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{}" viewBox="0 0 {} {}">)",
                     width, box, box) +
         "<g" + group + ">" + row_of_circles(40, -1, shift) + "</g></svg>";
}

bool passes(const std::string& a, const std::string& b) {
  const SvgDiff found = diff_of(a, b);
  return found.total > 0 && found.tolerated == found.total;
}

TEST(SvgDiff, ATenthOfAPixelPassesAndAWholeOneDoesNotHoweverItIsWritten) {
  const auto moved = [](double by) { return fmt::format(" transform='translate({} 0)'", by); };
  for (const auto& [width, box] : {std::pair("400", 400.0),
                                   {"300pt", 400.0},
                                   {"300pt", 300.0},
                                   {"1000", 1.0},
                                   {"10cm", 4000.0},
                                   {"100%", 400.0}}) {
    const double px = box * (width == std::string("300pt")  ? 1.0 / 400.0
                             : width == std::string("10cm") ? 1.0 / (10 * 96 / 2.54)
                             : width == std::string("1000") ? 1.0 / 1000.0
                                                            : 1.0 / 400.0);
    SCOPED_TRACE(fmt::format("{} {}", width, box));
    const std::string before = page(width, box, "", 0.0);
    for (const double by : {0.02, 0.1}) {
      EXPECT_TRUE(passes(before, page(width, box, moved(by * px), 0.0))) << by;
      EXPECT_TRUE(passes(before, page(width, box, "", by * px))) << by;
      EXPECT_TRUE(passes(page(width, box, " transform='scale(2)'", 0.0),
                         page(width, box, " transform='scale(2)'", by * px / 2)))
          << by;
    }
    for (const double by : {0.3, 1.0, -1.0}) {
      EXPECT_FALSE(passes(before, page(width, box, moved(by * px), 0.0))) << by;
      EXPECT_FALSE(passes(before, page(width, box, "", by * px))) << by;
    }
  }
}

TEST(SvgDiff, SmallMovementsOfGroupsAddUp) {
  const auto nested = [](int groups, double by) {
    std::string text;
    for (int i = 0; i < groups; ++i) text += fmt::format("<g transform='translate({} 0)'>", by);
    text += "<circle r='3'/>";
    for (int i = 0; i < groups; ++i) text += "</g>";
    return svg(text);
  };
  EXPECT_TRUE(passes(nested(1, 5.0), nested(1, 5.1)));
  EXPECT_FALSE(passes(nested(10, 5.0), nested(10, 5.1)));
  EXPECT_FALSE(passes(svg("<g transform='scale(1)'/>"), svg("<g transform='scale(1.04)'/>")));
}

TEST(SvgDiff, ColoursHaveADistance) {
  const SvgDiff found = body_diff(R"(<g style="fill:#102030"/>)", R"(<g fill="#102034"/>)");
  EXPECT_EQ(found.style, 1);
  EXPECT_DOUBLE_EQ(found.changes.at(0).distance, 4.0);
  EXPECT_FALSE(found.changes[0].tolerated);
  EXPECT_EQ(diff_of(svg(R"(<g fill="#102030"/>)"), svg(R"(<g fill="#102034"/>)"), {.colour = 4})
                .tolerated,
            1);
}

TEST(SvgDiff, TakesNoToleranceBelowZero) {
  const SvgTree tree = parse_svg(svg(""));
  EXPECT_THROW(svg_diff(tree, tree, {.distance_px = -0.1}), InvalidInput);
  EXPECT_THROW(svg_diff(tree, tree, {.colour = std::nan("")}), InvalidInput);
}

TEST(SvgDiff, AnEmptyRemarkThatIsNewIsListed) {
  EXPECT_EQ(body_diff("<g/>", "<g data-p=''/>").metadata, 1);
  EXPECT_EQ(body_diff("<g/>", "<g fill=''/>").total, 0);
}

TEST(SvgDiff, DistinguishesTextFromRemarks) {
  const SvgDiff found = body_diff("<title>a</title><text>x</text><g data-p='1'/>",
                                  "<title>b</title><text>y</text><g data-p='2'/>");
  EXPECT_EQ(found.text, 1);
  EXPECT_EQ(found.metadata, 2);
  EXPECT_EQ(found.tolerated, 2);
}

TEST(SvgDiff, TheOrderOfDrawingCounts) {
  const SvgDiff found =
      body_diff("<g id='a'/><g id='b'/><g id='c'/>", "<g id='c'/><g id='a'/><g id='b'/>");
  EXPECT_EQ(found.total, 1);
  EXPECT_EQ(found.changes.at(0).what, "moved");
  EXPECT_EQ(found.changes[0].element, "svg/g#c");
}

TEST(SvgDiff, OneOfCountedElementsThatIsGoneIsOneChange) {
  const auto counted = [](int gone) {
    std::string body;
    for (int i = 0, number = 0; i < 40; ++i)
      if (i != gone)
        body += fmt::format("<g id='line2d_{}'><path d='M{} 0'/></g>", ++number, i * i);
    return body;
  };
  for (const int gone : {0, 17, 39}) {
    const SvgDiff found = body_diff(counted(-1), counted(gone));
    EXPECT_EQ(found.structure, 1) << gone;
    EXPECT_EQ(found.total - found.tolerated, 1) << gone;
    EXPECT_EQ(body_diff(counted(gone), counted(-1)).structure, 1) << gone;
  }
  // Numbers with a gap are names: the one that moved is reported by its own.
  const std::string all = "<g id='p1'><rect x='1'/></g><g id='p2'><rect x='2'/></g><g id='p3'/>";
  EXPECT_EQ(body_diff(all, "<g id='p1'><rect x='2'/></g><g id='p3'/>").geometry, 1);
}

TEST(SvgDiff, IdsThatAreMadeUpAgainAreRemarks) {
  const SvgDiff found = body_diff("<defs><path id='m1f' d='M0 0'/></defs><use xlink:href='#m1f'/>",
                                  "<defs><path id='x9a' d='M0 0'/></defs><use href='#x9a'/>");
  EXPECT_EQ(found.tolerated, found.total);
  EXPECT_EQ(body_diff("<path id='a'/><path id='b' d='M1 1'/><use href='#a'/>",
                      "<path id='a'/><path id='b' d='M1 1'/><use href='#b'/>")
                .style,
            1);
}

TEST(SvgDiff, ListsNoMoreThanABoundedNumber) {
  const SvgDiff found = body_diff(row_of_circles(900, -1, 0), row_of_circles(900, -1, 3));
  EXPECT_EQ(found.changes.size(), 200u);
  EXPECT_EQ(found.geometry, 900);
}

TEST(SvgParser, RefusesWhatRunsOrLoadsOrBlowsUp) {
  std::string deep;
  for (int i = 0; i < 300; ++i) deep += "<g>";
  for (const std::string& text :
       {std::string(), std::string("<svg"), svg("<g></rect>"), std::string("<html/>"),
        "<!DOCTYPE svg [<!ENTITY a 'aaaa'><!ENTITY b '&a;&a;'>]>" + svg("<text>&b;</text>"),
        "<!DOCTYPE svg SYSTEM 'x' [<!ENTITY x SYSTEM 'file:///etc/passwd'>]>" + svg("&x;"),
        svg("<script>1</script>"), svg("<g onclick='x()'/>"),
        svg("<image xlink:href='http://example.org/a.png'/>"), svg("<use href='other.svg#a'/>"),
        svg("<a href='javascript:x()'/>"), svg("<g fill='url(http://example.org/#a)'/>"),
        svg("<a><set attributeName='href' to='javascript:x()'/></a>"),
        svg("<a><animate values='javascript:x()' attributeName='xlink:href'/></a>"),
        svg("<g><set attributeName='onclick' to='x()'/></g>"),
        svg("<style>@import 'x.css';</style>"), svg("<foreignObject/>"), svg(deep)})
    EXPECT_THROW(parse_svg(text), InvalidInput) << text.substr(0, 200);
}

/// pugixml takes each of these but the last three (docs/decisions/0012).
TEST(SvgParser, RefusesWhatIsNotWellFormedWithItsLine) {
  const std::string start = "<svg xmlns='http://www.w3.org/2000/svg'>\n", end = "\n</svg>";
  for (const std::string& middle : {
           std::string("<text>&nope;</text>"),
           std::string("<text>a & b</text>"),
           std::string("<g x='1' x='2'/>"),
           std::string("<text>\xC3\x28</text>"),
           std::string("<g\xFF/>"),
           std::string("<g xlink:href='#a'/>"),
           std::string("<g x='a<b'/>"),
           std::string("<text>\x01</text>"),
           std::string("<text>&#0;</text>"),
           std::string("<text>&#xD800;</text>"),
           std::string("<!-- a -- b -->"),
           std::string("<text>a ]]> b</text>"),
           std::string("<g xmlns:xml='urn:x'/>"),
           std::string("<g></rect>"),
           std::string("<g x=1/>"),
           std::string("<1g/>"),
       }) {
    std::string said = "nothing";
    try {
      parse_svg(start + middle + end);
    } catch (const InvalidInput& error) {
      said = error.what();
    }
    EXPECT_TRUE(said.starts_with("line 2: ")) << middle << ": " << said;
  }
  for (const std::string& text : {start + end + start + end, start + end + "x", "x" + start + end,
                                  "<!DOCTYPE svg [<!FOO>]>" + start + end,
                                  "<?xml version='1.0' encoding='foo'?>" + start + end})
    EXPECT_THROW(parse_svg(text), InvalidInput) << text;
}

TEST(SvgParser, TakesWhatOtherProgramsWrite) {
  EXPECT_NO_THROW(parse_svg(
      "<?xml version='1.0' standalone='no'?><!DOCTYPE svg PUBLIC '-//W3C//DTD SVG 1.1//EN' "
      "'http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd'><!-- Created with x -->" +
      svg("<a href='https://example.org'/><g clip-path='url(#p)'/>"
          "<image href='data:image/png;base64,AA=='/>")));
}

TEST(SvgValues, NamesOfColoursAreKnown) {
  EXPECT_EQ(css_colour("rebeccapurple"), (std::array<double, 3>{0x66, 0x33, 0x99}));
  EXPECT_EQ(css_colour("AliceBlue"), (std::array<double, 3>{0xF0, 0xF8, 0xFF}));
  EXPECT_EQ(css_colour("yellowgreen"), (std::array<double, 3>{0x9A, 0xCD, 0x32}));
  for (const char* other : {"none", "", "red blue", "ff0000", "FF0000", "gree", "reen", "green1"})
    EXPECT_EQ(css_colour(other), std::nullopt) << other;
  EXPECT_EQ(css_colour("#12345"), std::nullopt);
}

RC_GTEST_PROP(SvgValues, APathMovedAsAWholeIsThatFarAway, ()) {
  const auto steps = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange(-99, 99), rc::gen::inRange(-99, 99))));
  const int by = *rc::gen::inRange(1, 50);
  std::string relative = "m 7 7", absolute = fmt::format("M{},7", 7 + by);
  int x = 7 + by, y = 7;
  for (const auto& [dx, dy] : steps) {
    relative += fmt::format("l{},{}", dx, dy);
    x += dx, y += dy;
    absolute += fmt::format(" L {} {}", x, y);
  }
  RC_ASSERT(value_distance("d", relative, absolute).distance == by);
}

RC_GTEST_PROP(SvgParser, NoBytesDoHarm, ()) {
  const auto middle = *rc::gen::container<std::string>(
      rc::gen::elementOf(std::string("<>/='\" \n&;#!-[]gsv:aAdzM01.")));
  try {
    const SvgTree tree = parse_svg(svg(middle));
    RC_ASSERT(svg_diff(tree, tree).total == 0);
  } catch (const InvalidInput&) {
  }
}

}  // namespace
}  // namespace mapproof::test
