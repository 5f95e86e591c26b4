#include "core/records/studies/study_page.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/gzip.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/files/unpacker.hpp"
#include "core/base/text/base64.hpp"
#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/studies/study_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kOpen = R"(<script id="mapproof-data" type="application/gzip">)";
constexpr std::string_view kId = R"(id="mapproof-data")";
constexpr std::string_view kTag = "<script";
constexpr std::string_view kClose = "</script";

constexpr std::string_view kLetters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";

bool is_made_of(std::string_view text, std::string_view more) {
  return text.find_first_not_of(std::string(kLetters) += more) == std::string_view::npos;
}

bool is_figure_file(std::string_view name) {
  constexpr std::string_view kFigures = "figures/";
  if (!name.starts_with(kFigures)) return false;
  name.remove_prefix(kFigures.size());
  for (const std::string_view ending : {".figure.json", ".scene.json"})
    if (name.size() > ending.size() && name.ends_with(ending))
      return is_made_of(name, "._+-") && kLetters.find(name[0]) != std::string_view::npos;
  return false;
}

/// The content of the element with the data; empty if there is none.
/// @throws IoError if there are several, or if it has no end.
std::optional<std::string_view> element_of(std::string_view html, const std::string& source) {
  std::optional<std::string_view> found;
  for (std::size_t at = 0; (at = html.find(kTag, at)) != std::string_view::npos;) {
    const std::size_t end = html.find('>', at);
    if (end == std::string_view::npos) break;
    const bool is_it = html.substr(at, end - at).find(kId) != std::string_view::npos;
    at = end + 1;
    if (!is_it) continue;
    if (found) throw IoError(source, "has data twice");
    const std::size_t close = html.find(kClose, at);
    if (close == std::string_view::npos) throw IoError(source, "is cut off within its data");
    found = html.substr(at, close - at);
  }
  return found;
}

/// The document that the content of the element holds.
std::string unpacked(std::string_view content, const std::string& source) {
  constexpr std::string_view kGzip = "\x1f\x8b";
  const std::optional<std::string> packed = from_base64(content);
  if (!packed || !packed->starts_with(kGzip))
    throw IoError(source, "its data are damaged: they are not gzip in base64");
  Unpacker unpacker(source);
  unpacker.feed(*packed);
  unpacker.end();
  std::string text;
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  while (unpacker.drain(text, kBlock) == kBlock)
    if (text.size() > kMostPageBytes)
      throw IoError(source, fmt::format("its data have more than {} MB", kMostPageBytes >> 20));
  if (unpacker.is_cut()) throw IoError(source, "its data are cut off");
  return text;
}

}  // namespace

bool is_page_file(std::string_view name) {
  if (name == "map.json" || name == "slam.json" || is_figure_file(name)) return true;
  const std::size_t slash = name.find('/');
  if (slash != std::string_view::npos) {
    if (slash == 0 || !is_made_of(name.substr(0, slash), "_-")) return false;
    name.remove_prefix(slash + 1);
  }
  return name == kStudyFile || name == kResultsFile;
}

std::string with_page_data(std::string html, const PageData& data) {
  if (data.files.empty()) return html;
  for (const PageFile& file : data.files)
    if (!is_page_file(file.name))
      throw InvalidInput("a page carries no file " + printable(file.name));
  std::string element(kOpen);
  append_base64(element, gzipped(to_json_text(data)));
  element += "</script>\n";
  const std::size_t end = html.rfind("</body>");
  return html.insert(std::min(end, html.size()), element);
}

std::string without_page_data(std::string html) {
  const std::size_t begin = html.rfind(kOpen);
  if (begin == std::string::npos) return html;
  const std::size_t end = html.find('\n', begin);
  return html.erase(begin, end == std::string::npos ? end : end + 1 - begin);
}

bool carries_data(std::string_view html) { return html.find(kId) != std::string_view::npos; }

PageData parse_page(std::string_view html, const std::string& source) {
  const std::optional<std::string_view> content = element_of(html, source);
  if (!content)
    throw IoError(source,
                  "carries no data: it is not the page of a mapproof report, or of an older "
                  "version; name the study's folder");
  return parse_page_data(unpacked(*content, source), source);
}

PageData parse_page_data(std::string_view text, const std::string& source) {
  PageData data = from_json_text<PageData>(text, source);
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < data.files.size(); ++i)
    if (!names.insert(data.files[i].name).second)
      throw IoError(source, fmt::format("/files/{}/name", i), "is there twice");
  return data;
}

StudyPage::StudyPage(const fs::path& page) : name_(input_name(page)) {
  const std::string html = read_input(page, kMostPageBytes);
  const PageData data = parse_page(html, name_);
  const OutputFolder folder(folder_.path());
  folder.write("report.html", html);
  for (const PageFile& file : data.files) folder.write(file.name, file.text);
}

std::string StudyPage::named(std::string text) const {
  const std::string& folder = folder_.path().native();
  for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;) {
    const std::size_t end = at + folder.size();
    const bool is_inner = end < text.size() && text[end] == '/';
    const std::string name = is_inner ? name_ + ": " : name_;
    text.replace(at, folder.size() + (is_inner ? 1 : 0), name);
    at += name.size();
  }
  return text;
}

void StudyPage::with_names(const std::function<void()>& read) const {
  try {
    read();
  } catch (const IoError& error) {
    const std::string text = named(error.what());
    const std::string head = name_ + ": ";
    if (!text.starts_with(head)) throw;
    throw IoError(name_, text.substr(head.size()));
  }
}

bool is_page(const fs::path& path) {
  std::error_code error;
  if (is_folder(path) || !fs::is_regular_file(path, error)) return false;
  std::string start(ByteSource(path).peek(1024).substr(0, 1024));
  const std::size_t text = start.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  start.erase(0, std::min(text, start.size()));
  constexpr std::string_view kDocument = "<!doctype html";
  return std::ranges::equal(
      std::string_view(start).substr(0, kDocument.size()), kDocument, {},
      [](char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : +c; }, [](char c) { return +c; });
}

}  // namespace mapproof
