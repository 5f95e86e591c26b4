#include "render/theme/theme.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Core>

#include "core/base/errors.hpp"
#include "render/plot/layers.hpp"
#include "render/theme/font.hpp"
#include "render/theme/palette.hpp"
#include "render/theme/ticks.hpp"

namespace mapproof {
namespace {

TEST(Colour, ContrastOfBlackOnWhiteIsTwentyOne) {
  EXPECT_NEAR(contrast(colour(0x000000), colour(0xFFFFFF)), 21.0, 1e-12);
  EXPECT_NEAR(contrast(colour(0x777777), colour(0xFFFFFF)), 4.48, 0.005);  // A known pair.
  EXPECT_EQ(contrast(colour(0x123456), colour(0x654321)),
            contrast(colour(0x654321), colour(0x123456)));
}

TEST(Colour, IsWrittenAsHex) { EXPECT_EQ(hex(colour(0x00A0FF)), "#00a0ff"); }

TEST(Palette, SeriesStandOutFromWhite) {
  for (const Colour one : kSeriesColours)
    EXPECT_GE(contrast(one, colour(0xFFFFFF)), 3.0) << hex(one);
}

TEST(Palette, SeriesStandOutFromADarkPage) {
  for (const Colour one : kDarkSeriesColours)
    EXPECT_GE(contrast(one, dark_theme().background), 4.5) << hex(one);
}

using Vision = Eigen::Matrix3d;  ///< Of linear light, to what is seen of it.

/// With all cones, and without those for long or middle waves [machado2009, severity 1].
const std::vector<Vision>& visions() {
  static const std::vector<Vision> all = [] {
    Vision protan, deutan;
    protan << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882, -0.048116,
        1.051998;
    deutan << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820, 0.042940,
        0.968881;
    return std::vector<Vision>{Vision::Identity(), protan, deutan};
  }();
  return all;
}

/// CIELAB under D65.
Eigen::Vector3d lab_of(Colour colour, const Vision& vision) {
  const auto linear = [](std::uint8_t channel) {
    const double c = channel / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  Eigen::Matrix3d to_xyz;
  to_xyz << 0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920,
      0.9503041;
  const Eigen::Vector3d light(linear(colour.red), linear(colour.green), linear(colour.blue));
  const Eigen::Vector3d seen = (vision * light).cwiseMax(0.0).cwiseMin(1.0);
  Eigen::Vector3d f = (to_xyz * seen).cwiseQuotient(Eigen::Vector3d(0.95047, 1.0, 1.08883));
  for (double& t : f) t = t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0;
  return {116.0 * f(1) - 16.0, 500.0 * (f(0) - f(1)), 200.0 * (f(1) - f(2))};
}

/// The difference of two colours of CIELAB, CIEDE2000 [sharma2005].
double difference(const Eigen::Vector3d& one, const Eigen::Vector3d& other) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  const auto seventh = [](double c) {
    return std::sqrt(std::pow(c, 7) / (std::pow(c, 7) + 6103515625.0));
  };
  const double g = 0.5 * (1.0 - seventh((one.tail<2>().norm() + other.tail<2>().norm()) / 2.0));
  const double a1 = (1.0 + g) * one(1), a2 = (1.0 + g) * other(1);
  const double c1 = std::hypot(a1, one(2)), c2 = std::hypot(a2, other(2));
  const auto hue = [&](double a, double b) {
    const double angle = a == 0.0 && b == 0.0 ? 0.0 : std::atan2(b, a) / kDegree;
    return angle < 0.0 ? angle + 360.0 : angle;
  };
  const double h1 = hue(a1, one(2)), h2 = hue(a2, other(2));
  const bool is_grey = c1 * c2 == 0.0;
  double turn = is_grey ? 0.0 : h2 - h1;
  if (turn > 180.0) turn -= 360.0;
  if (turn < -180.0) turn += 360.0;
  double h = h1 + h2;
  if (!is_grey && std::abs(h1 - h2) > 180.0) h += h < 360.0 ? 360.0 : -360.0;
  if (!is_grey) h /= 2.0;
  const double lightness = (one(0) + other(0)) / 2.0 - 50.0, c = (c1 + c2) / 2.0;
  const double t = 1.0 - 0.17 * std::cos((h - 30.0) * kDegree) +
                   0.24 * std::cos(2.0 * h * kDegree) + 0.32 * std::cos((3.0 * h + 6.0) * kDegree) -
                   0.2 * std::cos((4.0 * h - 63.0) * kDegree);
  const double square = lightness * lightness;
  const double of_lightness =
      (other(0) - one(0)) / (1.0 + 0.015 * square / std::sqrt(20.0 + square));
  const double of_chroma = (c2 - c1) / (1.0 + 0.045 * c);
  const double of_hue =
      2.0 * std::sqrt(c1 * c2) * std::sin(turn / 2.0 * kDegree) / (1.0 + 0.015 * c * t);
  const double bend = std::exp(-std::pow((h - 275.0) / 25.0, 2));
  const double rotation = -2.0 * seventh(c) * std::sin(60.0 * bend * kDegree);
  return std::sqrt(of_lightness * of_lightness + of_chroma * of_chroma + of_hue * of_hue +
                   rotation * of_chroma * of_hue);
}

TEST(Palette, DifferencesAreThoseOfThePublishedTestData) {
  // Pairs 1, 7, 17 and 25 of [sharma2005, Table 1].
  EXPECT_NEAR(difference({50.0, 2.6772, -79.7751}, {50.0, 0.0, -82.7485}), 2.0425, 1e-4);
  EXPECT_NEAR(difference({50.0, 0.0, 0.0}, {50.0, -1.0, 2.0}), 2.3669, 1e-4);
  EXPECT_NEAR(difference({50.0, 2.5, 0.0}, {73.0, 25.0, -18.0}), 27.1492, 1e-4);
  EXPECT_NEAR(difference({60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}), 1.2644, 1e-4);
}

/// Of all pairs of ten colours the least difference.
double nearest_pair(const std::array<Colour, kSeriesCount>& colours, const Vision& vision) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < colours.size(); ++i)
    for (std::size_t j = i + 1; j < colours.size(); ++j)
      least = std::min(least, difference(lab_of(colours[i], vision), lab_of(colours[j], vision)));
  return least;
}

