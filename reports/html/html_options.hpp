#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

namespace mapproof {

/// The drawing of a figure by its id: an <svg> element by mapproof; empty if there is none.
using SvgLookup = std::function<std::string(const std::string& figure_id)>;

struct HtmlOptions {
  std::string figure_folder = "figures";  ///< Links to files beside the page; empty: no links.
  std::string table_folder = "tables";
  bool copies_tables = true;  ///< Tables can be copied as CSV and as LaTeX.
  /// The texts of links to files, by path; other links show the path.
  std::map<std::string, std::string> link_words = {};
  /// The most bytes of drawings that the page holds; it links the others and states their number.
  /// Drawings of the opening come first, then figures, then 3-D figures, in their order, and last
  /// those that are folded.
  std::size_t drawing_bytes = 5'200'000;
};

/// The text of a link to a file.
const std::string& link_words(const std::string& path, const HtmlOptions& options);

}  // namespace mapproof
