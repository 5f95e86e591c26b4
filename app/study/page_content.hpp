#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/disclosure.hpp"
#include "core/records/studies/study_page.hpp"
#include "render/plot/figure.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

/// What is drawn: no two have one id.
struct Images {
  std::vector<const Figure*> figures;
  std::vector<const Scene*> scenes;
};

/// The most bytes that figures take of a page's data.
inline constexpr std::size_t kMostFigureData = 1'800'000;

/// The most bytes of a results.csv that a page carries: with 540 MB of one a page had 102 MB.
inline constexpr std::size_t kMostResults = std::size_t{64} << 20;

/// What a report's page carries, and what it does not.
struct PageContent {
  PageData data;
  std::size_t figures_kept = 0;  ///< Figures and 3-D figures that it carries.
  std::size_t figures_left = 0;  ///< Those that are in the folder alone.
  /// Tables of results of more than kMostResults, which are in the folder alone.
  std::vector<std::string> tables_left = {};
};

/// The records of a folder, of a study, of studies below it, of a map or a range-only map: of a
/// study study.json and results.csv, of a map map.json, of a range-only map slam.json. A
/// results.csv of more than kMostResults is left out.
/// @throws IoError if they cannot be read.
PageData page_records(const std::filesystem::path& folder, const Disclosure& disclosure);

/// The files that page_records() leaves out, below the folder.
std::vector<std::string> large_tables(const std::filesystem::path& folder);

/// What a text takes of a page that carries it, packed by itself.
std::size_t packed_bytes(const std::string& text);

/// The data of figures as a page carries them: each is written and measured once, however often a
/// page is composed of them. Figures that need more than kMostFigureData are left out, 3-D figures
/// first.
class FigureData {
 public:
  FigureData(const Images& images, const Disclosure& disclosure);

  /// What the data of the figures take of a page, packed one by one.
  /// @param shown  Ids of the figures in the page.
  std::size_t bytes(const std::set<std::string>& shown);

  /// The records, and the figures that the page shows.
  PageContent content(PageData records, const std::set<std::string>& shown) &&;

 private:
  struct Entry {
    std::string id, name;
    std::function<std::string()> json;
    std::optional<std::string> text = {};  ///< What the page carries, once it was measured.
    std::size_t bytes = 0;                 ///< Packed.
  };
  std::vector<Entry*> kept(const std::set<std::string>& shown);

  const Disclosure& disclosure_;
  std::vector<Entry> entries_;
};

/// "report.html carries … 30 figures; those of 4 more … are in figures/ alone", and tables that it
/// does not carry; empty if it carries all.
std::string left_out_text(const PageContent& content);

}  // namespace mapproof
