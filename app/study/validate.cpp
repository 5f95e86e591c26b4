#include "app/commands.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "app/input_streams.hpp"
#include "app/table_options.hpp"
#include "app/understood.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/text/ascii.hpp"
#include "core/base/text/words.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"
#include "core/records/studies/study_page.hpp"
#include "core/records/tables/respelling.hpp"
#include "core/records/tables/table_reader.hpp"
#include "core/studies/validate.hpp"
#include "render/image/png_check.hpp"
#include "render/plot/figure_json.hpp"
#include "render/scene/scene_json.hpp"
#include "render/style/figure_style_fields.hpp"
#include "render/style/words.hpp"
#include "reports/diff/approvals/approvals.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/svg/svg_parser.hpp"
#include "reports/history/history_export.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

void check_svg(const std::string& bytes, const std::string& source) {
  try {
    parse_svg(bytes);
  } catch (const InvalidInput& error) {
    throw IoError(source, error.what());
  }
}

void check_png(const std::string& bytes, const std::string& source) {
  const std::string problem = png_problem(bytes);
  if (!problem.empty()) throw IoError(source, problem);
}

/// Files whose beginning and end show that they are whole.
void check_ends(const std::string& bytes, const std::string& source, std::string_view begin,
                std::string_view end) {
  if (!bytes.starts_with(begin))
    throw IoError(source, "line 1", fmt::format("expected \"{}\"", begin));
  if (!trimmed(bytes, kWhiteSpace).ends_with(end))
    throw IoError(source, fmt::format("is truncated: it does not end with \"{}\"", end));
}

/// Those of other programs are named with what converts them.
void check_pdf(const std::string& bytes, const std::string& source) {
  if (bytes.find("mapproof") == std::string::npos) refuse_other_kind(bytes, source);
  check_ends(bytes, source, "%PDF-", "%%EOF");
}

/// What a page carries: figures are read, of records that they are JSON.
void check_page_data(const std::string& bytes, const std::string& source) {
  for (const PageFile& file : parse_page(bytes, source).files) {
    const std::string name = source + ": " + file.name;
    if (file.name.ends_with(".figure.json"))
      figure_from_json(file.text, name);
    else if (file.name.ends_with(".scene.json"))
      scene_from_json(file.text, name);
    else if (file.name.ends_with(".json"))
      schema_of(parse_json(file.text, name).cursor());
  }
}

void check_page(const std::string& bytes, const std::string& source) {
  if (bytes.find("content=\"mapproof\"") == std::string::npos) refuse_other_kind(bytes, source);
  check_ends(bytes, source, "<!DOCTYPE html>", "</html>");
  if (carries_data(bytes)) check_page_data(bytes, source);
}

/// A table, or the snippet that includes a figure.
void check_latex(const std::string& bytes, const std::string& source) {
  if (bytes.find("\\includegraphics") != std::string::npos) {
    if (bytes.find("\\end{figure}") == std::string::npos)
      throw IoError(source, "is truncated: \\end{figure} is missing");
    return;
  }
  for (const char* part : {"\\toprule", "\\bottomrule", "\\end{table}"})
    if (bytes.find(part) == std::string::npos)
      throw IoError(source, fmt::format("is not a table of mapproof: {} is missing", part));
}

void check_eps(const std::string& bytes, const std::string& source) {
  check_ends(bytes, source, "%!PS-Adobe", "%%EOF");
}

void check_gif(const std::string& bytes, const std::string& source) {
  check_ends(bytes, source, "GIF8", ";");
}

void check_mp4(const std::string& bytes, const std::string& source) {
  if (bytes.size() < 12 || bytes.substr(4, 4) != "ftyp")
    throw IoError(source, "does not begin as an MP4 does");
}

/// What `render --as matplotlib` wrote.
void check_script(const std::string& bytes, const std::string& source) {
  if (bytes.find("import matplotlib") == std::string::npos)
    throw IoError(source, "is not a script of mapproof: it does not import matplotlib");
}

