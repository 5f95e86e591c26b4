#include "render/theme/font.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <string_view>

#include <fmt/format.h>
#include <hb-ot.h>
#include <hb.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/utf8.hpp"

namespace mapproof {

std::span<const Resource> font_resources();

namespace {

constexpr std::size_t kMostMarks = 2;         // Combining marks on one letter; more is mischief.
constexpr std::size_t kMostCodePoints = 400;  // Of one line; no figure is wider.

struct BufferDelete {
  void operator()(hb_buffer_t* buffer) const { hb_buffer_destroy(buffer); }
};
using Buffer = std::unique_ptr<hb_buffer_t, BufferDelete>;

/// The font as HarfBuzz sees it, never changed, so that threads may share it; null if it cannot
/// draw.
hb_font_t* font_of(std::string_view bytes) {
  hb_blob_t* blob = hb_blob_create(bytes.data(), static_cast<unsigned>(bytes.size()),
                                   HB_MEMORY_MODE_READONLY, nullptr, nullptr);
  hb_face_t* face = hb_face_create(blob, 0);
  hb_blob_destroy(blob);
  hb_font_t* made = hb_font_create(face);
  hb_ot_font_set_funcs(made);
  const int units = static_cast<int>(FontFacts::kUnitsPerEm);
  hb_font_set_scale(made, units, units);
  hb_font_make_immutable(made);
  // What HarfBuzz finds no memory for is empty for good, in silence. These make its tables.
  hb_codepoint_t glyph = 0;
  hb_glyph_extents_t extents{};
  hb_ot_layout_has_substitution(face);
  hb_ot_layout_has_positioning(face);
  const bool is_whole = hb_font_get_nominal_glyph(made, 'A', &glyph) != 0 &&
                        hb_font_get_glyph_h_advance(made, glyph) > 0 &&
                        hb_font_get_glyph_extents(made, glyph, &extents) != 0 && extents.width > 0;
  hb_face_destroy(face);
  if (is_whole) return made;
  hb_font_destroy(made);
  return nullptr;
}

hb_font_t* embedded_font() {
  static hb_font_t* const font = [] {
    hb_font_t* made = font_of(font_bytes());
    if (made == nullptr) throw std::bad_alloc();
    hb_face_t* face = hb_font_get_face(made);
    if (hb_ot_layout_has_substitution(face) && hb_ot_layout_has_positioning(face)) return made;
    hb_font_destroy(made);
    throw std::bad_alloc();
  }();
  return font;
}

hb_font_t* handle_of(const Font* font) {
  return font == nullptr ? embedded_font() : font->handle();
}

bool is_mark(char32_t code) {
  const auto category = hb_unicode_general_category(hb_unicode_funcs_get_default(), code);
  return category == HB_UNICODE_GENERAL_CATEGORY_NON_SPACING_MARK ||
         category == HB_UNICODE_GENERAL_CATEGORY_ENCLOSING_MARK;
}

/// Whether a reader would see the code point as itself.
bool is_seen(char32_t code, hb_font_t* font) {
  if (code < 0x20 || (code >= 0x7F && code < 0xA0)) return false;
  if (code < 0x7F) return true;
  switch (hb_unicode_general_category(hb_unicode_funcs_get_default(), code)) {
    case HB_UNICODE_GENERAL_CATEGORY_CONTROL:
    case HB_UNICODE_GENERAL_CATEGORY_FORMAT:
    case HB_UNICODE_GENERAL_CATEGORY_UNASSIGNED:
    case HB_UNICODE_GENERAL_CATEGORY_PRIVATE_USE:
    case HB_UNICODE_GENERAL_CATEGORY_SURROGATE:
    case HB_UNICODE_GENERAL_CATEGORY_LINE_SEPARATOR:
    case HB_UNICODE_GENERAL_CATEGORY_PARAGRAPH_SEPARATOR:
      return false;
    default:
      break;
  }
  const bool invisible = code == 0x034F || code == 0x115F || code == 0x1160 || code == 0x3164 ||
                         (code >= 0x17B4 && code <= 0x17B5) || (code >= 0x180B && code <= 0x180F) ||
                         (code >= 0xFE00 && code <= 0xFE0F) || (code >= 0xE0000 && code <= 0xE0FFF);
  hb_codepoint_t glyph = 0;
  return !invisible && hb_font_get_nominal_glyph(font, code, &glyph) != 0;
}

bool reads_right_to_left(char32_t code) {
  const hb_script_t script = hb_unicode_script(hb_unicode_funcs_get_default(), code);
  return hb_script_get_horizontal_direction(script) == HB_DIRECTION_RTL;
}

bool is_neutral(char32_t code) {
  const hb_script_t script = hb_unicode_script(hb_unicode_funcs_get_default(), code);
  return script == HB_SCRIPT_COMMON || script == HB_SCRIPT_INHERITED;
}

struct Stretch {
  std::size_t begin = 0;
  std::size_t end = 0;
  bool right_to_left = false;
};

/// The text in stretches of one direction; neutral characters between two stretches that read
/// right to left go with them, digits and all others go left to right.
std::vector<Stretch> stretches(const std::string& text) {
  std::vector<Stretch> found;
  std::string_view rest = text;
  std::size_t neutral_since = std::string::npos;
  while (!rest.empty()) {
    const std::size_t at = text.size() - rest.size();
    const char32_t code = *take_code_point(rest);
    const std::size_t end = text.size() - rest.size();
    const bool digit = code >= '0' && code <= '9';
    if (is_neutral(code) && !digit && !found.empty() && found.back().right_to_left) {
      if (is_mark(code)) {
        found.back().end = end;
        continue;
      }
      if (neutral_since == std::string::npos) neutral_since = at;
      continue;
    }
    const bool backward = reads_right_to_left(code);
    if (backward && neutral_since != std::string::npos) found.back().end = at;
    const std::size_t begin = !backward && neutral_since != std::string::npos ? neutral_since : at;
    neutral_since = std::string::npos;
    if (found.empty() || found.back().right_to_left != backward)
      found.push_back({begin, end, backward});
    else
      found.back().end = end;
  }
  if (neutral_since != std::string::npos) found.push_back({neutral_since, text.size(), false});
  return found;
}

Box glyph_bounds(std::uint32_t glyph, hb_font_t* font) {
  hb_glyph_extents_t e{};
  if (!hb_font_get_glyph_extents(font, glyph, &e) || e.width == 0 || e.height == 0) return {};
  return {e.x_bearing / FontFacts::kUnitsPerEm, -e.y_bearing / FontFacts::kUnitsPerEm,
          (e.x_bearing + e.width) / FontFacts::kUnitsPerEm,
          -(e.y_bearing + e.height) / FontFacts::kUnitsPerEm};
}

/// Glyphs of equal cluster number, in the order of the text.
std::vector<Cluster> clusters_of(std::span<const hb_glyph_info_t> infos, const Stretch& stretch) {
  std::vector<std::pair<std::size_t, std::size_t>> starts;  // Byte, number of glyphs.
  for (const hb_glyph_info_t& glyph : infos) {
    if (starts.empty() || starts.back().first != glyph.cluster)
      starts.emplace_back(glyph.cluster, 0);
    ++starts.back().second;
  }
  if (stretch.right_to_left) std::reverse(starts.begin(), starts.end());
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::size_t end = i + 1 < starts.size() ? starts[i + 1].first : stretch.end;
    clusters.push_back({end - starts[i].first, starts[i].second});
  }
  return clusters;
}

void shape_stretch(const Stretch& stretch, hb_font_t* font, hb_buffer_t* buffer,
                   ShapedText& shaped) {
  static const std::array<hb_feature_t, 2> features = {
      {{HB_TAG('l', 'i', 'g', 'a'), 0, 0, HB_FEATURE_GLOBAL_END},
       {HB_TAG('c', 'l', 'i', 'g'), 0, 0, HB_FEATURE_GLOBAL_END}}};
  hb_buffer_reset(buffer);
  hb_buffer_add_utf8(buffer, shaped.text.data(), static_cast<int>(shaped.text.size()),
                     static_cast<unsigned>(stretch.begin),
                     static_cast<int>(stretch.end - stretch.begin));
  hb_buffer_set_direction(buffer, stretch.right_to_left ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
  hb_buffer_set_language(buffer, hb_language_from_string("en", 2));
  hb_buffer_guess_segment_properties(buffer);
  if (!hb_shape_full(font, buffer, features.data(), features.size(), nullptr) ||
      !hb_buffer_allocation_successful(buffer))
    throw std::bad_alloc();

  unsigned count = 0;
  const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer, &count);
  const hb_glyph_position_t* positions = hb_buffer_get_glyph_positions(buffer, &count);
  shaped.runs.push_back({stretch.begin, shaped.glyphs.size(), stretch.right_to_left,
                         clusters_of({infos, count}, stretch)});
  for (unsigned i = 0; i < count; ++i) {
    const Glyph glyph{infos[i].codepoint,
                      shaped.advance + positions[i].x_offset / FontFacts::kUnitsPerEm,
                      -positions[i].y_offset / FontFacts::kUnitsPerEm};
    const Box bounds = glyph_bounds(glyph.index, font);
    if (bounds.width() > 0.0) {
      const Box placed = bounds.moved(glyph.x, glyph.y);
      shaped.bounds = shaped.bounds.width() > 0.0 ? shaped.bounds.united(placed) : placed;
    }
    shaped.glyphs.push_back(glyph);
    shaped.advance += positions[i].x_advance / FontFacts::kUnitsPerEm;
  }
}

ShapedText shape_visible(std::string text, const Font* font) {
  static thread_local const Buffer buffer(hb_buffer_create());
  ShapedText shaped;
  shaped.text = std::move(text);
  shaped.glyphs.reserve(shaped.text.size());
  for (const Stretch& stretch : stretches(shaped.text))
    shape_stretch(stretch, handle_of(font), buffer.get(), shaped);
  return shaped;
}

/// The bytes that the first `count` code points take.
std::size_t prefix_bytes(std::string_view text, std::size_t count) {
  std::string_view rest = text;
  for (; count > 0 && !rest.empty(); --count) take_code_point(rest);
  return text.size() - rest.size();
}

std::size_t count_code_points(std::string_view text) {
  std::size_t count = 0;
  for (; !text.empty(); ++count) take_code_point(text);
  return count;
}

/// Start and end of a text too long for any line.
std::string shortened(std::string_view text) {
  if (text.size() <= kMostCodePoints) return std::string(text);
  const std::size_t length = count_code_points(text);
  if (length <= kMostCodePoints) return std::string(text);
  const std::size_t half = kMostCodePoints / 2;
  return std::string(text.substr(0, prefix_bytes(text, half))) + "…" +
         std::string(text.substr(prefix_bytes(text, length - half)));
}

}  // namespace

