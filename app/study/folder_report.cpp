#include "app/study/folder_report.hpp"

#include <algorithm>
#include <iterator>
#include <mutex>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "app/command_line.hpp"
#include "app/disclosure.hpp"
#include "app/study/embedded_experiments.hpp"
#include "app/study/study_outputs.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/parallel.hpp"
#include "core/base/text/words.hpp"
#include "core/base/version.hpp"
#include "core/records/studies/study_store.hpp"
#include "render/output/write_figure.hpp"
#include "render/output/write_scene.hpp"
#include "reports/html/block_data.hpp"
#include "reports/html/report_html.hpp"
#include "reports/html/report_pages.hpp"
#include "reports/sections/opening.hpp"
#include "reports/sections/slam/slam_figures.hpp"
#include "reports/sections/slam/slam_report.hpp"
#include "reports/sections/slam/slam_text.hpp"
#include "reports/sections/wording.hpp"
#include "reports/tables/write_tables.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

bool is_paper_study(const FolderReport& part) { return part.origin == StudyOrigin::kPaper; }

/// What the reader of several papers' results sees first.
Section contents_section(const std::vector<FolderReport>& parts) {
  const bool papers_alone = std::ranges::all_of(parts, is_paper_study);
  Section section{"papers", papers_alone ? "Papers" : "Studies", {}};
  BulletList papers;
  for (const FolderReport& part : parts) {
    for (const std::string& missing : part.missing)
      section.blocks.emplace_back(
          Callout{Callout::Tone::kWarning, "Data are missing", {{{missing, Emphasis::kPlain}}}});
    papers.items.push_back({{{part.report.title, Emphasis::kStrong},
                             {". " + part.report.subtitle + ".", Emphasis::kPlain}}});
  }
  section.blocks.emplace_back(std::move(papers));
  return section;
}

constexpr const char* kReportFile = "report.html";

std::string figure_command(const fs::path& folder, const Disclosure& disclosure) {
  return quoted_command(
      {"mapproof", "render", disclosure.words({folder.string()}).front(), "--figure"});
}

constexpr std::size_t kMostNumbers = 6, kMostFindings = 6;

/// How many of a part's figures leave room for those of the others.
std::size_t share_of(std::size_t most, std::size_t parts) {
  return std::max<std::size_t>(1, most / parts);
}

/// The number of lines in the panel of a part's main figure that has most; 0 if there is none.
std::ptrdiff_t lines_of_main_figure(const FolderReport& part) {
  const auto figure = std::ranges::find(part.figures, part.report.opening.main_figure, &Figure::id);
  if (figure == part.figures.end()) return 0;
  std::ptrdiff_t lines = 0;
  for (const Panel& panel : figure->panels)
    lines = std::max(lines, std::ranges::count_if(panel.layers, [](const Layer& layer) {
                       return std::holds_alternative<Polyline>(layer);
                     }));
  return lines;
}

/// Of papers the first one's; of other studies the one with most lines.
std::string main_figure_of(const std::vector<FolderReport>& parts) {
  const auto has_one = [](const FolderReport& part) {
    return !part.report.opening.main_figure.empty();
  };
  const auto first = std::ranges::find_if(parts, has_one);
  if (first == parts.end()) return "";
  if (is_paper_study(*first)) return first->report.opening.main_figure;
  return std::ranges::max_element(parts, {}, lines_of_main_figure)->report.opening.main_figure;
}

/// "no usable map of dataset6 and 2 more": the first of a part's warnings without its details.
std::string first_warning(const std::vector<std::string>& warnings) {
  const std::string& first = warnings.front();
  const std::string what = first.substr(0, first.find(": "));
  return warnings.size() == 1 ? what : fmt::format("{} and {} more", what, warnings.size() - 1);
}

/// "10 studies of 23 runs".
Paragraph extent_of(const std::vector<FolderReport>& parts) {
  std::size_t runs = 0;
  std::vector<std::string> titles;
  for (const FolderReport& part : parts) {
    runs += part.runs;
    titles.push_back(part.report.title);
  }
  // The contents have the titles of many.
  const std::string which = titles.size() > 3 ? "" : ": " + listed(titles, 3);
  return plain(fmt::format("{} studies of {}{}.", parts.size(),
                           counted(static_cast<long long>(runs), "run"), which));
}

