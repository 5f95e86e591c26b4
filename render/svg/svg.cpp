#include "render/svg/svg.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/text/base64.hpp"
#include "core/base/text/markup.hpp"
#include "core/base/text/utf8.hpp"
#include "render/image/palette.hpp"
#include "render/image/png.hpp"

namespace mapproof {
namespace {

bool forbidden(char32_t code) {
  return (code < 0x20 && code != '\t' && code != '\n' && code != '\r') || code == 0xFFFE ||
         code == 0xFFFF;
}

/// Writes a path's data, each point relative to the one before in whole steps of `scale`, so that
/// rounding never adds up.
void append_path(std::string& out, const Outline& path, double scale) {
  long long x = 0, y = 0;
  long long start_x = 0, start_y = 0;
  std::size_t next = 0;
  const auto number = [&](long long steps) {
    if (steps >= 0 && out.back() >= '.' && out.back() <= '9') out += ' ';
    append_number(out, static_cast<double>(steps) * scale);
  };
  const auto point = [&](std::size_t index) {
    const Point p = path.points[index];
    return std::pair{std::llround(p.x / scale), std::llround(p.y / scale)};
  };
  for (const PathCommand command : path.commands) {
    if (command == PathCommand::kClose) {
      out += 'z';
      x = start_x;
      y = start_y;
      continue;
    }
    const std::size_t count = command == PathCommand::kCubic  ? 3
                              : command == PathCommand::kQuad ? 2
                                                              : 1;
    out += command == PathCommand::kMove   ? 'm'
           : command == PathCommand::kLine ? 'l'
           : command == PathCommand::kQuad ? 'q'
                                           : 'c';
    for (std::size_t i = 0; i < count; ++i) {
      const auto [px, py] = point(next + i);
      number(px - x);
      number(py - y);
    }
    next += count;
    std::tie(x, y) = point(next - 1);
    if (command == PathCommand::kMove) std::tie(start_x, start_y) = std::pair{x, y};
  }
}

class SvgWriter {
 public:
  explicit SvgWriter(const Drawing& drawing) : drawing_(drawing) {}

  std::string write() {
    out_.reserve(96 * drawing_.items.size() + 24000);
    open_root();
    write_definitions();
    write_background();
    for (std::size_t i = 0; i < drawing_.items.size(); ++i) write_item(i);
    close_mark();
    close_group();
    out_ += "</svg>\n";
    return std::move(out_);
  }

 private:
  void attribute(std::string_view name, std::string_view text) {
    out_ += ' ';
    out_ += name;
    out_ += "=\"";
    append_xml(out_, text);
    out_ += '"';
  }

  void attribute(std::string_view name, double value) {
    out_ += ' ';
    out_ += name;
    out_ += "=\"";
    append_number(out_, value);
    out_ += '"';
  }

  void open_root() {
    out_ += "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 ";
    append_number(out_, drawing_.width);
    out_ += ' ';
    append_number(out_, drawing_.height);
    out_ += "\" width=\"";
    append_number(out_, drawing_.width);
    out_ += "pt\" height=\"";
    append_number(out_, drawing_.height);
    out_ += "pt\" role=\"img\"";
    attribute("id", drawing_.id);
    attribute("aria-labelledby", drawing_.id + "-title " + drawing_.id + "-desc");
    std::string records;
    for (const std::string& id : drawing_.record_ids) (records += records.empty() ? "" : " ") += id;
    if (!records.empty()) attribute("data-records", records);
    if (drawing_.varies) attribute("data-varies", "true");
    if (!drawing_.renderer.empty()) attribute("data-renderer", drawing_.renderer);
    out_ += ">\n<title id=\"" + drawing_.id + "-title\">";
    append_xml(out_, drawing_.title);
    out_ += "</title>\n<desc id=\"" + drawing_.id + "-desc\">";
    append_xml(out_, drawing_.alt);
    out_ += "</desc>\n";
  }

  void write_definitions() {
    out_ += "<defs>\n";
    for (const std::uint32_t glyph : used_glyphs()) {
      out_ += fmt::format("<path id=\"{}-g{}\" d=\"", drawing_.id, glyph);
      append_path(out_, glyph_outline(glyph, drawing_.font.get()), 1.0);
      out_ += "\"/>\n";
    }
    for (std::size_t i = 0; i < drawing_.symbols.size(); ++i) {
      const Shape& symbol = drawing_.symbols[i];
      const bool round = symbol.circle_radius > 0.0;
      out_ += fmt::format("<{} id=\"{}-s{}\"", round ? "circle" : "path", drawing_.id, i);
      out_ += paint_of(symbol);
      round ? attribute("r", symbol.circle_radius) : path_attribute(symbol.path);
      out_ += "/>\n";
    }
    for (std::size_t i = 0; i < drawing_.frames.size(); ++i) {
      out_ += fmt::format("<clipPath id=\"{}-c{}\"><rect", drawing_.id, i);
      box_attributes(drawing_.frames[i]);
      if (i < drawing_.numbers.size()) {
        axis_attribute("data-x", drawing_.numbers[i].x);
        axis_attribute("data-y", drawing_.numbers[i].y);
      }
      out_ += "/></clipPath>\n";
    }
    out_ += "</defs>\n";
  }