Font::Font(std::string bytes, const std::string& name)
    : bytes_(std::move(bytes)), handle_(font_of(bytes_)) {
  const auto refuse = [&](const std::string& what) {
    if (handle_ != nullptr) hb_font_destroy(handle_);
    throw InvalidInput(printable(name) + ": " + what);
  };
  if (handle_ == nullptr) refuse("is not a TrueType or OpenType font that draws letters");
  const auto has = [this](char32_t code) {
    hb_codepoint_t glyph = 0;
    return hb_font_get_nominal_glyph(handle_, code, &glyph) != 0;
  };
  std::string lacking;
  for (char32_t code = ' '; code < 0x7F; ++code)
    if (!has(code)) append_utf8(lacking, code);
  for (const char32_t code : {U'\u2212', U'\u2026'})
    if (!has(code)) append_utf8(lacking, code);
  if (!lacking.empty()) refuse("this font lacks the characters " + lacking);
}

Font::~Font() { hb_font_destroy(handle_); }

std::string_view font_bytes() { return font_resources().front().bytes; }

std::string visible_text(std::string_view text, const Font* font) {
  std::string seen;
  seen.reserve(text.size());
  std::size_t marks = kMostMarks;  // A mark at the start has no letter to stand on.
  while (!text.empty()) {
    const auto byte = static_cast<unsigned char>(text[0]);
    const std::optional<char32_t> code = take_code_point(text);
    if (!code) {
      seen += fmt::format("[x{:02X}]", byte);
      marks = kMostMarks;
      continue;
    }
    const bool mark = *code >= 0x300 && is_mark(*code);
    marks = mark ? marks + 1 : 0;
    if (is_seen(*code, handle_of(font)) && marks <= kMostMarks)
      append_utf8(seen, *code);
    else
      seen += fmt::format("[U+{:04X}]", static_cast<std::uint32_t>(*code));
  }
  return seen;
}

