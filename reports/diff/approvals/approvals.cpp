#include "reports/diff/approvals/approvals.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/files/paths.hpp"
#include "core/base/text/percent.hpp"
#include "core/base/text/spelling.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"
#include "core/json/record_reader.hpp"
#include "core/records/studies/folder_replacement.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/studies/study_kind.hpp"
#include "core/studies/validate.hpp"
#include "render/decode/image_reader.hpp"
#include "render/plot/figure_json.hpp"
#include "render/scene/scene_json.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/items.hpp"
#include "reports/diff/records/record_set.hpp"
#include "reports/diff/svg/svg_parser.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

inline constexpr const char* kRecordsItem = "records";  ///< All records of a study.

/// The files of each item of one side, by its id; paths relative to the side's folder.
using ApprovalFiles = std::map<std::string, std::set<std::filesystem::path>>;

void add_records(ApprovalFiles& files, const std::string& id, const fs::path& location,
                 const fs::path& root) {
  for (const fs::path& file : record_files(location))
    files[id].insert((location / file).lexically_relative(root));
  std::error_code error;
  if (fs::is_regular_file(location / "timings.jsonl", error))
    files[id].insert((location / "timings.jsonl").lexically_relative(root));
}

/// @throws IoError or InvalidInput unless it is an image that can be decoded whole.
void read_image(const fs::path& file, const std::string& kind) {
  const std::string bytes = read_file(file);
  if (const auto format = decoded_format(bytes)) {
    require_readable(bytes, *format);
  } else if (kind == "png") {
    require_readable(bytes, DecodedFormat::kPng);
  } else if (kind == "svg") {
    parse_svg(bytes);
  } else {
    throw IoError(file.string(), "is not an image that can be read as " + kind);
  }
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
  } else if (is_decoded(kind)) {
    read_image(file, kind);
  }
}

/// The items of a folder; none if it does not exist.
/// @throws IoError if it cannot be listed, or is not a folder.
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

/// A link never becomes a baseline, nor what one leads to.
/// @param file  Relative to the folder `root`.
/// @throws InvalidInput unless it is a regular file, in folders that are no links.
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

/// A file that cannot be read never becomes a baseline. @throws InvalidInput with the reason.
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

/// @throws InvalidInput if a folder has the file's name.
void require_no_folder(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error))
    throw InvalidInput("not approved: " + file.string() + ": is a folder");
}

/// A file of the baseline is removed only if the current has nothing of its name.
/// @param file  The path in the current. @throws InvalidInput if anything is there, as a folder.
void require_gone(const fs::path& file) {
  require_no_folder(file);
  std::error_code error;
  if (fs::exists(fs::symlink_status(file, error)))
    throw InvalidInput("not approved: " + file.string() + ": is not a file that can be read");
}

/// One side of an approval.
struct ApprovalSide {
  const std::filesystem::path& root;
  const ApprovalFiles& files;  ///< Of approval_files(root).
};

/// Records that are not a study.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kOtherRecords = {
    {{"mapproof.map", "one map"}, {"mapproof.slam_run", "the result of one range log"}}};

/// The file that has the schema of a folder's records.
constexpr std::array kHeads = {"study.json", "map.json", "slam.json"};

/// The title of a schema of records; empty if it is of none.
std::string_view title_of(std::string_view schema) {
  for (const StudyKind* kind : all_study_kinds())
    if (kind->study == schema) return kind->title;
  for (const auto& [known, title] : kOtherRecords)
    if (known == schema) return title;
  return "";
}

/// The kind of a folder's records, in words; empty if they cannot be read, which other functions
/// report.
std::string_view kind_of_records(const fs::path& folder) {
  std::error_code error;
  for (const char* name : kHeads) {
    const fs::path file = folder / name;
    if (!fs::is_regular_file(file, error)) continue;
    try {
      const JsonDocument document = parse_json(read_file(file), file.string());
      return title_of(schema_of(document.cursor()).name);
    } catch (const IoError&) {
      return "";
    }
  }
  return "";
}

bool is_drawn(const fs::path& file) {
  const std::string kind = item_name(file, file.parent_path()).kind;
  return !kind.empty() && kind != "csv" && kind != "md" && kind != "tex" && kind != "html";
}

/// What a side holds, in words; empty if that is not known.
std::string_view kind_of(const ApprovalSide& side) {
  if (side.files.contains(kRecordsItem)) return kind_of_records(side.root);
  const auto several = side.files.lower_bound(std::string(kRecordsItem) + "/");
  if (several != side.files.end() && several->first.starts_with(std::string(kRecordsItem) + "/"))
    return "several folders of records";
  for (const auto& [id, paths] : side.files)
    if (std::ranges::any_of(paths, is_drawn)) return "figures or images without records";
  return "";
}

