#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/resource.hpp"
#include "render/base/geometry.hpp"

struct hb_font_t;

namespace mapproof {

/// Measures of the embedded font, DejaVu Sans, by which lines are set whatever the font. All
/// lengths here are in em, y downward, the baseline at 0.
struct FontFacts {
  static constexpr double kAscent = 0.76;   ///< Of "d" and capitals.
  static constexpr double kDescent = 0.24;  ///< Of "g".
  static constexpr double kCapHeight = 0.729;
  static constexpr double kXHeight = 0.547;
  static constexpr double kUnitsPerEm = 2048.0;  ///< Of glyph_outline(), of any font.
  static constexpr double kLine = 1.3;           ///< From baseline to baseline.
};

/// A font file, read once: TrueType or OpenType. Threads may share it.
class Font {
 public:
  /// @param name  Of the file, for messages.
  /// @throws InvalidInput if the bytes are no font that draws, or if it lacks a character that
  ///         figures cannot do without: ASCII, the minus sign, the ellipsis.
  Font(std::string bytes, const std::string& name);
  ~Font();
  Font(const Font&) = delete;
  Font& operator=(const Font&) = delete;

  std::string_view bytes() const { return bytes_; }
  /// As HarfBuzz sees it.
  hb_font_t* handle() const { return handle_; }

 private:
  std::string bytes_;
  hb_font_t* handle_ = nullptr;
};

/// What a theme and a drawing hold; none: the embedded font.
using FontHandle = std::shared_ptr<const Font>;

struct Glyph {
  std::uint32_t index = 0;
  double x = 0.0;
  double y = 0.0;
};

/// Neighbouring glyphs that stand for neighbouring bytes and cannot be distinguished further.
struct Cluster {
  std::size_t bytes = 0;
  std::size_t glyphs = 0;
};

/// Text of one direction, in the order of `glyphs`; clusters in the order of the text.
struct TextRun {
  std::size_t first_byte = 0;
  std::size_t first_glyph = 0;
  bool right_to_left = false;
  std::vector<Cluster> clusters;
};

/// One line of text as glyphs.
struct ShapedText {
  std::string text;  ///< UTF-8 that is seen: nothing in it is invisible or missing from the font.
  std::vector<Glyph> glyphs;
  std::vector<TextRun> runs;
  double advance = 0.0;
  Box bounds;
};

// Where a font is left out below, it is the embedded one.

/// What is drawn for `text`: code points that the font lacks, that are invisible or that would
/// reverse the direction are written out as "[U+1F600]", bytes that are no UTF-8 as "[xFF]".
std::string visible_text(std::string_view text, const Font* font = nullptr);

/// As visible_text, line by line, the line feeds kept.
std::string visible_lines(std::string_view text);

/// `text` made visible and shaped. Safe from any thread.
ShapedText shape_text(std::string_view text, const Font* font = nullptr);

/// What a text loses when there is no room for all of it.
enum class Elide { kEnd, kMiddle };

/// As shape_text; if that is wider than `most`, as much of it as fits, and "…" for the rest.
ShapedText shape_text_within(std::string_view text, double most, Elide elide = Elide::kEnd,
                             const Font* font = nullptr);

/// Where a line may end within a word that is wider than it.
enum class WordBreak {
  kBehindDashes,  ///< And behind "_" and "/"; without one of them the word is elided.
  kAnywhere,      ///< Where there is none of them.
};

/// The words of `text` in lines no wider than `most`, at most `lines` of them, the last one elided.
/// No line ends within "K = 7", or between a number and its unit; within a word only if that is too
/// wide.
std::vector<ShapedText> wrap_text(std::string_view text, double most, std::size_t lines,
                                  const Font* font = nullptr,
                                  WordBreak word_break = WordBreak::kBehindDashes);

/// The outline of a glyph of the font, in units of 1/2048 em, y downward. Safe from any thread.
Outline glyph_outline(std::uint32_t glyph, const Font* font = nullptr);

/// The file of the embedded font.
std::string_view font_bytes();

}  // namespace mapproof