void check_junit(const std::string& bytes, const std::string& source) {
  check_ends(bytes, source, "<?xml", "</testsuites>");
}

void check_markdown(const std::string& bytes, const std::string& source) {
  if (bytes.find("\n|") == std::string::npos)
    throw IoError(source, "is not a table of mapproof: it has no row");
}

void check_csv(const std::string& bytes, const std::string& source) {
  TableReader reader(bytes, source, ',');
  TableRow row;
  std::size_t width = 0;
  while (reader.next(row)) {
    if (width == 0) width = row.cells.size();
    if (row.cells.size() != width)
      throw IoError(source, fmt::format("line {}", row.line),
                    fmt::format("has {} cells, expected {}", row.cells.size(), width));
  }
  if (width == 0) throw IoError(source, "is empty");
}

/// A type of file that is written and never read again.
struct StagedOutput {
  std::string_view extension;
  std::array<std::string_view, 2> starts;  ///< Of no other files; empty: none.
  std::string_view kind;
  void (*check)(const std::string& bytes, const std::string& source);
};

constexpr std::array kOutputs = {
    StagedOutput{".svg", {"<svg", "<?xml"}, "figure, SVG", check_svg},
    StagedOutput{".png", {"\x89PNG"}, "figure, PNG", check_png},
    StagedOutput{".pdf", {"%PDF-"}, "figure, PDF", check_pdf},
    StagedOutput{".html", {"<!DOCTYPE html>"}, "report", check_page},
    StagedOutput{".eps", {"%!PS-Adobe"}, "figure, EPS", check_eps},
    StagedOutput{".gif", {"GIF8"}, "animation, GIF", check_gif},
    StagedOutput{".mp4", {}, "animation, MP4", check_mp4},
    StagedOutput{".py", {}, "script for matplotlib", check_script},
    StagedOutput{".xml", {}, "JUnit, XML", check_junit},
    StagedOutput{
        ".tex", {"\\begin{table}", "% Needs \\usepackage{graphicx}"}, "LaTeX", check_latex},
    StagedOutput{".md", {}, "table, Markdown", check_markdown},
    StagedOutput{".csv", {}, "table, CSV", check_csv},
};

constexpr StagedOutput kFigureData{".csv", {}, "data of a figure, CSV", check_csv};

/// The type of an output file by its name; null for files that core reads. Its folder distinguishes
/// a table's CSV from observations.
const StagedOutput* output_named(const fs::path& path) {
  const auto* found =
      std::ranges::find(kOutputs, path.extension().string(), &StagedOutput::extension);
  if (found == kOutputs.end()) return nullptr;
  if (found->extension == ".csv" && path.parent_path().filename() != "tables") return nullptr;
  return found;
}

/// The first cells of the data of a figure, see figure_csv().
bool is_figure_data(ByteSource& source) {
  constexpr std::string_view kStart = "panel,layer,shape,";
  return source.peek(kStart.size()) == kStart;
}

/// By its name; if the name is of no use, as that of a stream, by its first bytes.
const StagedOutput* output_of(ByteSource& source) {
  const fs::path name = unpacked_name(source.path());
  if (is_figure_data(source)) return &kFigureData;
  if (name.has_extension()) return output_named(name);
  const std::string_view bytes = source.peek();
  const auto begins = [&](std::string_view start) {
    return !start.empty() && bytes.starts_with(start);
  };
  const auto* found = std::ranges::find_if(kOutputs, [&](const StagedOutput& output) {
    return std::ranges::any_of(output.starts, begins);
  });
  return found == kOutputs.end() ? nullptr : found;
}

Finding check_output(const std::string& name, const StagedOutput& output,
                     const std::function<std::string()>& read) {
  Finding finding{.path = name, .kind = std::string(output.kind), .problem = ""};
  try {
    output.check(read(), finding.path);
  } catch (const IoError& error) {
    finding.problem = error.what();
  }
  return finding;
}