TEST(Palette, TenSeriesDifferForReadersWithAndWithoutAllCones) {
  // With all cones, protanopia, deuteranopia; dash and marker differ, too.
  const std::array<double, 3> light = {21.5, 9.7, 12.6}, dark = {15.2, 9.1, 10.8};
  for (std::size_t k = 0; k < visions().size(); ++k) {
    EXPECT_NEAR(nearest_pair(kSeriesColours, visions()[k]), light[k], 0.06) << "vision " << k;
    EXPECT_NEAR(nearest_pair(kDarkSeriesColours, visions()[k]), dark[k], 0.06) << "vision " << k;
  }
}

TEST(Palette, ViridisGrowsLighterAllTheWay) {
  EXPECT_EQ(viridis(0.0), colour(0x440154));
  EXPECT_EQ(viridis(1.0), colour(0xFDE725));
  EXPECT_EQ(viridis(-3.0), viridis(0.0));
  EXPECT_EQ(viridis(NAN), viridis(0.0));
  EXPECT_EQ(viridis(7.0), viridis(1.0));
  for (int i = 0; i < 50; ++i)
    EXPECT_LT(luminance(viridis(i / 50.0)), luminance(viridis((i + 1) / 50.0))) << i;
}

TEST(Theme, TextAndLinesCanBeRead) {
  for (const Theme& theme : {report_theme(), dark_theme(), paper_theme(3.25)}) {
    EXPECT_GE(contrast(theme.text, theme.background), 4.5);
    EXPECT_GE(contrast(theme.warning, theme.background), 4.5);
    EXPECT_GE(contrast(theme.muted, theme.background), 3.0);
  }
}

TEST(Theme, LinesOfReferenceStandOutFromADarkPage) {
  const Theme dark = dark_theme();
  EXPECT_GE(contrast(dark.of(ThemeColour::kFaint), dark.background), 3.0);
  // Dots and gaps as the eye takes them together.
  const std::vector<double> lengths = dash_lengths(Dash::kDotted, 1.0);
  const Colour seen = mix(dark.of_dashed(ThemeColour::kMuted), dark.background,
                          lengths.at(0) / (lengths.at(0) + lengths.at(1)));
  EXPECT_GE(contrast(seen, dark.background), 3.0) << hex(seen);
  EXPECT_EQ(hex(report_theme().of_dashed(ThemeColour::kMuted)), hex(report_theme().muted));
}

