#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mapproof::test {

/// The program that is Chromium here; empty if there is none.
std::optional<std::string> chromium();

/// What browser_checks.js finds in a page, loaded under its own policy in a real browser.
/// @param texts       Must stand in the page's text; `attributes` in its attributes.
/// @return name → value; empty if the browser gave nothing back.
std::map<std::string, std::string> browse(const std::string& page,
                                          const std::vector<std::string>& texts,
                                          const std::vector<std::string>& attributes);

/// The words of the page on paper, by pdftotext.
std::string printed_text(const std::string& page);

}  // namespace mapproof::test
