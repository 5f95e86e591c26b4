#include "reports/diff/svg/svg_parser.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <new>

#include <expat.h>
#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "reports/diff/svg/svg_active.hpp"

namespace mapproof {
namespace {

/// Where a parser stands, from 1. Expat has another name for it from 2.9 on.
std::uint64_t line_of(XML_Parser parser) {
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
  return XML_GetCurrentLineNumber64(parser);
#else
  return XML_GetCurrentLineNumber(parser);
#endif
}

constexpr std::string_view kSvg = "http://www.w3.org/2000/svg";

/// White space as one blank, none at the ends.
std::string spaced(std::string_view text) {
  std::string out;
  for (const char c : trimmed(text, kWhiteSpace)) {
    const bool is_space = std::isspace(static_cast<unsigned char>(c));
    if (!is_space)
      out += c;
    else if (out.back() != ' ')
      out += ' ';
  }
  return out;
}

/// Whether the value has one of the bytes. It may be megabytes long: a search for each is quicker
/// than find_first_of().
bool holds_any(std::string_view value, std::string_view bytes) {
  return std::ranges::any_of(bytes, [&](char byte) { return value.find(byte) != value.npos; });
}

/// "name" of SVG's name space or of none, "{space}name" of another.
std::string short_name(const XmlName& name) {
  if (name.space.empty() || name.space == kSvg) return std::string(name.local);
  return fmt::format("{{{}}}{}", name.space, name.local);
}

class Builder {
 public:
  explicit Builder(XML_Parser parser) : parser_(parser) {
    XML_SetUserData(parser, this);
    XML_SetElementHandler(
        parser,
        [](void* self, const char* name, const char** attributes) {
          guarded(self, [&](Builder& builder) { builder.open(name, attributes); });
        },
        [](void* self, const char*) { guarded(self, &Builder::close); });
    XML_SetCharacterDataHandler(parser, [](void* self, const char* text, int length) {
      const std::string_view words(text, static_cast<std::size_t>(length));
      guarded(self, [&](Builder& builder) { builder.characters(words); });
    });
    XML_SetProcessingInstructionHandler(parser, [](void* self, const char* target, const char*) {
      if (lower_case(target) == "xml-stylesheet")
        guarded(self, [](Builder& builder) { builder.refuse("a style sheet of another file"); });
    });
    XML_SetCommentHandler(parser, [](void* self, const char* text) {
      guarded(self, [&](Builder& builder) { builder.comment(text); });
    });
    XML_SetStartDoctypeDeclHandler(
        parser, [](void* self, const char*, const char*, const char*, int has_declarations) {
          if (has_declarations)
            guarded(self, [](Builder& builder) { builder.refuse("declares entities or types"); });
        });
    XML_SetEntityDeclHandler(parser, [](void* self, const char*, int, const char*, int, const char*,
                                        const char*, const char*, const char*) {
      guarded(self, [](Builder& builder) { builder.refuse("declares an entity"); });
    });
  }

  SvgTree tree;
  std::string refusal;
  std::exception_ptr failure;  ///< Of a handler.

 private:
  /// Nothing is thrown through expat.
  template <typename Handler>
  static void guarded(void* self, const Handler& handler) noexcept {
    auto& builder = *static_cast<Builder*>(self);
    try {
      std::invoke(handler, builder);
    } catch (...) {
      builder.failure = std::current_exception();
      XML_StopParser(builder.parser_, XML_FALSE);
    }
  }

  void refuse(const std::string& why) {
    if (!refusal.empty()) return;
    refusal = fmt::format("line {}: {}", line_of(parser_), why);
    XML_StopParser(parser_, XML_FALSE);
  }

  void open(std::string_view full_name, const char** attributes) {
    if (!refusal.empty()) return;
    const int index = static_cast<int>(tree.elements.size());
    if (tree.elements.size() >= kMostSvgElements)
      return refuse(fmt::format("more than {} elements", kMostSvgElements));
    if (open_.size() >= kMostSvgDepth)
      return refuse(fmt::format("elements nested more than {} deep", kMostSvgDepth));
    SvgElement element;
    const XmlName name = xml_name(full_name);
    element.name = short_name(name);
    if (index == 0 && element.name != "svg") return refuse("its root is not a svg element");
    if (const std::string what = active_element(name); !what.empty()) return refuse(what);
    for (; *attributes; attributes += 2) {
      const XmlName attribute = xml_name(attributes[0]);
      const std::string what = active_attribute(name, attribute, attributes[1]);
      if (!what.empty()) return refuse(what);
      if (!add(element, short_name(attribute), attributes[1])) return;
    }
    if (!open_.empty()) {
      element.parent = open_.back();
      tree.elements[element.parent].children.push_back(index);
      element.location = ++locations_.back()[element.name];
    }
    open_.push_back(index);
    locations_.emplace_back();
    tree.elements.push_back(std::move(element));
  }

