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
  /// Nothing is thrown through expat, which calls the handler of the end of an empty element though
  /// that of its start has stopped it.
  template <typename Handler>
  static void guarded(void* self, const Handler& handler) noexcept {
    auto& builder = *static_cast<Builder*>(self);
    if (builder.failure || !builder.refusal.empty()) return;
    try {
      std::invoke(handler, builder);
    } catch (...) {
      builder.failure = std::current_exception();
      XML_StopParser(builder.parser_, XML_FALSE);
    }
  }

  void refuse(const std::string& why) {
    refusal = fmt::format("line {}: {}", line_of(parser_), why);
    XML_StopParser(parser_, XML_FALSE);
  }

  void open(std::string_view full_name, const char** attributes) {
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

template <std::size_t kCount>
bool holds(const std::array<std::string_view, kCount>& words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

template <std::size_t kCount>
bool begins_with_any(std::string_view text, const std::array<std::string_view, kCount>& starts) {
  return std::ranges::any_of(starts,
                             [&](std::string_view start) { return text.starts_with(start); });
}

/// Name spaces whose elements browsers, or other readers of XML, act on.
constexpr std::array<std::string_view, 5> kActiveSpaces = {
    "http://www.w3.org/1999/xhtml", "http://www.w3.org/1998/math/mathml",
    "http://www.w3.org/1999/xsl/transform", "http://www.w3.org/2001/xinclude",
    "http://www.w3.org/2001/xml-events"};

constexpr std::array<std::string_view, 17> kActiveElements = {
    "script", "foreignobject", "iframe",   "frame",   "frameset", "object",
    "embed",  "applet",        "audio",    "video",   "canvas",   "img",
    "link",   "meta",          "listener", "handler", "base"};

constexpr std::array<std::string_view, 2> kImages = {"image", "feimage"};

/// Images whose format holds nothing that runs or loads.
constexpr std::array<std::string_view, 5> kImageData = {
    "data:image/png", "data:image/jpeg", "data:image/jpg", "data:image/gif", "data:image/webp"};

constexpr std::array<std::string_view, 9> kCssData = {
    "data:image/png",        "data:image/jpeg",         "data:image/jpg",
    "data:image/gif",        "data:image/webp",         "data:font/",
    "data:application/font", "data:application/x-font", "data:application/vnd.ms-fontobject"};

constexpr std::array<std::string_view, 3> kLinkSchemes = {"http:", "https:", "mailto:"};

/// Attributes with an address that something loads, or that changes what others mean.
constexpr std::array<std::string_view, 6> kAddresses = {"src",        "srcset", "action",
                                                        "formaction", "poster", "ping"};

/// Attributes with CSS in them, or that an animation makes into such. In others, as labels, the
/// names of CSS's functions are words.
constexpr std::array<std::string_view, 10> kStyles = {"style",  "cursor", "mask", "filter", "fill",
                                                      "stroke", "values", "to",   "from",   "by"};

/// Functions and rules of CSS that load what stands in them, with url() or without.
constexpr std::array<std::string_view, 7> kLoadingCss = {
    "@import", "image-set(", "image(", "src(", "expression(", "-moz-binding", "behavior:"};

constexpr std::string_view kXml = "http://www.w3.org/XML/1998/namespace";

unsigned hex_value(std::string_view digits) {
  unsigned value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  return value;
}

/// CSS in lower case, escapes replaced: "\75 rl(" is "url(". Characters beyond ASCII become "?".
std::string plain_css(std::string_view css) {
  std::string plain;
  for (std::size_t at = 0; at < css.size(); ++at) {
    if (css[at] != '\\') {
      plain += css[at];
      continue;
    }
    const std::string_view rest = css.substr(at + 1);
    constexpr std::size_t kMostDigits = 6;
    const std::size_t digits =
        std::min({rest.find_first_not_of("0123456789abcdefABCDEF"), rest.size(), kMostDigits});
    if (digits == 0) {
      if (!rest.empty() && rest[0] == '\n') ++at;  // A line that goes on.
      continue;                                    // Any other character stands for itself.
    }
    const unsigned value = hex_value(rest.substr(0, digits));
    plain += value < 0x80 ? static_cast<char>(value) : '?';
    at += digits;
    if (at + 1 < css.size() &&
        std::string_view(" \t\r\n\f").find(css[at + 1]) != std::string_view::npos)
      ++at;
  }
  return lower_case(plain);
}

/// Whether a url(...) of plain_css() leads to anything but a part of the file, an image or a font.
bool url_loads(const std::string& text) {
  for (std::size_t at = text.find("url("); at != std::string::npos;
       at = text.find("url(", at + 1)) {
    const std::size_t start = text.find_first_not_of(" \t\r\n\f\"'", at + 4);
    if (start == std::string::npos) return true;
    const std::string_view target = std::string_view(text).substr(start);
    if (!target.starts_with('#') && !begins_with_any(target, kCssData)) return true;
  }
  return false;
}

/// Why a reference is refused; empty if it is not.
std::string reference_problem(std::string_view element, std::string_view value) {
  const std::string target = lower_case(cleaned_address(value));
  if (target.empty() || target.starts_with('#')) return "";
  if (element != "a")
    return holds(kImages, element) && begins_with_any(target, kImageData)
               ? ""
               : "a reference to another file";
  if (begins_with_any(target, kLinkSchemes)) return "";
  // An address without a scheme is relative to the file.
  const std::size_t colon = target.find(':');
  if (colon == std::string::npos || target.find_first_of("/?#") < colon) return "";
  return "a reference that runs a script";
}

/// Whether an animation of the attribute sets, later, what would be refused at once.
bool is_active_name(std::string_view value) {
  const std::string name = lower_case(cleaned_address(value));
  const std::string_view local = std::string_view(name).substr(name.rfind(':') + 1);
  return local == "href" || local == "base" || local.starts_with("on") || holds(kAddresses, local);
}

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

XmlName xml_name(std::string_view name) {
  const std::size_t bar = name.rfind('|');
  if (bar == std::string_view::npos) return {{}, name};
  return {name.substr(0, bar), name.substr(bar + 1)};
}

std::string active_element(const XmlName& element) {
  if (holds(kActiveElements, lower_case(element.local)))
    return fmt::format("a {} element", printable(std::string(element.local), 40));
  if (holds(kActiveSpaces, lower_case(element.space)))
    return fmt::format("an element {} of another language than SVG",
                       printable(std::string(element.local), 40));
  return "";
}

std::string active_attribute(const XmlName& element, const XmlName& attribute,
                             std::string_view value) {
  const std::string name = lower_case(attribute.local);
  if (name.starts_with("on"))
    return "an event handler: " + printable(std::string(attribute.local), 40);
  if (name == "href") {
    std::string problem = reference_problem(lower_case(element.local), value);
    if (!problem.empty()) return problem;
  }
  if (holds(kAddresses, name) || (name == "base" && attribute.space == kXml))
    return "a reference to another file";
  if (name == "attributename" && is_active_name(value))
    return "an animation of a reference or of a handler";
  const bool loads = holds(kStyles, name)
                         ? css_loads(value)
                         : value.find('(') != value.npos && url_loads(plain_css(value));
  return loads ? "a reference to another file" : "";
}

bool css_loads(std::string_view css) {
  const std::string text = plain_css(css);
  return url_loads(text) || std::ranges::any_of(kLoadingCss, [&](std::string_view word) {
           return text.find(word) != std::string::npos;
         });
}

std::string cleaned_address(std::string_view address) {
  const auto is_outer = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
  while (!address.empty() && is_outer(address.front())) address.remove_prefix(1);
  while (!address.empty() && is_outer(address.back())) address.remove_suffix(1);
  std::string cleaned(address);
  std::erase_if(cleaned, [](char c) { return c == '\t' || c == '\n' || c == '\r'; });
  return cleaned;
}

}  // namespace mapproof
