#include "core/records/range_log_files.hpp"

#include <array>
#include <string_view>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/records/range_log_readers.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

enum class Form { kNone, kCsv, kMat, kPyfg, kText };

constexpr std::array<std::string_view, 2> kTextEnds = {"_DR.txt", "_TD.txt"};

/// The path without _DR.txt or _TD.txt; empty if it ends in neither.
fs::path text_stem(const fs::path& path) {
  const std::string whole = path.string();
  for (const std::string_view end : kTextEnds)
    if (path.filename().string().ends_with(end)) return whole.substr(0, whole.size() - end.size());
  return {};
}

Form form_of(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error))
    return fs::exists(path / "ranges.csv", error) ? Form::kCsv : Form::kNone;
  if (path.filename() == "ranges.csv") return Form::kCsv;
  if (path.extension() == ".mat") return Form::kMat;
  if (path.extension() == ".pyfg") return Form::kPyfg;
  return text_stem(path).empty() ? Form::kNone : Form::kText;
}

/// "Plaza1" of Plaza1_.mat, "plaza1" of plaza1/ranges.csv.
std::string name_of(const fs::path& path, Form form) {
  fs::path part = path;
  if (form == Form::kCsv) part = fs::absolute(path).lexically_normal();
  if (form == Form::kCsv && (!part.has_filename() || part.filename() == "ranges.csv"))
    part = part.parent_path();
  std::string name = form == Form::kText  ? text_stem(path).filename().string()
                     : form == Form::kCsv ? part.filename().string()
                                          : part.stem().string();
  while (name.size() > 1 && name.back() == '_') name.pop_back();
  return name;
}

}  // namespace

RangeLog read_range_log(const fs::path& path, const RangeLogOptions& options) {
  std::error_code error;
  if (!fs::exists(path, error)) throw IoError(path.string(), "is not there");
  const Form form = form_of(path);
  RangeLogOptions named = options;
  if (named.name.empty()) named.name = name_of(path, form);
  switch (form) {
    case Form::kCsv:
      return read_range_log_csv(fs::is_directory(path, error) ? path : path.parent_path(), named);
    case Form::kMat:
      return read_range_log_mat(path, named);
    case Form::kPyfg:
      return read_range_log_pyfg(path, named);
    case Form::kText:
      return read_range_log_text(text_stem(path), named);
    case Form::kNone:
      break;
  }
  throw IoError(path.string(),
                "holds no ranges: expected a folder with ranges.csv, or NAME.mat, NAME.pyfg, "
                "NAME_DR.txt with NAME_TD.txt");
}

bool is_range_log(const fs::path& path) {
  // Other tables may be called ranges.csv too.
  if (path.filename() == "ranges.csv" && !has_range_columns(path)) return false;
  return form_of(path) != Form::kNone;
}

}  // namespace mapproof
