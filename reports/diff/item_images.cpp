#include "reports/diff/item_images.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/text/percent.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "render/output/write_figure.hpp"
#include "render/theme/theme.hpp"
#include "reports/diff/figures/change_figure.hpp"
#include "reports/diff/kept_heat_maps.hpp"
#include "reports/diff/svg/svg_parser.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Lists what an earlier call wrote, one path per line.
constexpr const char* kList = "mapproof-images.txt";
constexpr std::size_t kLargestList = std::size_t{1} << 26;   // Bytes.
constexpr std::size_t kLargestImage = std::size_t{1} << 28;  // Bytes, as image_diff() reads.

std::string file_name(std::string_view text) {
  return percent_encoded(text, [](char c) { return is_plain(c, "-._/@+"); });
}

/// Removes what an earlier call wrote, or began to write, by its list, which stays.
/// @param folder  Locked, and rid of leftovers.
void remove_earlier(const OutputFolder& folder) {
  std::error_code error;
  const fs::path path = folder.path();
  if (fs::is_empty(path, error)) return;
  if (!fs::is_regular_file(fs::symlink_status(path / kList, error)))
    throw InvalidInput(
        fmt::format("--images {}: holds files that are not images of an earlier "
                    "comparison; name another folder",
                    printable(path.string())));
  const std::string list = read_file(path / kList, kLargestList);
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find('\n', at), list.size());
    if (end > at) {
      const fs::path file = list.substr(at, end - at);
      folder.remove(file);
      // The folders that held it alone, or with what a killed process left.
      for (fs::path above = file.parent_path(); !above.empty(); above = above.parent_path()) {
        if (fs::is_directory(fs::symlink_status(path / above, error)))
          remove_leftovers(path / above);
        fs::remove(path / above, error);
        if (fs::exists(fs::symlink_status(path / above, error))) break;
      }
    }
    at = end + 1;
  }
}

std::string change_path(const DiffItem& item) {
  return file_name(item.id + ".change") + "/difference.png";
}

/// The folder of the images of one file.
std::string images_path(const DiffItem& item, const ImageFile& file) {
  return file_name(item.id + "." + file.format) + "/";
}

bool has_images(const DiffItem& item) { return item.judgement.verdict > Verdict::kWithinTolerance; }

/// Every path that a call may write: stopped at any moment, its files are in the list.
std::string possible_paths(const DiffResult& result) {
  std::string list;
  for (const DiffItem& item : result.items) {
    if (!has_images(item)) continue;
    list += change_path(item) + "\n";
    for (const ImageFile& file : item.images)
      for (const std::string& name :
           {"baseline." + file.format, "current." + file.format, std::string("difference.png")})
        list += images_path(item, file) + name + "\n";
  }
  return list;
}

/// Why the images of a file are left out: what mapproof cannot read may run or load something where
/// it is shown. Of a file of one side, which nothing compares, an SVG alone can.
/// @return "" if the images can be read.
std::string left_out_reason(const ImageFile& file) {
  if (!file.baseline.empty() && !file.current.empty())
    return file.diff.state == ImageState::kUnreadable ? file.diff.reason : "";
  if (file.format != "svg") return "";
  try {
    parse_svg(read_file(file.baseline.empty() ? file.current : file.baseline, kLargestImage));
  } catch (const InvalidInput& error) {
    return error.what();
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

/// Copies one side. @return Its path; empty if it cannot be read.
std::string copy(const fs::path& from, const std::string& to, const OutputFolder& folder) {
  if (from.empty()) return "";
  std::string bytes;
  try {
    bytes = read_file(from, kLargestImage);
  } catch (const IoError&) {
    return "";  // The verdict reports it.
  }
  folder.write(to, bytes);
  return to;
}

/// The heat map. @return Its path; empty if there is none.
std::string write_difference(const ImageFile& file, const ImageOptions& options,
                             const std::string& to, const OutputFolder& folder) {
  if (file.baseline.empty() || file.current.empty() || file.diff.state == ImageState::kIdentical)
    return "";
  std::optional<HeatMapFile> heat;
  try {
    heat = heat_map_file(file, options);
  } catch (const IoError&) {
    return "";
  }
  if (!heat) return "";
  folder.write(to, heat->png);
  return to;
}

/// What changed in the data, drawn. @return Its path; empty if none did.
std::string write_change(const DiffItem& item, const std::string& to, const OutputFolder& folder) {
  if (item.judgement.verdict <= Verdict::kRenderer) return "";
  std::optional<Figure> figure;
  try {
    figure = change_figure(item, figure_values(item));
  } catch (const IoError&) {
    return "";  // The verdict reports it.
  }
  if (!figure) return "";
  folder.write(to, figure_png(*figure, report_theme()));
  return to;
}

}  // namespace

std::vector<std::string> ItemImages::paths() const {
  std::vector<std::string> all;
  for (const std::string* path : {&difference, &current, &baseline})
    if (!path->empty()) all.push_back(*path);
  return all;
}

std::vector<const ItemImages*> ImageLinks::of(const std::string& id) const {
  std::vector<const ItemImages*> all;
  for (const ItemImages& item : images)
    if (item.id == id) all.push_back(&item);
  return all;
}

std::string ImageLinks::joined(const std::string& path) const {
  return prefix.empty() || prefix.ends_with('/') ? prefix + path : prefix + "/" + path;
}

std::vector<ItemImages> write_item_images(const DiffResult& result, const DiffSettings& settings,
                                          const fs::path& to) {
  const LockedFolder locked(to);
  const OutputFolder& folder = locked.files();
  remove_earlier(folder);
  folder.write_durably(kList, possible_paths(result));
  std::vector<ItemImages> all;
  std::string list;
  for (const DiffItem& item : result.items) {
    if (!has_images(item)) continue;
    const auto keep = [&](ItemImages images) {
      for (const std::string& path : images.paths()) list += path + "\n";
      if (!images.paths().empty() || !images.unreadable.empty()) all.push_back(std::move(images));
    };
    ItemImages change{.id = item.id, .format = "change"};
    change.difference = write_change(item, change_path(item), folder);
    keep(std::move(change));
    for (const ImageFile& file : item.images) {
      const std::string start = images_path(item, file);
      ItemImages images{.id = item.id, .format = file.format};
      images.unreadable = left_out_reason(file);
      if (images.unreadable.empty()) {
        images.baseline = copy(file.baseline, start + "baseline." + file.format, folder);
        images.current = copy(file.current, start + "current." + file.format, folder);
        images.difference =
            write_difference(file, settings.images_of(item.id), start + "difference.png", folder);
      }
      keep(std::move(images));
    }
  }
  folder.write(kList, list);
  return all;
}

}  // namespace mapproof