TEST(Theme, GivesDottedLinesTheColourOfLinesWithGaps) {
  const Theme dark = dark_theme();
  const auto of = [&](Dash dash) {
    return hex(stroke_of(ThemeColour::kMuted, dash, 1.0, dark).colour);
  };
  EXPECT_EQ(of(Dash::kSolid), hex(dark.muted));
  EXPECT_EQ(of(Dash::kDotted), hex(dark.of_dashed(ThemeColour::kMuted)));
}

TEST(Theme, PaperHasTheWidthOfItsColumn) {
  EXPECT_DOUBLE_EQ(paper_theme(3.25).width_pt, 234.0);
  EXPECT_DOUBLE_EQ(paper_theme(6.75).width_pt, 486.0);
  EXPECT_DOUBLE_EQ(paper_theme(6.75).font_pt, 8.0);
  for (const double width : {0.0, 1.9, 21.0, -1.0, std::nan("")})
    EXPECT_THROW(paper_theme(width), InvalidInput);
}

TEST(Ticks, StepsAreOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(tick_step(0.0, 10.0, 6), 2.0);
  EXPECT_DOUBLE_EQ(tick_step(0.0, 1.0, 4), 0.5);
  EXPECT_DOUBLE_EQ(tick_step(-3.0, 3.0, 7), 1.0);
  EXPECT_DOUBLE_EQ(tick_step(0.0, 2000.0, 5), 500.0);
}

TEST(Ticks, AreAtLeastTwoAndOtherwiseNotMoreThanAskedFor) {
  for (const int most : {2, 3, 5, 9})
    for (double width = 1e-9; width < 1e9; width *= 3.7)
      for (const double low : {-7.3 * width, 0.0, 0.31 * width}) {
        const double step = tick_step(low, low + width, most);
        const std::size_t count = linear_ticks(low, low + width, step).at.size();
        EXPECT_GE(count, 2U) << low << ' ' << width;
        EXPECT_LE(count, static_cast<std::size_t>(std::max(most, 4))) << low << ' ' << width;
      }
}

TEST(Ticks, LabelsShareTheirDecimalsAndUseTheMinusSign) {
  const Ticks ticks = linear_ticks(-1.0, 1.0, 0.5);
  EXPECT_EQ(ticks.labels, (std::vector<std::string>{"−1.0", "−0.5", "0.0", "0.5", "1.0"}));
}

TEST(Ticks, LargeAndSmallValuesShareAFactor) {
  const Ticks large = linear_ticks(0.0, 4e7, 1e7);
  EXPECT_EQ(large.labels, (std::vector<std::string>{"0", "1", "2", "3", "4"}));
  EXPECT_EQ(large.factor, "×10⁷");
  EXPECT_EQ(linear_ticks(0.0, 4e-7, 2e-7).factor, "×10⁻⁷");
}

TEST(Ticks, HaveTheirThousandsApartFromTenThousandOn) {
  EXPECT_EQ(linear_ticks(0.0, 30000.0, 10000.0).labels,
            (std::vector<std::string>{"0", "10,000", "20,000", "30,000"}));
  EXPECT_EQ(linear_ticks(-12000.0, 0.0, 6000.0).labels,
            (std::vector<std::string>{"−12,000", "−6,000", "0"}));
  EXPECT_EQ(linear_ticks(0.0, 8000.0, 4000.0).labels,
            (std::vector<std::string>{"0", "4000", "8000"}));
}

TEST(Ticks, CoordinatesFarFromZeroAreLabelledBeyondARoundOffset) {
  const Ticks northing = linear_ticks(5821210.0, 5821290.0, 20.0);
  EXPECT_EQ(northing.labels, (std::vector<std::string>{"20", "40", "60", "80"}));
  EXPECT_EQ(northing.at, (std::vector<double>{5821220, 5821240, 5821260, 5821280}));
  EXPECT_EQ(northing.factor, "+ 5,821,200");
  const Ticks south = linear_ticks(-391290.0, -391210.0, 20.0);
  EXPECT_EQ(south.labels, (std::vector<std::string>{"20", "40", "60", "80"}));
  EXPECT_EQ(south.factor, "\u2212 391,300");
  EXPECT_EQ(linear_ticks(10020.0, 10080.0, 20.0).factor, "");
}

