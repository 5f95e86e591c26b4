#include "reports/diff/items.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/text/ascii.hpp"
#include "core/records/observations/input_kind.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostImages = 100'000;
constexpr std::size_t kMostEntries = 3 * kMostImages;  // A value and two images for each figure.

enum class KindClass {
  kFigure,    ///< The value from which an image was drawn.
  kImage,     ///< An image that is compared.
  kOther,     ///< An image that nothing here draws.
  kDocument,  ///< A table or a page, which follows from records.
};

struct Kind {
  std::string_view ending;
  KindClass of;
  std::string_view start =
      {};  ///< The first bytes of all such files, and of no others; empty: none.
};

constexpr std::array kKinds = {
    Kind{"figure.json", KindClass::kFigure},   Kind{"scene.json", KindClass::kFigure},
    Kind{"png", KindClass::kImage, "\x89PNG"}, Kind{"svg", KindClass::kImage, "<"},
    Kind{"pdf", KindClass::kImage, "%PDF-"},   Kind{"jpg", KindClass::kImage, "\xFF\xD8\xFF"},
    Kind{"jpeg", KindClass::kImage},           Kind{"gif", KindClass::kImage, "GIF8"},
    Kind{"webp", KindClass::kImage, "RIFF"},   Kind{"tif", KindClass::kImage, "II*"},
    Kind{"tiff", KindClass::kImage, "MM"},     Kind{"bmp", KindClass::kImage, "BM"},
    Kind{"eps", KindClass::kOther, "%!PS"}};

KindClass class_of(std::string_view kind) {
  const auto found = std::ranges::find(kKinds, kind, &Kind::ending);
  return found == kKinds.end() ? KindClass::kDocument : found->of;
}

void add(ItemList& items, const ItemName& name, const fs::path& file) {
  switch (class_of(name.kind)) {
    case KindClass::kFigure:
      items[name.id].figure = file;
      break;
    case KindClass::kImage:
    case KindClass::kOther:
      items[name.id].images[name.kind][""] = file;
      break;
    case KindClass::kDocument:
      items[name.id].documents[name.kind] = file;
  }
}

/// Whether the file is a further page of a report: pages/2.html.
bool is_further_page(const fs::path& file) {
  const std::string number = file.stem().string();
  return file.extension() == ".html" && file.parent_path().filename() == "pages" &&
         std::ranges::all_of(number, is_digit);
}

/// The kind of a document; empty for other files.
std::string document_kind(const fs::path& file) {
  if (file.filename() == "report.html" || is_further_page(file)) return "html";
  const std::string extension = file.extension().string();
  const bool is_table = extension == ".csv" || extension == ".md" || extension == ".tex";
  return is_table && file.parent_path().filename() == "tables" ? extension.substr(1) : "";
}

bool is_image(std::string_view kind) {
  return class_of(kind) == KindClass::kImage || class_of(kind) == KindClass::kOther;
}

/// The kind of a single file by its first bytes; empty: none that is compared.
std::string kind_seen(const fs::path& file) {
  ByteSource source(file);
  const std::string_view start = source.peek();
  if (start.starts_with("<!DOCTYPE html>")) return "html";
  const auto found = std::ranges::find_if(kKinds, [&](const Kind& kind) {
    return !kind.start.empty() && start.starts_with(kind.start);
  });
  if (found != kKinds.end()) return std::string(found->ending);
  const std::string schema = is_json(source) ? json_schema(source) : "";
  if (schema == "mapproof.figure") return "figure.json";
  return schema == "mapproof.scene" ? "scene.json" : "";
}

}  // namespace

bool is_decoded(std::string_view kind) { return class_of(kind) == KindClass::kImage; }

bool is_not_compared(std::string_view kind) { return class_of(kind) == KindClass::kOther; }

std::string_view media_type(std::string_view format) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kTypes{
      {{"png", "image/png"},
       {"svg", "image/svg+xml"},
       {"jpg", "image/jpeg"},
       {"jpeg", "image/jpeg"},
       {"gif", "image/gif"},
       {"webp", "image/webp"},
       {"bmp", "image/bmp"}}};
  for (const auto& [known, type] : kTypes)
    if (known == format) return type;
  return {};
}

ItemName item_name(const fs::path& file, const fs::path& folder) {
  std::string path = file.lexically_relative(folder).generic_string();
  constexpr std::string_view kFigures = "figures/";
  if (path.starts_with(kFigures)) path.erase(0, kFigures.size());
  std::string lower = path;  // Extensions in any case.
  std::ranges::transform(lower, lower.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  for (const auto& [kind, of, start] : kKinds)
    if (path.size() > kind.size() + 1 && lower.ends_with(kind) &&
        path[path.size() - kind.size() - 1] == '.')
      return {path.substr(0, path.size() - kind.size() - 1), std::string(kind)};
  const std::string kind = document_kind(file);
  if (kind.empty() || kind == "html") return {path, kind};
  return {path.substr(0, path.size() - kind.size() - 1), kind};
}

ItemList list_items(const fs::path& path) {
  ItemList items;
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    ItemName name = item_name(path, path.parent_path());
    name.id = "";
    if (name.kind.empty()) name.kind = kind_seen(path);
    if (!name.kind.empty()) add(items, name, path);
    return items;
  }
  std::size_t entries = 0, images = 0;
  fs::recursive_directory_iterator entry(path, error), end;
  for (; !error && entry != end; entry.increment(error)) {
    if (++entries > kMostEntries)
      throw IoError(path.string(), "holds more than 300,000 files: compare folders below it");
    std::error_code unknown;  // A broken link: reading it reports the error.
    const ItemName name = item_name(entry->path(), path);
    // A folder with the name of an image may have replaced one: reading it reports the error.
    const bool is_folder = entry->is_directory(unknown);
    if (name.kind.empty() || (is_folder && !is_image(name.kind))) continue;
    if (++images > kMostImages)
      throw IoError(path.string(), "holds more than 100,000 images: compare folders below it");
    add(items, name, entry->path());
  }
  if (error) throw IoError(path.string(), "cannot be listed: " + error.message());
  return items;
}

void join_keyed(ItemList& baseline, const ItemList& current) {
  for (auto item = baseline.begin(); item != baseline.end();) {
    const std::size_t at = item->first.rfind('@');
    if (at == std::string::npos || current.contains(item->first) ||
        !current.contains(item->first.substr(0, at))) {
      ++item;
      continue;
    }
    ItemFiles& whole = baseline[item->first.substr(0, at)];
    for (const auto& [format, files] : item->second.images)
      for (const auto& [none, file] : files)
        whole.images[format][item->first.substr(at + 1)] = file;
    item = baseline.erase(item);
  }
}

}  // namespace mapproof