/// The output files below a folder, in the order of their paths.
std::vector<fs::path> outputs_below(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (output_named(entry->path()) != nullptr) paths.push_back(entry->path());
  std::ranges::sort(paths);
  return paths;
}

Finding check_file(const fs::path& path, const ForeignReader& foreign,
                   const ValidateOptions& options) {
  try {
    ByteSource source(path);
    if (const StagedOutput* output = output_of(source))
      return check_output(source.name(), *output, [&] { return source.rest(); });
    return validate(source, foreign, options);
  } catch (const IoError& error) {
    return {.path = input_name(path), .kind = "", .problem = error.what()};
  }
}

/// Checks whatever mapproof reads or writes: what core knows (see validate), and the images, tables
/// and pages that it writes and never reads again. Of a study's or a map's folder, both.
std::vector<Finding> validate_all(const fs::path& path, const ForeignReader& foreign,
                                  const ValidateOptions& options) {
  if (!is_folder(path)) return {check_file(path, foreign, options)};
  std::vector<Finding> findings = validate(path, foreign, options);
  // Nobody unpacks an image of a folder: there it has to be one as it is.
  for (const fs::path& output : outputs_below(path))
    findings.push_back(
        check_output(output.string(), *output_named(output), [&] { return read_file(output); }));
  return findings;
}

/// Reads the JSON formats that rest on more than core's records.
bool read_foreign(std::string_view schema, std::string_view text, const std::string& source) {
  if (schema == "mapproof.figure")
    figure_from_json(text, source);
  else if (schema == "mapproof.scene")
    scene_from_json(text, source);
  else if (schema == "mapproof.style")
    words_of(figure_style_from_json(text, source));  // Its language has to be known.
  else if (schema == "mapproof.diff_settings")
    parse_diff_settings(text, source);
  else if (schema == "mapproof.approvals")
    parse_approvals(text, source);
  else if (schema == "mapproof.decisions")
    parse_decisions(text, source);
  else
    return false;
  return true;
}

struct ValidateArguments {
  std::vector<std::string> paths, odometry, anchors, ground_truth;
  std::string sensor;
  TableOptions table;
};

/// A file, and what it is stated to be.
struct StatedInput {
  std::string path;
  InputRole role;
};

std::vector<StatedInput> stated_inputs(const ValidateArguments& arguments) {
  std::vector<StatedInput> inputs;
  const auto add = [&](const std::vector<std::string>& paths, InputRole role) {
    for (const std::string& path : paths) inputs.push_back({path, role});
  };
  add(arguments.paths, InputRole::kAny);
  add(arguments.odometry, InputRole::kOdometry);
  add(arguments.anchors, InputRole::kAnchors);
  add(arguments.ground_truth, InputRole::kGroundTruth);
  if (inputs.empty())
    throw InvalidInput("name a file: FILE, --odometry, --anchors or --ground-truth");
  return inputs;
}

/// Marks the named columns that one of several files has: the others need not. A file that cannot
/// be read is reported later.
void mark_found(const std::vector<StatedInput>& inputs, ColumnNames& columns) {
  if (inputs.size() < 2) return;
  for (const StatedInput& input : inputs) {
    try {
      mark_columns_of_file(input.path, columns);
    } catch (const IoError&) {
    }
  }
}

/// The problems of a file; those that differ in their numbers alone share a line.
std::string problems_text(const Finding& finding) {
  struct Group {
    std::string kind;
    std::string first;
    int more = 0;
  };
  std::vector<Group> groups;
  const auto add = [&](const std::string& problem) {
    std::string kind = problem;
    std::erase_if(kind, is_digit);
    const auto group = std::ranges::find(groups, kind, &Group::kind);
    if (group == groups.end())
      groups.push_back({.kind = kind, .first = problem});
    else
      ++group->more;
  };
  add(finding.problem);
  for (const std::string& further : finding.further) add(further);
  std::string text;
  for (const Group& group : groups)
    text += printable(group.first, 4000) +
            (group.more > 0 ? fmt::format(" (and {} more like it)\n", group.more) : "\n");
  return text;
}

