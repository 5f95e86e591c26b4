#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/files/temporary_folder.hpp"
#include "core/json/fields.hpp"

namespace mapproof {

// A report's page carries the records that it shows (docs/report.md): a JSON document of schema
// mapproof.page, packed by gzip, in base64, in a <script> element that no browser executes.

/// The schema of the data in a page.
inline constexpr std::string_view kPageSchema = "mapproof.page";

/// The most bytes of a page, and of the files in it together.
inline constexpr std::size_t kMostPageBytes = std::size_t{1} << 28;

/// The most files that a page carries.
inline constexpr std::size_t kMostPageFiles = 10'000;

/// Whether a file may have that name in a page: study.json, results.csv, map.json, slam.json,
/// figures/ID.figure.json, figures/ID.scene.json, the first two also in a folder,
/// "plaza/study.json".
bool is_page_file(std::string_view name);

/// A file that a page carries.
struct PageFile {
  std::string name;  ///< Below the study's folder.
  std::string text;

  bool operator==(const PageFile&) const = default;
};

/// What a page carries.
struct PageData {
  std::vector<PageFile> files;  ///< Each name once.
};

inline constexpr TextForm kPageFileName = {
    "^(([A-Za-z0-9_-]+/)?(study[.]json|results[.]csv)|map[.]json|slam[.]json|"
    "figures/[A-Za-z0-9][A-Za-z0-9._+-]*[.](figure|scene)[.]json)$",
    is_page_file, "a file that pages carry"};

template <typename Visitor>
void fields(Visitor& v, PageFile& file) {
  v.type("file");
  v.field("name", file.name,
          {.description = "Below the study's folder.", .max_bytes = 300, .form = &kPageFileName});
  v.field("text", file.text, {.max_bytes = kMostPageBytes});
}

template <typename Visitor>
void fields(Visitor& v, PageData& data) {
  v.file(kPageSchema,
         "The records in the page of a report, packed by gzip and in base64 within the element "
         "with the id mapproof-data: its study.json, results.csv and figures.");
  v.field("files", data.files, {.min_items = 1, .max_items = kMostPageFiles});
}

/// The page with the data in its last element, or as it is if there are no files.
/// @throws InvalidInput for a name that is_page_file() refuses.
std::string with_page_data(std::string html, const PageData& data);

/// The page without the element and its data.
std::string without_page_data(std::string html);

/// Whether the text of a page has such an element, readable or not.
bool carries_data(std::string_view html);

/// Reads the data of a page, from anybody.
/// @throws IoError with the location: without data, cut off, damaged, by another version of
///         mapproof, more than kMostPageBytes, names that pages do not carry or that come twice.
PageData parse_page(std::string_view html, const std::string& source);

/// Reads the data as they stand in the element, unpacked. @throws IoError as parse_page().
PageData parse_page_data(std::string_view text, const std::string& source);

/// A page whose data are unpacked into a temporary folder while this object lives.
class StudyPage {
 public:
  /// @throws IoError as parse_page(), or if the file cannot be read.
  explicit StudyPage(const std::filesystem::path& page);

  /// The path of the page; of standard input "standard input".
  const std::string& name() const { return name_; }

  /// A folder as the study's, with what the page carries, and the page as report.html.
  const std::filesystem::path& folder() const { return folder_.path(); }

  /// The text with the page's name wherever it names the folder: "A.html: study.json: …".
  std::string named(std::string text) const;

  /// Calls `read`. @throws IoError as it does, named().
  void with_names(const std::function<void()>& read) const;

 private:
  std::string name_;
  TemporaryFolder folder_{"page"};
};

/// Whether the path is a file that begins as a page does, with data or without. @throws IoError if
/// it is a file and cannot be read.
bool is_page(const std::filesystem::path& path);

}  // namespace mapproof