  std::vector<std::uint32_t> used_glyphs() const {
    std::vector<std::uint32_t> glyphs;
    for (const Item& item : drawing_.items)
      if (const auto* line = std::get_if<TextLine>(&item.what))
        for (const Glyph& glyph : line->shaped.glyphs) glyphs.push_back(glyph.index);
    std::ranges::sort(glyphs);
    const auto rest = std::ranges::unique(glyphs);
    glyphs.erase(rest.begin(), rest.end());
    return glyphs;
  }

  void write_background() {
    out_ += "<path fill=\"" + hex(drawing_.background) + "\" d=\"m0 0h";
    append_number(out_, drawing_.width);
    out_ += 'v';
    append_number(out_, drawing_.height);
    out_ += "h-";
    append_number(out_, drawing_.width);
    out_ += "z\"/>\n";
  }

  void box_attributes(const Box& box) {
    attribute("x", box.x0);
    attribute("y", box.y0);
    attribute("width", box.width());
    attribute("height", box.height());
  }

  /// "linear 0 2000": what a page needs to count on a part of an axis.
  void axis_attribute(std::string_view name, const std::optional<AxisNumbers>& axis) {
    if (axis)
      attribute(name,
                fmt::format("{} {:.12g} {:.12g}", axis->scale == Scale::kLog ? "log" : "linear",
                            axis->ends.low, axis->ends.high));
  }

  void path_attribute(const Outline& path) {
    out_ += " d=\"";
    append_path(out_, path, 0.01);
    out_ += '"';
  }

  static std::string paint_of(const Shape& shape) {
    std::string text = " fill=\"" + (shape.fill ? hex(*shape.fill) : "none") + '"';
    const auto number = [&text](std::string_view name, double value) {
      text += fmt::format(" {}=\"", name);
      append_number(text, value);
      text += '"';
    };
    if (shape.fill && shape.fill_opacity < 1.0) number("fill-opacity", shape.fill_opacity);
    if (!shape.stroke) return text;
    text += " stroke=\"" + hex(shape.stroke->colour) + '"';
    number("stroke-width", shape.stroke->width);
    if (shape.stroke->is_round) text += " stroke-linecap=\"round\" stroke-linejoin=\"round\"";
    if (shape.stroke->dashes.empty()) return text;
    text += " stroke-dasharray=\"";
    for (const double length : shape.stroke->dashes) {
      if (text.back() != '"') text += ' ';
      append_number(text, length);
    }
    return text + '"';
  }

  /// What neighbouring items share stands once, on a group around them: their style, or their mark.
  void write_item(std::size_t index) {
    const Item& item = drawing_.items[index];
    std::string style = fmt::format(" class=\"{}\"", name(item.item_class));
    if (item.clipped) style += fmt::format(" clip-path=\"url(#{}-c{})\"", drawing_.id, item.panel);
    if (const auto* shape = std::get_if<Shape>(&item.what)) style += paint_of(*shape);
    if (const auto* line = std::get_if<TextLine>(&item.what))
      style += " fill=\"" + hex(line->colour) + '"';

    const auto& items = drawing_.items;
    const bool continues = item.mark && item.mark == open_mark_;
    const bool starts =
        item.mark && !continues && index + 1 < items.size() && items[index + 1].mark == item.mark;
    if (!continues) close_mark();
    if (starts) open_mark(*item.mark);
    if (!open_mark_) open_group(style);
    const std::string own = open_mark_ ? style : std::string();
    std::visit([&](const auto& what) { write(what, item, own); }, item.what);
  }

  void open_mark(std::size_t mark) {
    close_group();
    out_ += "<g";
    mark_attributes(mark);
    out_ += ">\n";
    open_mark_ = mark;
  }

  void open_group(const std::string& style) {
    if (style == open_group_) return;
    close_group();
    out_ += "<g" + style + ">\n";
    open_group_ = style;
  }

  void mark_attributes(std::size_t index) {
    const Mark& mark = drawing_.marks[index];
    if (!mark.id.empty()) attribute("id", drawing_.id + "-" + mark.id);
    for (const auto& [key, value] : mark.data) attribute("data-" + key, value);
  }