  void close() {
    if (open_.empty()) return;
    std::string& text = tree.elements[open_.back()].text;
    text = spaced(text);
    if (lower_case(tree.elements[open_.back()].name) == "style" && css_loads(text))
      refuse("a style that loads another file");
    open_.pop_back();
    locations_.pop_back();
  }

  void characters(std::string_view text) {
    if (!open_.empty()) tree.elements[open_.back()].text += text;
  }

  void comment(std::string_view text) {
    if (tree.elements.empty() && tree.generator.empty()) tree.generator = spaced(text);
  }

  /// Whether a value of geometry holds a word for no number, or one too large for any.
  static bool is_no_number(const std::string& name, std::string_view value) {
    static constexpr std::array<std::string_view, 14> kGeometryAttributes = {
        "x", "y", "x1", "y1", "x2", "y2", "cx", "cy", "r", "rx", "ry", "d", "points", "transform"};
    if (std::ranges::find(kGeometryAttributes, name) == kGeometryAttributes.end()) return false;
    if (!holds_any(value, "eEiInN")) return false;
    const std::string text = lower_case(value);
    if (text.find("nan") != std::string::npos || text.find("inf") != std::string::npos) return true;
    for (std::size_t at = text.find('e'); at != std::string::npos; at = text.find('e', at + 1)) {
      int exponent = 0;
      const char* begin = text.data() + at + 1;
      if (*begin == '+') ++begin;
      const auto [end, error] = std::from_chars(begin, text.data() + text.size(), exponent);
      if (error == std::errc::result_out_of_range || (error == std::errc() && exponent > 300))
        return true;
    }
    return false;
  }

  /// False if the attribute is refused.
  bool add(SvgElement& element, const std::string& name, std::string_view value) {
    if (is_no_number(name, value))
      return refuse(fmt::format("{} of a {} is not a finite number: {}", name, element.name,
                                printable(std::string(value), 40))),
             false;
    const bool is_reference = name == "href" || name.ends_with("}href");
    if (name == "id") {
      element.id = value;
    } else if (name == "style") {
      add_style(element, value);
    } else if (!styled_.contains(name) || styled_[name] != tree.elements.size()) {
      element.values[is_reference ? "href" : name] = spaced(value);
    }
    return true;
  }

  void add_style(SvgElement& element, std::string_view style) {
    while (!style.empty()) {
      const std::size_t stop = std::min(style.find(';'), style.size());
      const std::string_view one = style.substr(0, stop);
      style.remove_prefix(std::min(stop + 1, style.size()));
      const std::size_t colon = one.find(':');
      if (colon == std::string_view::npos) continue;
      const std::string name = lower_case(trimmed(one.substr(0, colon), kWhiteSpace));
      element.values[name] = spaced(one.substr(colon + 1));
      styled_[name] = tree.elements.size();
    }
  }

  XML_Parser parser_;
  std::vector<int> open_;
  std::vector<std::map<std::string, int>> locations_;
  std::map<std::string, std::size_t> styled_;  ///< Which element's style set a property last.
};

}  // namespace

SvgTree parse_svg(std::string_view bytes) {
  if (bytes.size() > kMostSvgBytes)
    throw InvalidInput(fmt::format("more than {} bytes", kMostSvgBytes));
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
      XML_ParserCreateNS(nullptr, '|'), &XML_ParserFree);
  if (!parser) throw std::bad_alloc();
  Builder builder(parser.get());
  const XML_Status status =
      XML_Parse(parser.get(), bytes.data(), static_cast<int>(bytes.size()), XML_TRUE);
  if (builder.failure) std::rethrow_exception(builder.failure);
  if (!builder.refusal.empty()) throw InvalidInput(builder.refusal);
  if (XML_GetErrorCode(parser.get()) == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
  if (status != XML_STATUS_OK)
    throw InvalidInput(fmt::format("line {}: {}", line_of(parser.get()),
                                   XML_ErrorString(XML_GetErrorCode(parser.get()))));
  return std::move(builder.tree);
}

}  // namespace mapproof