TEST(Ticks, DecadesAreLabelledOnALogAxis) {
  const Ticks ticks = log_ticks(0.01, 100.0, 8);
  EXPECT_EQ(ticks.labels, (std::vector<std::string>{"0.01", "0.1", "1", "10", "100"}));
  EXPECT_FALSE(ticks.minor.empty());
}

TEST(Ticks, OfOneLogAxisAreAllPlainOrAllPowers) {
  EXPECT_EQ(log_ticks(90.0, 2e5, 8).labels, (std::vector<std::string>{"10²", "10³", "10⁴", "10⁵"}));
  EXPECT_EQ(log_ticks(0.5, 2e4, 8).labels,
            (std::vector<std::string>{"1", "10", "100", "1,000", "10,000"}));
  EXPECT_EQ(log_ticks(3e5, 3e6, 8).labels, (std::vector<std::string>{"5×10⁵", "10⁶", "2×10⁶"}));
}

TEST(Ticks, ManyDecadesAreThinned) {
  const Ticks ticks = log_ticks(1e-12, 1e12, 6);
  EXPECT_LE(ticks.at.size(), 6u);
  EXPECT_GE(ticks.at.size(), 3u);
  EXPECT_EQ(ticks.labels.front(), "10⁻¹²");
}

TEST(Ticks, ThreeOfALogAxisAreFarFromEachOther) {
  EXPECT_EQ(three_log_ticks(0.045, 5.2).labels, (std::vector<std::string>{"0.05", "0.5", "5"}));
  EXPECT_EQ(three_log_ticks(600.0, 3000.0).labels,
            (std::vector<std::string>{"600", "1000", "3000"}));
}

TEST(Ticks, EveryLogAxisHasThreeLabelsWithinIt) {
  for (const int most : {2, 3, 6, 9})
    for (const double low : {1.1, 0.07, 3.0, 95.0})
      for (const double factor : {1.2, 2.0, 4.0, 9.0, 40.0, 1e3, 3e4, 1e9}) {
        const Ticks ticks = log_ticks(low, low * factor, most);
        EXPECT_GE(ticks.at.size(), 3U) << low << " x " << factor << ", " << most;
        EXPECT_GE(ticks.at.front(), low * (1 - 1e-9));
        EXPECT_LE(ticks.at.back(), low * factor * (1 + 1e-9));
        EXPECT_EQ(ticks.at.size(), ticks.labels.size());
      }
}

TEST(VisibleText, LeavesOrdinaryTextAlone) {
  EXPECT_EQ(visible_text("Straße 7 − ναι 😀 שלום"), "Straße 7 − ναι 😀 שלום");
}

TEST(VisibleText, ShowsCodePointsThatTheFontLacks) {
  EXPECT_EQ(visible_text("a\U0001F9ED"), "a[U+1F9ED]");
  EXPECT_EQ(visible_text("\u6C34"), "[U+6C34]");
}

TEST(VisibleText, ShowsWhatTurnsTheDirectionOrIsInvisible) {
  EXPECT_EQ(visible_text("a\u202Eb\u2066c\u200Fd"), "a[U+202E]b[U+2066]c[U+200F]d");
  EXPECT_EQ(visible_text("a\u200Bb\uFEFF\u00AD"), "a[U+200B]b[U+FEFF][U+00AD]");
  EXPECT_EQ(visible_text("a\nb\tc\x7F"), "a[U+000A]b[U+0009]c[U+007F]");
}

TEST(VisibleText, ShowsBytesThatAreNoUtf8) {
  EXPECT_EQ(visible_text("\xFF\xFE a \xC3"), "[xFF][xFE] a [xC3]");
  EXPECT_EQ(visible_text("\xED\xA0\x80\xC0\xAF"), "[xED][xA0][x80][xC0][xAF]");
}

TEST(VisibleText, StacksAtMostTwoMarksOnALetter) {
  EXPECT_EQ(visible_text("e\u0301\u0301\u0301"), "e\u0301\u0301[U+0301]");
}