  void write(const Shape& shape, const Item& item, const std::string& own) {
    out_ += "<path" + own;
    if (item.mark && !open_mark_) mark_attributes(*item.mark);
    path_attribute(shape.path);
    out_ += "/>\n";
  }

  void write(const Stamp& stamp, const Item& item, const std::string& own) {
    out_ += "<use" + own;
    if (item.mark && !open_mark_) mark_attributes(*item.mark);
    out_ += fmt::format(" href=\"#{}-s{}\"", drawing_.id, stamp.symbol);
    attribute("x", stamp.at.x);
    attribute("y", stamp.at.y);
    out_ += "/>\n";
  }

  void write(const Raster& raster, const Item& item, const std::string& own) {
    if (raster.image == nullptr) return;
    out_ += "<image" + own;
    if (item.mark && !open_mark_) mark_attributes(*item.mark);
    box_attributes(raster.position);
    const PngOptions options{
        .dpi = 72.0 * raster.image->width / raster.position.width(), .shaded = true, .texts = {}};
    attribute("data-dpi", std::round(options.dpi));
    out_ += " preserveAspectRatio=\"none\" href=\"data:image/png;base64,";
    if (raster.dark == nullptr) {
      append_base64(out_, encode_png(*raster.image, options));
    } else {
      TwoPalettes both = to_two_palettes(*raster.image, *raster.dark);
      append_base64(out_, encode_png({std::move(both.first), std::move(both.rows)},
                                     raster.image->width, options));
      out_ += "\" data-dark=\"";
      append_base64(out_, png_palette(both.second));
    }
    out_ += "\"/>\n";
  }

  void write(const TextLine& line, const Item&, const std::string&) {
    out_ += "<g";
    attribute("aria-label", line.whole.empty() ? line.shaped.text : line.whole);
    out_ += " transform=\"translate(";
    append_number(out_, line.at.x);
    out_ += ' ';
    append_number(out_, line.at.y);
    out_ += line.upward ? ")rotate(-90)" : ")";
    out_ += fmt::format("scale({:.6f})\">", line.size / FontFacts::kUnitsPerEm);
    if (!line.whole.empty()) {
      out_ += "<title>";
      append_xml(out_, line.whole);
      out_ += "</title>";
    }
    for (const Glyph& glyph : line.shaped.glyphs) {
      out_ += fmt::format("<use href=\"#{}-g{}\"", drawing_.id, glyph.index);
      if (glyph.x != 0.0) attribute("x", std::round(glyph.x * FontFacts::kUnitsPerEm));
      if (glyph.y != 0.0) attribute("y", std::round(glyph.y * FontFacts::kUnitsPerEm));
      out_ += "/>";
    }
    out_ += "</g>\n";
  }

  void close_mark() {
    if (open_mark_) out_ += "</g>\n";
    open_mark_.reset();
  }

  void close_group() {
    if (!open_group_.empty()) out_ += "</g>\n";
    open_group_.clear();
  }

  const Drawing& drawing_;
  std::string out_;
  std::string open_group_;
  std::optional<std::size_t> open_mark_;
};

}  // namespace

void append_xml(std::string& out, std::string_view text) {
  while (!text.empty()) {
    const char first = text[0];
    const std::string_view rest = text;
    const std::optional<char32_t> code = take_code_point(text);
    if (!code || forbidden(*code)) {
      out += "\xEF\xBF\xBD";
    } else if (const std::string_view reference = markup_reference(first); !reference.empty()) {
      out += reference;
    } else if (is_hidden(*code)) {
      fmt::format_to(std::back_inserter(out), "&#x{:X};", static_cast<std::uint32_t>(*code));
    } else {
      out += rest.substr(0, rest.size() - text.size());
    }
  }
}

void append_number(std::string& out, double value) {
  // A whole number of hundredths, its digits written out: far faster than a general conversion.
  if (!(std::abs(value) < 1e13)) value = std::copysign(1e13, value);
  long long hundredths = std::llround(value * 100.0);
  if (hundredths < 0) {
    out += '-';
    hundredths = -hundredths;
  }
  const long long whole = hundredths / 100;
  const auto part = static_cast<int>(hundredths % 100);
  if (whole != 0 || part == 0) out += fmt::format_int(whole).c_str();
  if (part == 0) return;
  out += '.';
  out += static_cast<char>('0' + part / 10);
  if (part % 10 != 0) out += static_cast<char>('0' + part % 10);
}

std::string to_svg(const Drawing& drawing) { return SvgWriter(drawing).write(); }

}  // namespace mapproof
