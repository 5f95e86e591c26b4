#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/records/tables/respelling.hpp"

namespace mapproof {
namespace {

/// A file that is not read, and what makes a table of it.
struct OtherKind {
  std::string_view magic;
  std::string_view within;  ///< Also somewhere in the first bytes; empty: nothing.
  std::string_view what;
  std::string_view remedy;
  bool is_text = false;  ///< Else it holds control characters: no table does.
};

constexpr std::string_view kSaveAs = "File > Save As, then CSV UTF-8";
constexpr std::string_view kRosbag = "examples/ros2/mcap_to_csv.py makes tables of MCAP";

constexpr std::string_view kStata =
    "in Stata, export delimited; in Python, pandas.read_stata(\"FILE\").to_csv(\"table.csv\")";
constexpr std::string_view kYaml =
    "python3 -c 'import json, yaml; json.dump(yaml.safe_load(open(\"FILE\")), open(\"table.json\", "
    "\"w\"))'";
constexpr OtherKind kWebPage = {"", "", "a web page",
                                "in Python, pandas.read_html(\"FILE\")[0].to_csv(\"table.csv\")"};

/// The first that fits counts.
constexpr OtherKind kOtherKinds[] = {
    {"PK\x03\x04", "xl/", "an Excel workbook", kSaveAs},
    {"PK\x03\x04", "[Content_Types].xml", "an Office document", kSaveAs},
    {"PK\x03\x04", "opendocument.spreadsheet", "an OpenDocument spreadsheet",
     "File > Save As, then Text CSV"},
    {"PK\x03\x04", "", "a ZIP archive", "unzip it and give the file in it"},
    {"\xD0\xCF\x11\xE0", "", "an old Excel workbook", kSaveAs},
    {"<?xml", "gnumeric", "a Gnumeric workbook", "ssconvert FILE table.csv", true},
    {"<?xml", "", "XML", "a table is CSV or JSON", true},
    {"%YAML", "", "YAML", kYaml, true},
    {"---\n", "", "YAML", kYaml, true},
    {"---\r\n", "", "YAML", kYaml, true},
    {"\x89HDF\r\n", "", "HDF5", "in Python, pandas.read_hdf or h5py reads it; write CSV or .npy"},
    {"MATLAB 7.3", "", "MATLAB 7.3 (HDF5)", "in MATLAB, writematrix(X, \"table.csv\")"},
    {"MATLAB 5.0", "", "a MATLAB file", "in MATLAB, writematrix(X, \"table.csv\")"},
    {"PAR1", "", "Parquet", "in Python, pandas.read_parquet(\"FILE\").to_csv(\"table.csv\")"},
    {"ARROW1", "", "Arrow (Feather)",
     "in Python, pandas.read_feather(\"FILE\").to_csv(\"table.csv\")"},
    {"FEA1", "", "Feather", "in Python, pandas.read_feather(\"FILE\").to_csv(\"table.csv\")"},
    {"\x80\x02", "", "a Python pickle", "in Python, write CSV or numpy.save(\"table.npy\", array)"},
    {"\x80\x03", "", "a Python pickle", "in Python, write CSV or numpy.save(\"table.npy\", array)"},
    {"\x80\x04", "", "a Python pickle", "in Python, write CSV or numpy.save(\"table.npy\", array)"},
    {"\x80\x05", "", "a Python pickle", "in Python, write CSV or numpy.save(\"table.npy\", array)"},
    {"#ROSBAG V", "", "a bag of ROS 1", "rostopic echo -b FILE -p /TOPIC > table.csv"},
    {"\x89MCAP0\r\n", "", "MCAP (a bag of ROS 2)", kRosbag},
    {"SQLite format 3", "topics", "a bag of ROS 2 (.db3)",
     "ros2 bag convert makes MCAP, and examples/ros2/mcap_to_csv.py tables of it"},
    {"SQLite format 3", "", "an SQLite database", "sqlite3 -csv -header FILE \"SELECT ...\""},
    {"<stata_dta>", "", "a file of Stata", kStata},
    {"r\x01\x01", "", "a file of Stata", kStata},
    {"r\x02\x01", "", "a file of Stata", kStata},
    {"s\x01\x01", "", "a file of Stata", kStata},
    {"s\x02\x01", "", "a file of Stata", kStata},
    {"RDX2\n", "", "a file of R", "in R, write.csv(x, \"table.csv\", row.names = FALSE)"},
    {"RDX3\n", "", "a file of R", "in R, write.csv(x, \"table.csv\", row.names = FALSE)"},
    {"X\n", "", "a file of R (.rds)", "in R, write.csv(readRDS(\"FILE\"), \"table.csv\")"},
    {"# .PCD", "", "a point cloud", "mapproof reads detections of landmarks", true},
    {"ply\n", "", "a point cloud", "mapproof reads detections of landmarks", true},
    {"LASF", "", "a point cloud", "mapproof reads detections of landmarks"},
    {"%PDF", "", "a PDF", "pdftotext -layout FILE makes text of it, Tabula a table", true},
    {"\x89PNG", "", "a PNG image", "save the data themselves; `mapproof diff` compares images"},
    {"\xFF\xD8\xFF", "", "a JPEG image", "save the data themselves"},
    {"GIF8", "", "a GIF image", "save the data themselves"},
    {"\x28\xB5\x2F\xFD", "", "packed by Zstandard", "zstd -d FILE"},
    {"BZh", "", "packed by bzip2", "bunzip2 FILE"},
    {"7z\xBC\xAF", "", "a 7-Zip archive", "unpack it and give the file in it"},
    {"Rar!", "", "a RAR archive", "unpack it and give the file in it"},
    {"\x7F"
     "ELF",
     "", "a program", "give a table"},
    {"version https://git-lfs", "", "a pointer of Git LFS", "git lfs pull", true},
};

/// Whether the first tag is of HTML, in any case, behind comments.
bool is_web_page(std::string_view text) {
  std::string start = lower_case(trimmed(text.substr(0, 2000), kWhiteSpace));
  while (start.starts_with("<!--")) {
    const std::size_t end = start.find("-->");
    if (end == std::string::npos) return false;
    start = trimmed(std::string_view(start).substr(end + 3), kWhiteSpace);
  }
  return start.starts_with("<!doctype html") || start.starts_with("<html");
}

/// Whether the first line that is not a comment is "- key: value", "- key:" or "key: value".
bool is_yaml(std::string_view text) {
  while (text.starts_with('#')) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  std::string_view line = trimmed(text.substr(0, text.find('\n')));
  if (line.starts_with("- ")) line.remove_prefix(2);
  const std::size_t colon = line.find(':');
  // A row of a table may have a colon, too: "Unnamed: 0" of pandas, before the next cell.
  const bool is_flow = line.find_first_of("[{\"'") != std::string_view::npos;
  const bool is_row = line.find_first_of(is_flow ? "\t;" : "\t;,") != std::string_view::npos;
  const bool is_pair = !is_row && colon != std::string_view::npos && colon > 0 &&
                       (colon + 1 == line.size() || line[colon + 1] == ' ');
  std::string_view key = line.substr(0, is_pair ? colon : 0);
  // In quotes as a whole or not at all: a colon between quotes is one of a cell.
  if (key.size() > 1 && (key[0] == '"' || key[0] == '\'') && key.back() == key[0])
    key = key.substr(1, key.size() - 2);
  constexpr std::string_view kOfKeys =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.";
  return is_pair && key.find_first_not_of(kOfKeys) == std::string_view::npos;
}

[[noreturn]] void refuse(const OtherKind& kind, const std::string& source) {
  throw IoError(source, fmt::format("is {}, which is not read: {}", kind.what, kind.remedy));
}

}  // namespace

void refuse_other_kind(std::string_view start, const std::string& source) {
  const std::size_t first = start.find_first_not_of("\xEF\xBB\xBF");
  const std::string_view text = first == std::string_view::npos ? start : start.substr(first);
  const bool has_control =
      std::ranges::any_of(text.substr(0, 1024), [](char c) { return c >= '\0' && c < '\t'; });
  if (is_npz(text)) return;
  for (const OtherKind& kind : kOtherKinds)
    if ((has_control || kind.is_text) && text.starts_with(kind.magic) &&
        text.find(kind.within) != std::string_view::npos)
      refuse(kind, source);
  if (is_web_page(text)) refuse(kWebPage, source);
  if (is_yaml(text)) refuse({"", "", "YAML", kYaml}, source);
}

}  // namespace mapproof
