#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "reports/history/history_pages.hpp"
#include "reports/history/history_store.hpp"
#include "reports/html/templates.hpp"

namespace mapproof {

/// Writes index.html and, of every study of the last night, trends/STUDY/report.html with its
/// figures, anew from the history.
/// @param remarks  On the last night.
/// @return The path of index.html. @throws IoError.
std::filesystem::path write_history_pages(HistoryStore& history, const std::filesystem::path& out,
                                          std::span<const std::string> remarks,
                                          const Templates& page, int jobs);

}  // namespace mapproof