std::string visible_lines(std::string_view text) {
  std::string seen;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    seen += visible_text(text.substr(0, end)) + "\n";
    text.remove_prefix(end + 1);
  }
  return seen + visible_text(text);
}

ShapedText shape_text(std::string_view text, const Font* font) {
  return shape_text_within(text, kInfinity, Elide::kEnd, font);
}

ShapedText shape_text_within(std::string_view text, double most, Elide elide, const Font* font) {
  // A code point is at least a byte: of a longer text the middle never shows.
  std::string whole = visible_text(shortened(text), font);
  ShapedText shaped = shape_visible(whole, font);
  if (shaped.advance <= most) return shaped;
  // The most code points whose text, with the dots, fits: bisection over their number.
  const std::size_t length = count_code_points(whole);
  std::size_t fits = 0;
  std::size_t too_many = length;
  const auto elided = [&](std::size_t count) {
    const std::size_t tail = elide == Elide::kMiddle ? count / 2 : 0;
    std::string start = whole.substr(0, prefix_bytes(whole, count - tail));
    while (!start.empty() && start.back() == ' ') start.pop_back();
    return shape_visible(start + "…" + whole.substr(prefix_bytes(whole, length - tail)), font);
  };
  while (too_many - fits > 1) {
    const std::size_t middle = (fits + too_many) / 2;
    (elided(middle).advance <= most ? fits : too_many) = middle;
  }
  return elided(fits);
}

