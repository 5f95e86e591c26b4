#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace mapproof {

/// A report's page without what is told elsewhere: its scripts and styles stay, its provenance
/// (versions, commands, dates) and the figures and tables that `is_told` names go, region by
/// region. Ids are "figure-ID" of <figure>, "caption-ID" of <table>, "section-ID" of <section>.
/// @param is_told  Takes "fig-7" or "tables/accuracy".
std::string masked_page(std::string_view html,
                        const std::function<bool(const std::string& id)>& is_told);

/// What a page says, without its markup, scripts and styles: pieces of text, a line each.
std::string page_words(std::string_view html);

}  // namespace mapproof
