#include "reports/diff/approvals/approval_items.hpp"

#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/topics/validate.hpp"
#include "render/image/png_read.hpp"
#include "render/plot/figure_json.hpp"
#include "render/scene/scene_json.hpp"
#include "reports/diff/items.hpp"
#include "reports/diff/records/record_set.hpp"
#include "reports/diff/svg/svg_parser.hpp"

namespace mapproof {

namespace fs = std::filesystem;

namespace {

void add_records(ApprovalFiles& files, const std::string& id, const fs::path& location,
                 const fs::path& root) {
  for (const fs::path& file : record_files(location))
    files[id].insert((location / file).lexically_relative(root));
  std::error_code error;
  if (fs::is_regular_file(location / "timings.jsonl", error))
    files[id].insert((location / "timings.jsonl").lexically_relative(root));
}

void read_as_what_it_is(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::string kind = item_name(file, file.parent_path()).kind;
  require_file(file);
  if (name.ends_with(".figure.json")) {
    figure_from_json(read_file(file), file.string());
  } else if (name.ends_with(".scene.json")) {
    scene_from_json(read_file(file), file.string());
  } else if (name.ends_with(".json")) {
    for (const Finding& finding : validate(file))
      if (!finding.problem.empty()) throw InvalidInput(finding.problem);
  } else if (kind == "png") {
    read_png(read_file(file));
  } else if (kind == "svg") {
    parse_svg(read_file(file));
  }
}

}  // namespace

ApprovalFiles approval_files(const fs::path& root) {
  ApprovalFiles files;
  std::error_code error;
  if (!fs::exists(root, error)) return files;
  if (!fs::is_directory(root, error)) throw IoError(root.string(), "is not a folder");
  if (holds_records(root)) add_records(files, kRecordsItem, root, root);
  fs::recursive_directory_iterator entry(root, error), end;
  for (; !error && entry != end; entry.increment(error)) {
    if (entry.depth() == 0 && !files.contains(kRecordsItem) && entry->is_directory(error) &&
        holds_records(entry->path()))
      add_records(files, std::string(kRecordsItem) + "/" + entry->path().filename().string(),
                  entry->path(), root);
    std::error_code unknown;
    if (entry->is_directory(unknown)) continue;
    const ItemName name = item_name(entry->path(), root);
    if (!name.kind.empty()) files[name.id].insert(entry->path().lexically_relative(root));
  }
  if (error) throw IoError(root.string(), "cannot be listed: " + error.message());
  return files;
}

void require_plain(const fs::path& root, const fs::path& file) {
  fs::path path = root;
  for (const fs::path& part : file) {
    path /= part;
    std::error_code error;
    if (fs::symlink_status(path, error).type() == fs::file_type::symlink)
      throw InvalidInput("not approved: " + path.string() +
                         ": is a symbolic link, and a baseline takes regular files alone");
  }
}

void require_readable(const fs::path& file) {
  try {
    read_as_what_it_is(file);
  } catch (const IoError& error) {
    throw InvalidInput(std::string("not approved: ") + error.what());
  } catch (const InvalidInput& error) {
    const std::string what = error.what();
    const bool is_named = what.find(file.string()) != std::string::npos;
    throw InvalidInput("not approved: " + (is_named ? what : file.string() + ": " + what));
  }
}

void require_no_folder(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error))
    throw InvalidInput("not approved: " + file.string() + ": is a folder");
}

void require_gone(const fs::path& file) {
  require_no_folder(file);
  std::error_code error;
  if (fs::exists(fs::symlink_status(file, error)))
    throw InvalidInput("not approved: " + file.string() + ": is not a file that can be read");
}

}  // namespace mapproof