/// What is missing of the studies, and which have warnings or are not as expected.
Paragraph wrong_of(const std::vector<FolderReport>& parts) {
  std::vector<std::string> incomplete;
  for (const FolderReport& part : parts)
    if (!part.incomplete.empty() || !part.missing.empty()) incomplete.push_back(part.report.title);
  std::string wrong = incomplete.empty()
                          ? std::string("no run is missing.")
                          : fmt::format("runs are missing in {}.", listed(incomplete, 3));
  std::vector<std::string> unexpected, warned;
  for (const FolderReport& part : parts) {
    const std::vector<std::string>& warnings = part.report.opening.warnings;
    if (warnings.empty()) continue;
    // Of what is not as expected, a tile has the rest.
    if (part.reached_aim == false)
      unexpected.push_back(part.report.title);
    else
      warned.push_back(fmt::format("{} ({})", part.report.title, first_warning(warnings)));
  }
  constexpr std::size_t kMostNamed = 4;
  if (!unexpected.empty())
    wrong += fmt::format(" Not as expected: {}.", listed(unexpected, kMostNamed));
  if (!warned.empty()) wrong += fmt::format(" To be looked at: {}.", listed(warned, kMostNamed));
  return plain(": " + wrong);
}

/// How many of the studies that expect a result gave it, and which did not; none if no study
/// expects one.
std::optional<Highlights::Item> verdict_of(const std::vector<FolderReport>& parts) {
  std::ptrdiff_t judged = 0;
  std::vector<std::string> short_of;
  for (const FolderReport& part : parts) {
    if (!part.reached_aim) continue;
    ++judged;
    if (!*part.reached_aim) short_of.push_back(part.report.title);
  }
  if (judged == 0) return std::nullopt;
  const std::ptrdiff_t open = std::ssize(parts) - judged;
  std::string detail = short_of.empty() ? "" : "not: " + listed(short_of, 4);
  if (open > 0)
    detail += fmt::format("{}{} no expected result", detail.empty() ? "" : "; ",
                          open == 1 ? "1 study has" : fmt::format("{} studies have", open));
  return Highlights::Item{.label = "studies gave the expected result",
                          .value = fmt::format("{} of {}", judged - std::ssize(short_of), judged),
                          .detail = std::move(detail),
                          .falls_short = !short_of.empty()};
}

/// The first number of each part, and what it is compared with: as a finding where there are too
/// many of them for a tile each. Tiles then have the verdict over all, what falls short, and some
/// of the others.
void add_first_numbers(const std::vector<FolderReport>& parts, Opening& all) {
  all.findings = {extent_of(parts)};  // The sections of each have the others.
  all.wrong = wrong_of(parts);
  all.compared_with = plain(": what each result has to beat, which stands beside it.");
  const bool are_many = parts.size() > kMostNumbers;
  std::vector<Highlights::Item> numbers;
  for (const FolderReport& part : parts) {
    if (part.report.opening.numbers.items.empty()) continue;
    const Highlights::Item& number = part.report.opening.numbers.items.front();
    if (are_many)
      all.findings.push_back(
          {{strong(part.report.title),
            phrase(fmt::format(": {} {}{}.", number.value, number.label,
                               number.detail.empty() ? "" : "; " + number.detail))}});
    numbers.push_back(number);
  }
  if (are_many) {
    std::ranges::stable_partition(numbers, &Highlights::Item::falls_short);
    if (auto verdict = verdict_of(parts)) numbers.insert(numbers.begin(), *std::move(verdict));
    numbers.resize(std::min(numbers.size(), kMostNumbers));
  }
  all.numbers.items = std::move(numbers);
}

/// "Yairi 2007" of "Map building without localization (Yairi 2007), section 4".
std::string short_title(const std::string& title) {
  const std::size_t from = title.rfind('('), to = title.rfind(')');
  const bool has_one = from != std::string::npos && to != std::string::npos && from + 1 < to;
  return has_one ? title.substr(from + 1, to - from - 1) : title;
}

/// A part's finding where those of others stand, too: the first under its title, others with a
/// short one after the word that they begin with.
Paragraph named_finding(const FolderReport& part, std::size_t index) {
  Paragraph finding = part.report.opening.findings[index];
  auto& phrases = finding.phrases;
  const bool is_headed = !phrases.empty() && phrases.front().emphasis == Emphasis::kStrong;
  if (index == 0 || !is_headed)
    phrases.insert(phrases.begin(), strong(part.report.title + ". "));
  else
    phrases.insert(phrases.begin() + 1, phrase(", " + short_title(part.report.title)));
  return finding;
}