TEST(ShapedText, HasOneGlyphForEachLetterAndNoneMissing) {
  const ShapedText shaped = shape_text("office");
  EXPECT_EQ(shaped.glyphs.size(), 6u);
  for (const Glyph& glyph : shaped.glyphs) EXPECT_NE(glyph.index, 0u);
  EXPECT_GT(shaped.advance, shape_text("ofic").advance);
  EXPECT_LE(shaped.bounds.x1, shaped.advance + 0.1);
}

TEST(ShapedText, ClustersCoverAllBytesAndGlyphs) {
  for (const char* text : {"a", "ab שלום cd", "שלום 12 עולם", "é́x", "[U+1F600]", ""}) {
    const ShapedText shaped = shape_text(text);
    std::size_t bytes = 0, glyphs = 0;
    for (const TextRun& run : shaped.runs)
      for (const Cluster& cluster : run.clusters) bytes += cluster.bytes, glyphs += cluster.glyphs;
    EXPECT_EQ(bytes, shaped.text.size()) << text;
    EXPECT_EQ(glyphs, shaped.glyphs.size()) << text;
  }
}

TEST(ShapedText, HebrewReadsFromRightToLeft) {
  const ShapedText one = shape_text("ש");
  const ShapedText word = shape_text("שלום");
  EXPECT_EQ(word.glyphs.back().index, one.glyphs.front().index);
}

TEST(ShapedText, IsElidedToTheWidthItIsGiven) {
  const std::string text = "the landmark beside the third window, L33";
  const ShapedText end = shape_text_within(text, 8.0);
  EXPECT_LE(end.advance, 8.0);
  EXPECT_TRUE(end.text.starts_with("the land") && end.text.ends_with("…")) << end.text;
  const ShapedText middle = shape_text_within(text, 8.0, Elide::kMiddle);
  EXPECT_LE(middle.advance, 8.0);
  EXPECT_TRUE(middle.text.starts_with("the") && middle.text.ends_with("L33")) << middle.text;
  EXPECT_EQ(shape_text_within(text, 1000.0).text, text);
}

TEST(ShapedText, OfTenThousandBytesIsShapedInParts) {
  const ShapedText shaped = shape_text_within(std::string(10240, 'W'), 20.0);
  EXPECT_LE(shaped.advance, 20.0);
  EXPECT_LT(shaped.glyphs.size(), 40u);
}

TEST(WrappedText, BreaksAtBlanksAndElidesTheLastLine) {
  const auto lines = wrap_text("one two three four five six seven eight nine ten", 6.0, 2);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].text, "one two");
  EXPECT_TRUE(lines[1].text.ends_with("…")) << lines[1].text;
  for (const ShapedText& line : lines) EXPECT_LE(line.advance, 6.0);
  EXPECT_TRUE(wrap_text("", 6.0, 2).empty());
}

TEST(WrapText, KeepsEquationsAndNumbersWithTheirUnitsTogether) {
  for (double width = 4.0; width < 14.0; width += 0.5)
    for (const ShapedText& line : wrap_text("SDE, K = 7 errs by 0.12 m there", width, 9)) {
      EXPECT_FALSE(line.text.ends_with("=") || line.text.ends_with("K") ||
                   line.text.ends_with("0.12"))
          << line.text;
    }
}

TEST(WrapText, BreaksWordsThatNeverFitIfItMayBreakAnywhere) {
  const std::string name = "graph_slam/with_switchable_constraints and Kovarianzmatrizenskalierung";
  std::string joined;
  for (const ShapedText& line : wrap_text(name, 6.0, 20, nullptr, WordBreak::kAnywhere)) {
    EXPECT_LE(line.advance, 6.0) << line.text;
    joined += line.text;
  }
  std::string without_blanks = name;
  std::erase(without_blanks, ' ');
  EXPECT_EQ(joined, without_blanks);
  const auto lines = wrap_text(name, 8.0, 20);
  EXPECT_EQ(lines[0].text, "graph_slam/") << "a word ends behind a dash, \"_\" or \"/\"";
  EXPECT_TRUE(lines.back().text.ends_with("\u2026")) << lines.back().text;
}

TEST(WrapText, DoesNotBreakAnEquationThatNeverFits) {
  const auto lines = wrap_text("K = 1234567 errs", 3.0, 9);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].text, "K =…");
  EXPECT_EQ(lines[1].text, "errs");
}

}  // namespace
}  // namespace mapproof
