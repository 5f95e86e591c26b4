#include "reports/diff/svg/svg_parser.hpp"

#include <string>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/support/samples/active_svgs.hpp"

namespace mapproof::test {
namespace {

TEST(SvgParser, RefusesEachWayToRunOrLoadSomething) {
  for (const auto& [name, text] : active_svgs())
    EXPECT_THROW(parse_svg(text), InvalidInput) << name << ": " << text;
}

TEST(SvgParser, TakesInertFilesOfOtherPrograms) {
  for (const auto& [name, text] : inert_svgs()) EXPECT_NO_THROW(parse_svg(text)) << name;
}

TEST(SvgActive, AnAddressIsReadAsBrowsersReadIt) {
  EXPECT_EQ(cleaned_address(" \x01java\tscr\nipt:x "), "javascript:x");
  EXPECT_EQ(cleaned_address("#a b"), "#a b");
}

TEST(SvgActive, EscapesOfCssAreReadAsCssReadsThem) {
  for (const char* css : {"fill: u\\72l(http://x)", "fill:\\75 rl(//x)", "\\55\\52\\4c(x.png)",
                          "@\\69mport 'x'", "@i\\6d port \"x\"", "url( \"http://x\" )"})
    EXPECT_TRUE(css_loads(css)) << css;
  for (const char* css :
       {"fill: url(#a)", "fill: \\75rl( '#a' )", "fill: red", "font-family: 'a\\\\b'",
        "@font-face{src:url(data:font/woff2;base64,AA)}"})
    EXPECT_FALSE(css_loads(css)) << css;
}

}  // namespace
}  // namespace mapproof::test