/// What all parts say after one word, each after its short title.
Paragraph joined_line(const std::vector<FolderReport>& parts, Paragraph Opening::*line) {
  Paragraph all;
  for (const FolderReport& part : parts) {
    const Paragraph& own = part.report.opening.*line;
    if (own.phrases.empty()) continue;
    if (parts.size() > 1)
      all.phrases.push_back(
          phrase((all.phrases.empty() ? ", " : " ") + short_title(part.report.title)));
    all.phrases.insert(all.phrases.end(), own.phrases.begin(), own.phrases.end());
  }
  return all;
}

/// As many of each part's numbers and findings as leave room for the others'; findings in turns.
void add_shares(const std::vector<FolderReport>& parts, Opening& all) {
  for (const FolderReport& part : parts) {
    const auto& numbers = part.report.opening.numbers.items;
    const auto taken =
        static_cast<std::ptrdiff_t>(std::min(numbers.size(), share_of(kMostNumbers, parts.size())));
    all.numbers.items.insert(all.numbers.items.end(), numbers.begin(), numbers.begin() + taken);
  }
  for (std::size_t turn = 0; turn < share_of(kMostFindings, parts.size()); ++turn)
    for (const FolderReport& part : parts)
      if (turn < part.report.opening.findings.size())
        all.findings.push_back(named_finding(part, turn));
  all.wrong = joined_line(parts, &Opening::wrong);
  all.compared_with = joined_line(parts, &Opening::compared_with);
}

/// The small figures of all parts in turns: the first ones of all, then the second ones, and so on.
/// Of papers each one's main figure leads. Other studies have it last; those that have a map in
/// space come first, and one such map before all.
std::vector<std::string> small_figures_of(const std::vector<FolderReport>& parts,
                                          const std::string& main_figure) {
  const bool are_papers = std::ranges::any_of(parts, is_paper_study);
  std::vector<std::vector<std::string>> in_space, others;
  std::vector<std::string> ids;
  for (const FolderReport& part : parts) {
    const Opening& opening = part.report.opening;
    std::vector<std::string> own = opening.figure_ids;
    if (!opening.main_figure.empty() && opening.main_figure != main_figure)
      own.insert(are_papers ? own.begin() : own.end(), opening.main_figure);
    const bool has_scene = !are_papers && !part.scenes.empty();
    if (has_scene && ids.empty()) ids.push_back(part.scenes.front().id);
    (has_scene ? in_space : others).push_back(std::move(own));
  }
  in_space.insert(in_space.end(), others.begin(), others.end());
  for (std::string& id : in_turns(in_space))
    if (std::ranges::find(ids, id) == ids.end()) ids.push_back(std::move(id));
  ids.resize(std::min(ids.size(), kMostCandidates));
  return ids;
}

/// What the reader of several papers or studies sees first.
Opening joined_opening(const std::vector<FolderReport>& parts) {
  Opening all;
  if (parts.size() > 1 && std::ranges::none_of(parts, is_paper_study))
    add_first_numbers(parts, all);
  else
    add_shares(parts, all);
  all.main_figure = main_figure_of(parts);
  all.figure_ids = small_figures_of(parts, all.main_figure);
  return all;
}

std::string title_of(const std::vector<FolderReport>& parts) {
  if (std::ranges::any_of(parts, is_paper_study)) return "Maps from what a robot observed";
  const bool are_topics = std::ranges::all_of(
      parts, [](const FolderReport& part) { return part.origin == StudyOrigin::kTopic; });
  return are_topics ? "Beyond the papers: studies side by side" : "Studies side by side";
}

}  // namespace

FolderReport joined_report(const fs::path& folder, std::vector<FolderReport> parts) {
  FolderReport all{.folder = folder, .is_of_studies = true};
  all.report.title = title_of(parts);
  all.report.subtitle = std::ranges::all_of(parts, is_paper_study)
                            ? "Two papers reproduced"
                            : fmt::format("{} studies", parts.size());
  if (parts.size() == 2)  // More would fill the head of the page; they are listed below it.
    all.report.subtitle += fmt::format(": {} and {}", short_title(parts[0].report.title),
                                       short_title(parts[1].report.title));
  all.report.opening = joined_opening(parts);
  all.report.sections.push_back(contents_section(parts));
  for (FolderReport& part : parts) {
    all.runs += part.runs;
    std::ranges::move(part.figures, std::back_inserter(all.figures));
    std::ranges::move(part.scenes, std::back_inserter(all.scenes));
    std::ranges::move(part.films, std::back_inserter(all.films));
    std::ranges::move(part.missing, std::back_inserter(all.missing));
    for (Section& section : part.in_company) {
      section.group = part.group;
      all.report.sections.push_back(std::move(section));
    }
    all.report.footer = part.report.footer;
    all.report.date = std::max(all.report.date, part.report.date);
  }
  check(all.report);
  return all;
}

