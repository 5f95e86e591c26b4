#include "reports/diff/documents/page_text.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace mapproof {
namespace {

/// A kind of region and how its first tag names it.
struct Region {
  std::string_view open, close, mark, prefix;
};
constexpr std::array kRegions = {
    Region{"<figure", "</figure>", "id=\"figure-", ""},
    Region{"<table", "</table>", "aria-labelledby=\"caption-", "tables/"},
    Region{"<section", "</section>", "id=\"section-", "section "}};

/// Elements whose content is not a text.
constexpr std::array<std::string_view, 2> kSilent = {"script", "style"};

/// The id that the tag at `at` carries, with what is before it; empty if it carries none.
std::optional<std::string> id_at(std::string_view html, std::size_t at, const Region& region) {
  if (!html.substr(at).starts_with(region.open)) return std::nullopt;
  const std::string_view tag = html.substr(at, html.find('>', at) - at);
  const std::size_t mark = tag.find(region.mark);
  if (mark == std::string_view::npos) return std::nullopt;
  const std::size_t first = mark + region.mark.size();
  return std::string(region.prefix) + std::string(tag.substr(first, tag.find('"', first) - first));
}

bool is_provenance(const std::string& id) {
  return id.starts_with("section ") && id.ends_with("provenance");
}

/// Where a region to be left out ends that begins at `at`; `at` if none does.
std::size_t region_end(std::string_view html, std::size_t at,
                       const std::function<bool(const std::string& id)>& is_told) {
  for (const Region& region : kRegions) {
    const auto id = id_at(html, at, region);
    if (!id || !(is_provenance(*id) || (!id->starts_with("section ") && is_told(*id)))) continue;
    const std::size_t close = html.find(region.close, at);
    if (close != std::string_view::npos) return close + region.close.size();
  }
  return at;
}

/// Where the element at `at` ends if it holds no text; else `at`.
std::size_t silent_end(std::string_view html, std::size_t at) {
  for (const std::string_view name : kSilent) {
    if (!html.substr(at + 1).starts_with(name)) continue;
    const std::size_t close = html.find("</" + std::string(name), at);
    return close == std::string_view::npos ? html.size() : close;
  }
  return at;
}

}  // namespace

std::string masked_page(std::string_view html,
                        const std::function<bool(const std::string& id)>& is_told) {
  std::string kept;
  for (std::size_t at = 0; at < html.size();) {
    const std::size_t end = html[at] == '<' ? region_end(html, at, is_told) : at;
    if (end > at) {
      at = end;
      continue;
    }
    const std::size_t next = std::min(html.find('<', at + 1), html.size());
    kept += html.substr(at, next - at);
    at = next;
  }
  return kept;
}

std::string page_words(std::string_view html) {
  std::string words;
  for (std::size_t at = 0; at < html.size();) {
    if (html[at] == '<') {
      const std::size_t content = silent_end(html, at);
      const std::size_t close = html.find('>', content);
      at = close == std::string_view::npos ? html.size() : close + 1;
      continue;
    }
    const std::size_t next = std::min(html.find('<', at), html.size());
    const std::string_view piece = html.substr(at, next - at);
    const std::size_t first = piece.find_first_not_of(" \t\r\n");
    if (first != std::string_view::npos) {
      words += piece.substr(first, piece.find_last_not_of(" \t\r\n") - first + 1);
      words += '\n';
    }
    at = next;
  }
  return words;
}

}  // namespace mapproof
