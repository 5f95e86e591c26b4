#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

namespace mapproof {

/// The drawing of a figure by its id: an <svg> element of our own writer; empty if there is none.
using SvgLookup = std::function<std::string(const std::string& figure_id)>;

struct HtmlOptions {
  std::string figure_folder = "figures";  ///< Links to files beside the page; empty: no links.
  std::string table_folder = "tables";
  bool copies_tables = true;  ///< Tables can be copied as CSV and as LaTeX.
  /// What links to files say, by their paths; one that is not among them says its path.
  std::map<std::string, std::string> link_words = {};
  /// Bytes of drawings that the page holds at most; what does not fit is linked, and counted in
  /// words. Drawings of the opening go first, then figures, then scenes, in their order.
  std::size_t drawing_bytes = 9'000'000;
};

/// What a link to a file says.
const std::string& link_words(const std::string& path, const HtmlOptions& options);

}  // namespace mapproof