namespace {

/// @return The report, with the sections that it has in a joint one.
FolderReport read_report(const fs::path& folder, const std::optional<std::string>& command,
                         const std::string& fallback) {
  refuse_links_out(folder);
  if (!is_study(folder)) {
    const std::vector<fs::path> studies = study_folders(folder);
    if (!studies.empty()) {
      std::vector<FolderReport> parts;
      for (const fs::path& study : studies) parts.push_back(read_report(study, command, fallback));
      return joined_report(folder, std::move(parts));
    }
  }
  std::string made_by = command.value_or("");
  if (made_by.empty()) {
    const std::vector<Session> sessions = read_sessions(folder);
    made_by = sessions.empty() ? fallback : sessions.back().command;
  }
  FolderReport report = outputs_of_study(folder).report(folder, made_by);
  report.is_of_studies = true;
  return report;
}

}  // namespace

FolderReport read_folder_report(const fs::path& folder, const std::optional<std::string>& command,
                                const std::string& fallback) {
  FolderReport report = read_report(folder, command, fallback);
  report.in_company = {};  // It stands alone.
  return report;
}

void add_images(const StudyFigures& figures, FolderReport& report) {
  for (const Figure* figure : all_figures(figures)) report.figures.push_back(*figure);
  for (const Scene* scene : all_scenes(figures)) report.scenes.push_back(*scene);
  for (const Film* film : all_films(figures)) report.films.push_back(*film);
}

Images images_of(const FolderReport& report) {
  Images images;
  for (const Figure& figure : report.figures) images.figures.push_back(&figure);
  for (const Scene& scene : report.scenes) images.scenes.push_back(&scene);
  return images;
}

std::size_t Drawn::svg_bytes(const std::string& id) const {
  if (const auto scene = scene_svg.find(id); scene != scene_svg.end()) return scene->second.size();
  const auto figure = figure_bytes.find(id);
  return figure == figure_bytes.end() ? std::size_t{0} : figure->second;
}

std::string Drawn::svg(const std::string& id, const fs::path& figures) const {
  if (const auto scene = scene_svg.find(id); scene != scene_svg.end()) return scene->second;
  return figure_bytes.contains(id) ? read_file(figures / (id + ".svg")) : std::string();
}

Drawn write_images(const Images& images, const DrawingJob& job, SceneClient& client) {
  Drawn drawn;
  const std::size_t total = images.figures.size() + images.scenes.size();
  std::mutex mutex;
  std::size_t done = 0;
  const auto count_one = [&] {
    const std::lock_guard lock(mutex);
    ++done;
    if (job.progress) job.progress(done, total);
  };
  for (const Figure* figure : images.figures) drawn.figure_bytes[figure->id];  // None in parallel.
  const auto draw_figures = [&] {
    parallel_for(images.figures.size(), [&](std::size_t i) {
      const Figure& figure = *images.figures[i];
      drawn.figure_bytes.at(figure.id) =
          write_figure(figure, job.theme, job.folder, job.formats).size();
      count_one();
    });
  };
  const auto draw_scenes = [&] {
    try {
      for (const Scene* scene : images.scenes) {
        drawn.scene_svg[scene->id] = write_scene(*scene, job.theme, job.folder, client, job.formats,
                                                 job.dark ? &*job.dark : nullptr);
        count_one();
      }
    } catch (const SceneError& error) {
      drawn.scene_error = error.what();
    }
    drawn.renderer = client.renderer();
  };
  parallel_for(job.jobs, 2, [&](std::size_t i) { i == 0 ? draw_scenes() : draw_figures(); });
  return drawn;
}

