#include "reports/html/html_options.hpp"

namespace mapproof {

const std::string& link_words(const std::string& path, const HtmlOptions& options) {
  const auto found = options.link_words.find(path);
  return found == options.link_words.end() ? path : found->second;
}

}  // namespace mapproof