/// What a file is and what was understood of it, or its problems.
std::string finding_text(const Finding& finding) {
  std::string text;
  if (!finding.problem.empty()) {
    text = problems_text(finding);
  } else if (finding.input) {
    text = fmt::format("{} ({})\n", understood_line(finding.path, *finding.input), finding.kind);
  } else if (finding.companion) {
    text =
        fmt::format("{} ({})\n", understood_line(finding.path, *finding.companion), finding.kind);
  } else {
    text = fmt::format("{}: {}\n", printable(finding.path, 300), finding.kind);
  }
  for (const std::string& remark : finding.remarks) text += "  (" + printable(remark, 4000) + ")\n";
  return text;
}

nlohmann::ordered_json finding_json(const Finding& finding) {
  nlohmann::ordered_json object{{"path", finding.path},
                                {"kind", finding.kind},
                                {"valid", finding.problem.empty()},
                                {"problem", finding.problem},
                                {"further_problems", finding.further},
                                {"remarks", finding.remarks}};
  if (finding.input) object["input"] = understood_json(*finding.input);
  if (finding.companion) object["input"] = understood_json(*finding.companion);
  return object;
}

int validate_files(const ValidateArguments& arguments, const Invocation& invocation) {
  const std::vector<StatedInput> inputs = stated_inputs(arguments);
  std::vector<std::string> paths;
  for (const StatedInput& input : inputs) paths.push_back(input.path);
  refuse_shared_streams(paths);
  ValidateOptions options{.format = arguments.table.format(kAllRoles), .sensor = arguments.sensor};
  mark_found(inputs, options.format.columns);
  nlohmann::ordered_json object{{"valid", true}, {"files", nlohmann::ordered_json::array()}};
  std::string text;
  bool all_valid = true;
  const ProgressLine working(invocation.console, "reading");
  for (const auto& [path, role] : inputs) {
    options.role = role;
    for (const Finding& finding : validate_all(path, read_foreign, options)) {
      all_valid &= finding.problem.empty();
      object["files"].push_back(finding_json(finding));
      text += finding_text(finding);
    }
  }
  object["valid"] = all_valid;
  invocation.console.result(text, object);
  return all_valid ? kDone : kNo;
}

}  // namespace

Action validate_command(CLI::App& app) {
  auto arguments = std::make_shared<ValidateArguments>();
  app.description("Check files that mapproof reads or writes, and say what is wrong with them");
  app.footer(
      "Examples:\n"
      "  mapproof validate observations.csv anchors.csv\n"
      "  mapproof validate bearings.csv --sensor bearing --degrees\n"
      "  mapproof validate ranges.csv --odometry wheels.csv --ground-truth gps.csv --columns "
      "time=Zeit,distance=Weg\n"
      "  mapproof validate out\n\n"
      "A table is read as map and slam read it; up to ten problems are reported.\n"
      "Exit code 1 if a file is not valid or not there.\n");
  app.add_option("FILE", arguments->paths, "Files, or folders of studies and maps");
  app.add_option("--sensor", arguments->sensor,
                 "What the values of tables are; without it, any that fits")
      ->transform(one_of({"visibility", "bearing", "range", "range-bearing"}));
  const auto add_files = [&](const char* option, std::vector<std::string>& files,
                             const char* description) {
    app.add_option(option, files, description)->allow_extra_args(false)->type_name("FILE");
  };
  add_files("--odometry", arguments->odometry, "Odometry, as slam takes it");
  add_files("--anchors", arguments->anchors, "Known positions, as map and slam take them");
  add_files("--ground-truth,--truth", arguments->ground_truth,
            "True positions of landmarks or a true path, as map and slam take them");
  group_options(app, {{"Input", {"FILE", "--sensor"}},
                      {"Files of one kind", {"--odometry", "--anchors", "--ground-truth"}}});
  add_table_options(app, arguments->table);
  return
      [arguments](const Invocation& invocation) { return validate_files(*arguments, invocation); };
}

}  // namespace mapproof