namespace {

/// A page that is larger with its data holds fewer drawings, but not less than these.
constexpr std::size_t kMostPage = 8'000'000, kLeastDrawings = 2'600'000;

std::size_t bytes_of_drawings(const std::set<std::string>& ids, const DrawingSize& bytes_of) {
  std::size_t bytes = 0;
  for (const std::string& id : ids) bytes += bytes_of(id);
  return bytes;
}

/// Reduces what the first page may hold of drawings, and then of tables, until it is small enough
/// with its data.
/// @param rest_bytes  What it takes beside drawings and the data of figures.
void fit_drawings(const Report& report, const DrawingSize& bytes_of, std::size_t rest_bytes,
                  FigureData& figures, PageLimits& limits) {
  // A figure that goes takes its data along, for which others may come.
  constexpr std::size_t kStep = 100'000;
  while (limits.drawing_bytes > kLeastDrawings) {
    const std::set<std::string> shown =
        figures_of_first_page(report, bytes_of, limits.drawing_bytes);
    const std::size_t bytes =
        rest_bytes + bytes_of_drawings(shown, bytes_of) + figures.bytes(shown);
    if (bytes <= kMostPage) break;
    limits.drawing_bytes =
        std::max(kLeastDrawings,
                 limits.drawing_bytes - std::min(limits.drawing_bytes, bytes - kMostPage + kStep));
  }
  const std::size_t least = rest_bytes + limits.drawing_bytes;
  if (least > kMostPage) limits.table_bytes -= std::min(limits.table_bytes, least - kMostPage);
}

}  // namespace

fs::path write_report(const FolderReport& report, const ReportOutputs& outputs,
                      const FolderLock& /*of_folder*/) {
  const OutputFolder folder(report.folder);
  SceneClient client;
  const Drawn drawn = write_images(images_of(report),
                                   {.folder = folder / "figures",
                                    .theme = report_theme(),
                                    .dark = dark_theme(),
                                    .jobs = outputs.jobs,
                                    .progress = outputs.progress},
                                   client);
  Report shown = report.report;
  if (shown.footer.empty())
    shown.footer = fmt::format("Made by mapproof {} ({}).", version(), source_commit());
  if (shown.date.empty())  // Records that do not say when they were made: the page does of itself.
    shown.date = today_utc();
  if (!drawn.renderer.empty()) add_renderer(shown, drawn.renderer);
  if (report.is_of_studies)
    shown.figure_command = figure_command(report.folder, outputs.disclosure);
  write_tables(shown, folder / "tables");
  const auto bytes_of = [&](const std::string& id) { return drawn.svg_bytes(id); };
  const auto drawing = [&](const std::string& id) {
    return drawn.svg(id, report.folder / "figures");
  };
  PageLimits limits;
  std::vector<Report> pages = pages_of(shown, bytes_of, limits);
  const HtmlOptions options{.link_words = report.link_words};
  const auto page = [&](std::size_t number) {
    return outputs.disclosure.text(report_html(pages[number - 1], outputs.page, drawing,
                                               page_options(number, pages.size(), options)));
  };
  std::string html = page(1);
  PageData records = page_records(report.folder, outputs.disclosure);
  std::size_t rest = html.size();
  for (const PageFile& file : records.files) rest += packed_bytes(file.text);
  const auto shown_figures = [&] {
    return figures_of_first_page(shown, bytes_of, limits.drawing_bytes);
  };
  rest -= std::min(rest, bytes_of_drawings(shown_figures(), bytes_of));
  const Images images = images_of(report);
  FigureData figures(images, outputs.disclosure);
  const PageLimits most = limits;
  fit_drawings(shown, bytes_of, rest, figures, limits);
  if (limits.drawing_bytes < most.drawing_bytes || limits.table_bytes < most.table_bytes) {
    pages = pages_of(shown, bytes_of, limits);
    html = page(1);
  }
  PageContent content = std::move(figures).content(std::move(records), shown_figures());
  content.tables_left = large_tables(report.folder);
  write_further_pages(folder, pages.size(), page);
  folder.write(kReportFile, with_page_data(std::move(html), content.data));
  if (const std::string left = left_out_text(content); outputs.note && !left.empty())
    outputs.note(left);
  if (!drawn.scene_error.empty()) throw SceneError(drawn.scene_error);
  return report.folder / kReportFile;
}

FolderReport slam_folder_report(const fs::path& folder, const SlamStudy& study,
                                const SlamTimings& timings, std::span<const Session> sessions,
                                const std::string& command) {
  const StudyFigures figures = slam_figures(study, timings);
  const SlamReportInput input{.study = study,
                              .sessions = sessions,
                              .timings = timings,
                              .figures = figures,
                              .command = command};
  FolderReport result{.folder = folder,
                      .report = slam_report(input),
                      .group = "Range-only SLAM",
                      .runs = study.runs.size(),
                      .missing = missing_logs(study)};
  result.in_company = result.report.sections;
  add_images(figures, result);
  return result;
}

}  // namespace mapproof
