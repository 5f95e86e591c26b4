#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mapproof::test {

/// The program that is Chromium here; empty if there is none.
std::optional<std::string> chromium();

/// What the checks, a file beside this one, find in a page, loaded under its own policy in a real
/// browser.
/// @param texts       Must stand in the page's text; `attributes` in its attributes.
/// @param fragment    Of the page's address: "#figure-1"; may be empty.
/// @return name → value; empty if the browser gave nothing back.
std::map<std::string, std::string> browse(const std::string& page,
                                          const std::vector<std::string>& texts,
                                          const std::vector<std::string>& attributes,
                                          const std::string& checks = "browser_checks.js",
                                          const std::string& fragment = "");

/// The words of the page on paper, by pdftotext.
std::string printed_text(const std::string& page);

}  // namespace mapproof::test