void require_apart(const fs::path& baseline, const fs::path& current) {
  if (overlap(baseline, current))
    throw InvalidInput(fmt::format("BASELINE {} and CURRENT {}: one is the other or lies in it",
                                   baseline.string(), current.string()));
}

void require_same_kind(std::string_view before, std::string_view after, const fs::path& baseline,
                       const fs::path& current) {
  if (before != after)
    throw InvalidInput(fmt::format("BASELINE {} holds {}, CURRENT {} holds {}: not approved",
                                   baseline.string(), before, current.string(), after));
}

/// The kind of an item, as "png", or else the extension.
std::string format_of(const fs::path& file) {
  std::error_code error;
  if (fs::is_directory(file, error)) return "a folder";
  std::string kind = item_name(file, file.parent_path()).kind;
  if (!kind.empty()) return kind;
  const std::string extension = file.extension().string();
  return extension.size() < 2 ? "a file without an extension" : extension.substr(1);
}

/// @throws IoError if the first file of the folder's records has no schema.
void require_records(const fs::path& folder) {
  std::error_code error;
  for (const char* name : kHeads)
    if (const fs::path file = folder / name; fs::is_regular_file(file, error)) {
      schema_of(parse_json(read_file(file), file.string()).cursor());
      return;
    }
}

/// Requires that the current can replace the baseline: neither lies in the other, the current holds
/// something, and both hold the same kind of records, or both figures and images without records.
/// A baseline that holds nothing yet can be replaced by any current.
/// @throws InvalidInput with the reason; IoError if records cannot be read.
void require_comparable(const ApprovalSide& baseline, const ApprovalSide& current) {
  require_apart(baseline.root, current.root);
  if (current.files.empty())
    throw InvalidInput(fmt::format("CURRENT {} holds no records, figures, images or tables",
                                   current.root.string()));
  for (const auto& [id, paths] : current.files)
    if (id == kRecordsItem)
      require_records(current.root);
    else if (id.starts_with(std::string(kRecordsItem) + "/"))
      require_records(current.root / fs::path(id).filename());
  const std::string_view before = kind_of(baseline), after = kind_of(current);
  if (!before.empty() && !after.empty())
    require_same_kind(before, after, baseline.root, current.root);
  for (const auto& [id, paths] : baseline.files) {
    if (!id.starts_with(std::string(kRecordsItem) + "/") || !current.files.contains(id)) continue;
    const fs::path name = fs::path(id).filename();
    const auto was = kind_of_records(baseline.root / name),
               is = kind_of_records(current.root / name);
    if (!was.empty() && !is.empty())
      require_same_kind(was, is, baseline.root / name, current.root / name);
  }
}

/// The same for two single files, which must have one format. @throws InvalidInput.
void require_comparable_files(const fs::path& baseline, const fs::path& current) {
  require_apart(baseline, current);
  std::error_code error;
  if (!fs::is_regular_file(current, error))
    throw InvalidInput(fmt::format("CURRENT {} is not a file", current.string()));
  if (fs::file_size(current, error) == 0 && !error)
    throw InvalidInput(fmt::format("CURRENT {} is empty", current.string()));
  require_same_kind(format_of(baseline), format_of(current), baseline, current);
}

constexpr std::size_t kLongestName = 4096;  // Characters, as printed.

std::vector<std::string> chosen_ids(const ApprovalRequest& request, const ApprovalFiles& before,
                                    const ApprovalFiles& after) {
  std::set<std::string> known;
  for (const ApprovalFiles* side : {&before, &after})
    for (const auto& [id, paths] : *side) known.insert(id);
  if (request.all) {
    // Further baselines ID@KEY are replaced or kept with their item ID.
    std::erase_if(known, [&](const std::string& id) {
      return !after.contains(id) && after.contains(id.substr(0, id.rfind('@')));
    });
    return {known.begin(), known.end()};
  }
  const std::vector<std::string_view> names(known.begin(), known.end());
  std::vector<std::string> ids;
  for (const std::string& id : request.ids) {
    // The id itself, or as a diff prints it if a terminal cannot show it.
    const auto own = known.contains(id) ? known.find(id)
                                        : std::ranges::find_if(known, [&](const std::string& one) {
                                            return printable(one, kLongestName) == id;
                                          });
    if (own == known.end()) {
      const std::string_view meant = likely_word(id, names);
      throw InvalidInput("neither BASELINE nor CURRENT has \"" + printable(id) + "\"" +
                         (meant.empty() ? "" : "; did you mean \"" + std::string(meant) + "\"?"));
    }
    ids.push_back(*own);
  }
  return ids;
}

/// The files of records that a figure was made from, below the study's folder.
std::set<fs::path> records_of(const Figure& figure, const fs::path& study) {
  std::set<fs::path> files;
  for (const std::string& record : figure.record_ids)
    for (const fs::path& file : files_of_run(study, record.substr(0, record.find('/'))))
      files.insert(file);
  return files;
}