namespace {

/// Whether a line may end at a blank: not within "K = 7" or "0.12 m".
bool may_end_line(std::string_view text, std::size_t blank) {
  constexpr std::array<std::string_view, 15> kUnits = {
      "m", "mm", "cm", "km", "m²", "s", "ms", "µs", "min", "h", "Hz", "rad", "%", "ppm", "MiB"};
  const std::string_view rest = text.substr(blank + 1);
  if (rest.starts_with("= ") || text.substr(0, blank).ends_with(" =")) return false;
  const bool is_number = blank > 0 && text[blank - 1] >= '0' && text[blank - 1] <= '9';
  const std::string_view word = rest.substr(0, rest.find_first_of(" ,;:)"));
  return !is_number || std::ranges::find(kUnits, word) == kUnits.end();
}

/// The size of the longest start of a word that fits, of one character at least.
std::size_t part_that_fits(std::string_view word, double most, const Font* font) {
  std::size_t fits = 1, too_many = std::min(count_code_points(word), kMostCodePoints) + 1;
  while (too_many - fits > 1) {
    const std::size_t middle = (fits + too_many) / 2;
    const std::string_view start = word.substr(0, prefix_bytes(word, middle));
    (shape_text(start, font).advance <= most ? fits : too_many) = middle;
  }
  return prefix_bytes(word, fits);
}

/// The size of the longest start of a word that ends with a dash and fits; 0 if none does.
std::size_t part_of_word(std::string_view word, double most, const Font* font) {
  std::size_t size = 0;
  for (const std::string_view dash : {"-", "\u2013", "_", "/"})
    for (std::size_t at = word.find(dash, 1); at != std::string_view::npos;
         at = word.find(dash, at + 1))
      if (const std::size_t end = at + dash.size();
          end > size && end < word.size() && shape_text(word.substr(0, end), font).advance <= most)
        size = end;
  return size;
}

}  // namespace

std::vector<ShapedText> wrap_text(std::string_view text, double most, std::size_t lines,
                                  const Font* font, WordBreak word_break) {
  std::vector<ShapedText> wrapped;
  while (!text.empty() && wrapped.size() < lines) {
    if (wrapped.size() + 1 == lines || shape_text(text, font).advance <= most) {
      wrapped.push_back(shape_text_within(text, most, Elide::kEnd, font));
      break;
    }
    // The longest start that ends before a blank and fits; a word that never fits is broken, or is
    // elided.
    std::size_t end = std::string_view::npos;
    for (std::size_t blank = text.find(' '); blank != std::string_view::npos;
         blank = text.find(' ', blank + 1)) {
      if (!may_end_line(text, blank)) continue;
      const bool fits = shape_text(text.substr(0, blank), font).advance <= most;
      if (fits || end == std::string_view::npos) end = blank;
      if (!fits) break;
    }
    end = std::min(end, text.size());
    if (const std::string_view word = text.substr(0, end); shape_text(word, font).advance > most) {
      std::size_t part = part_of_word(word, most, font);
      if (part == 0 && word_break == WordBreak::kAnywhere) part = part_that_fits(word, most, font);
      if (part > 0) {
        wrapped.push_back(shape_text(text.substr(0, part), font));
        text.remove_prefix(part);
        if (part == end && !text.empty()) text.remove_prefix(1);  // The blank.
        continue;
      }
    }
    wrapped.push_back(shape_text_within(text.substr(0, end), most, Elide::kEnd, font));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return wrapped;
}

Outline glyph_outline(std::uint32_t glyph, const Font* font) {
  static hb_draw_funcs_t* const pen = [] {
    hb_draw_funcs_t* made = hb_draw_funcs_create();
    hb_draw_funcs_set_move_to_func(
        made,
        [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, float x, float y, void*) {
          static_cast<Outline*>(path)->move_to({x, -y});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_line_to_func(
        made,
        [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, float x, float y, void*) {
          static_cast<Outline*>(path)->line_to({x, -y});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_quadratic_to_func(
        made,
        [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, float cx, float cy, float x, float y,
           void*) {
          static_cast<Outline*>(path)->quad_to({cx, -cy}, {x, -y});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_cubic_to_func(
        made,
        [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, float ax, float ay, float bx, float by,
           float x, float y, void*) {
          static_cast<Outline*>(path)->cubic_to({ax, -ay}, {bx, -by}, {x, -y});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_close_path_func(
        made,
        [](hb_draw_funcs_t*, void* path, hb_draw_state_t*, void*) {
          static_cast<Outline*>(path)->close();
        },
        nullptr, nullptr);
    hb_draw_funcs_make_immutable(made);
    return made;
  }();
  Outline path;
#if HB_VERSION_ATLEAST(7, 0, 0)
  hb_font_draw_glyph(handle_of(font), glyph, pen, &path);
#else
  hb_font_get_glyph_shape(handle_of(font), glyph, pen, &path);
#endif
  return path;
}

}  // namespace mapproof
