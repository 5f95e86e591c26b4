#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "core/model/map_record.hpp"
#include "core/model/status.hpp"
#include "core/model/study.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// "Visibility", to begin a sentence or a title with.
std::string title_of(Sensor sensor);

/// One sentence on what a status means.
std::string_view meaning(StatusCode code);

/// The name of a warning as words: "not Euclidean" of "not_euclidean".
std::string code_words(std::string code);
std::string words_of(StatusCode code);

/// "Fig. 4" of "fig-4" and "Table 1" of "table-1"; empty for other ids.
std::string paper_number(std::string_view id);

/// "ISOMAP (K = 6)" of "ISOMAP, K = 6": a label whose comma parts no sentence.
std::string bracketed(std::string_view label);

/// "1 of 25 runs is done", "24 of 25 runs are done".
std::string done_text(long long done, long long planned, std::string_view noun);

/// The same, and what follows for the numbers below; empty if all are done.
std::string incomplete_text(long long done, long long planned, std::string_view noun);

/// Adds a table that a page folds.
void fold(Table table, Section& section);

/// A paragraph of plain text.
Paragraph plain(std::string text);

/// Version, commit, digest and libraries, each an item.
KeyValues provenance_items(const Provenance& provenance);

/// Adds to these items in a report's sections what drew its scenes.
void add_renderer(Report& report, const std::string& renderer);

}  // namespace mapproof