class Planner {
 public:
  /// @param decoded  Files of the current that need no reading.
  Planner(const fs::path& baseline, const fs::path& current, std::set<fs::path> decoded = {})
      : baseline_(baseline),
        current_(current),
        decoded_(std::move(decoded)),
        before_(approval_files(baseline)),
        after_(approval_files(current)) {}

  ApprovalPlan plan(const ApprovalRequest& request) {
    require_comparable({baseline_, before_}, {current_, after_});
    std::vector<std::string> ids = chosen_ids(request, before_, after_);
    const auto is_records = [](const std::string& id) {
      return id == kRecordsItem || id.starts_with("records/");
    };
    std::ranges::stable_partition(ids, is_records);
    const bool whole = !ids.empty() && is_records(ids.front());
    ApprovalPlan plan;
    for (const std::string& id : ids) {
      const std::size_t before = steps_.size();
      try {
        add_id(id, request.key, whole);
      } catch (const InvalidInput& error) {
        if (!request.all) throw;
        steps_.resize(before);
        plan.refused.push_back(id + ": " + error.what());
      }
    }
    plan.steps = std::move(steps_);
    if (request.all && !request.force) require_most_stays(plan.steps);
    return plan;
  }

  /// Why the item cannot be approved; empty if it can.
  /// @param whole  Whether all records are approved with it.
  std::string refusal(const std::string& id, bool whole) {
    planned_.clear();
    steps_.clear();
    try {
      if (!before_.contains(id) && !after_.contains(id)) throw InvalidInput("has no files to take");
      if (const std::string& why = not_comparable(); !why.empty()) return why;
      add_id(id, "", whole);
      return "";
    } catch (const InvalidInput& error) {
      return error.what();
    }
  }

  bool has_records() const { return after_.contains(kRecordsItem); }

 private:
  /// Why the sides are not comparable; empty if they are. Examined once, not for each item.
  const std::string& not_comparable() {
    if (!not_comparable_) {
      not_comparable_ = "";
      try {
        require_comparable({baseline_, before_}, {current_, after_});
      } catch (const InvalidInput& error) {
        not_comparable_ = error.what();
      }
    }
    return *not_comparable_;
  }

  /// @param whole  Whether all records are approved too.
  void add_id(const std::string& id, const std::string& key, bool whole) {
    if (!key.empty()) return add_keyed(id, key);
    if (!whole) add_records_of(id);
    add_item(id);
  }

  /// Refuses to remove most files: this is the sign of a mistaken CURRENT.
  void require_most_stays(const std::vector<ApprovalStep>& steps) const {
    std::set<fs::path> files;
    for (const auto& [id, paths] : before_) files.insert(paths.begin(), paths.end());
    const auto removed =
        std::ranges::count_if(steps, [](const ApprovalStep& step) { return step.from.empty(); });
    if (2 * removed > std::ssize(files))
      throw InvalidInput(
          fmt::format("--all would remove {} of {} files of {}, which CURRENT {} does "
                      "not have; --force does so",
                      removed, files.size(), baseline_.string(), current_.string()));
  }

  /// Adds a step for a file that differs and has none yet. @return Whether it did.
  bool add(const fs::path& relative) {
    const fs::path from = current_ / relative, to = baseline_ / relative;
    require_plain(current_, relative);
    if (!planned_.insert(relative).second || same_bytes(from, to)) return false;
    if (!decoded_.contains(from)) require_readable(from);
    require_no_folder(to);
    steps_.push_back({from, relative});
    return true;
  }

  void remove(const fs::path& relative) {
    if (planned_.insert(relative).second) steps_.push_back({{}, relative});
  }

  /// Removes the further baselines ID@KEY of an image that is replaced: they show the old one.
  void remove_keyed(const std::string& id, const fs::path& extension) {
    const std::string start = id + "@";
    for (auto other = before_.lower_bound(start);
         other != before_.end() && other->first.starts_with(start); ++other)
      if (!after_.contains(other->first))
        for (const fs::path& path : other->second)
          if (path.extension() == extension) remove(path);
  }

  void add_item(const std::string& id) {
    const auto before = before_.find(id), after = after_.find(id);
    if (after != after_.end())
      for (const fs::path& path : after->second)
        if (add(path)) remove_keyed(id, path.extension());
    if (before == before_.end()) return;
    for (const fs::path& path : before->second)
      if (after == after_.end() || !after->second.contains(path)) {
        require_gone(current_ / path);
        remove(path);
      }
  }

