#include "reports/diff/svg/svg_active.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

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
