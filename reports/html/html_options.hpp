#pragma once

#include <functional>
#include <map>
#include <string>

namespace mapproof {

/// The drawing of a figure by its id: an <svg> element by mapproof; empty if there is none.
using SvgLookup = std::function<std::string(const std::string& figure_id)>;

struct HtmlOptions {
  std::string figure_folder = "figures";  ///< Links to files beside the page; empty: no links.
  std::string table_folder = "tables";
  std::string root =
      {};  ///< From the page to the report's folder, "../"; files are linked below it.
  bool copies_tables = true;  ///< Tables can be copied as CSV and as LaTeX.
  /// The texts of links to files, by path, with "#" and the element if there is one; other links
  /// show these.
  std::map<std::string, std::string> link_words = {};
};

/// The text of a link to a file.
const std::string& link_words(const std::string& path, const HtmlOptions& options);

}  // namespace mapproof