  /// Adds the images of an item as ID@KEY.
  void add_keyed(const std::string& id, const std::string& key) {
    const auto after = after_.find(id);
    if (after == after_.end()) return;
    for (const fs::path& path : after->second) {
      const std::string extension = path.extension().string();
      if (extension != ".png" && extension != ".svg") continue;
      require_plain(current_, path);
      require_readable(current_ / path);
      const fs::path name = fmt::format("{}@{}{}", path.stem().string(), key, extension);
      steps_.push_back({current_ / path, path.parent_path() / name});
    }
  }

  /// Adds the records that a figure names, if both sides are studies.
  void add_records_of(const std::string& id) {
    const auto after = after_.find(id);
    if (after == after_.end() || !is_study(current_) || !is_study(baseline_)) return;
    for (const fs::path& path : after->second) {
      if (!path.filename().string().ends_with(".figure.json")) continue;
      const fs::path file = current_ / path;
      require_plain(current_, path);
      require_readable(file);
      const Figure figure = figure_from_json(read_file(file), file.string());
      for (const fs::path& record : records_of(figure, current_)) add_record(id, record);
    }
  }

  void add_record(const std::string& id, const fs::path& relative) {
    std::error_code error;
    if (!fs::is_regular_file(current_ / relative, error)) return;
    if (same_bytes(current_ / relative, baseline_ / relative)) return;
    // A file that cannot be read is not another.
    if (!fs::is_regular_file(baseline_ / kStudyFile, error) ||
        read_file(current_ / kStudyFile) != read_file(baseline_ / kStudyFile))
      throw InvalidInput(id + ": its records are of another experiment or solver than the " +
                         "baseline's; approve records with it, or --all");
    add(relative);
  }

  fs::path baseline_, current_;
  std::set<fs::path> decoded_;
  ApprovalFiles before_, after_;
  std::optional<std::string> not_comparable_;
  std::set<fs::path> planned_;
  std::vector<ApprovalStep> steps_;
};

bool is_key(const std::string& key) {
  return std::ranges::all_of(key, [](char c) { return is_plain(c, "._-"); });
}

}  // namespace

ApprovalPlan approval_plan(const fs::path& baseline, const fs::path& current,
                           const ApprovalRequest& request) {
  if (!is_key(request.key))
    throw InvalidInput("the key \"" + printable(request.key) +
                       "\" may hold letters, digits, '.', '_' and '-' alone");
  std::error_code error;
  if (!fs::exists(current, error)) throw IoError(current.string(), "does not exist");
  refuse_links_out(current);
  return Planner(baseline, current).plan(request);
}

std::map<std::string, ApprovalRefusal> approval_refusals(const fs::path& baseline,
                                                         const fs::path& current,
                                                         const ApprovalQuestion& question) {
  std::map<std::string, ApprovalRefusal> refusals;
  std::error_code error;
  if (!fs::is_directory(current, error)) return refusals;
  Planner planner(baseline, current, question.decoded);
  for (const std::string& id : question.ids)
    if (const std::string why = planner.refusal(id, false); !why.empty())
      refusals[id] = {why, planner.has_records() && planner.refusal(id, true).empty()};
  return refusals;
}

namespace {

/// Makes the results.csv of a study again if records were taken without it.
/// @return Whether it did.
bool renew_results_table(const ApprovalPlan& plan, FolderReplacement& next) {
  std::error_code error;
  if (!fs::is_regular_file(next.copy() / kStudyFile, error) ||
      !fs::is_regular_file(next.copy() / kResultsFile, error))
    return false;
  const StudyKind* kind = kind_of_study(next.copy());
  if (kind == nullptr || kind->experiment.empty()) return false;  // The table itself is the record.
  const auto is_record = [&](const ApprovalStep& step) {
    return std::ranges::any_of(kind->records, [&](const fs::path& record) {
      return std::ranges::mismatch(record, step.file).in1 == record.end();
    });
  };
  const bool is_taken = std::ranges::find(plan.steps, fs::path(kResultsFile),
                                          &ApprovalStep::file) != plan.steps.end();
  if (is_taken || std::ranges::none_of(plan.steps, is_record)) return false;
  next.write(kResultsFile, results_table_of(next.copy()));
  return true;
}

}  // namespace

void apply(ApprovalPlan& plan, const fs::path& baseline) {
  if (plan.steps.empty()) return;
  FolderReplacement next(real_path(baseline));
  for (const ApprovalStep& step : plan.steps)
    step.from.empty() ? next.remove(step.file) : next.write(step.file, read_file(step.from));
  if (renew_results_table(plan, next)) plan.made.emplace_back(kResultsFile);
  next.commit();
  next.remove_old();
}

void approve_file(const fs::path& baseline, const fs::path& current) {
  require_comparable_files(baseline, current);
  require_readable(current);
  write_file(baseline, read_file(current));
}

std::vector<std::string> parse_approvals(std::string_view text, const std::string& source) {
  return from_json_text<ApprovalsFile>(text, source).ids;
}

}  // namespace mapproof
