#include "reports/diff/diff_outputs.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/percent.hpp"
#include "core/base/text/words.hpp"
#include "core/json/record_writer.hpp"
#include "reports/diff/diff_fields.hpp"
#include "reports/diff/records/difference_summary.hpp"
#include "reports/diff/shared_causes.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostRows = 50;
constexpr std::size_t kLongest = 2000;  // Characters of a cause.

std::string xml(const std::string& text) { return xml_line(text); }

std::string cell(const std::string& text) { return markdown_text(text, kLongest); }

/// Lines that name the images of an item that does not pass.
std::string attachments(const ImageLinks& links, const DiffItem& item) {
  std::string lines;
  if (item.passes) return lines;
  for (const ItemImages* images : links.of(item.id))
    for (const std::string& path : images->paths())
      lines += fmt::format("\n[[ATTACHMENT|{}]]", xml(links.joined(path)));
  return lines.empty() ? lines : lines + "\n";
}

/// A URL between the brackets of Markdown: what would end it, or begin something else, as %XX.
std::string markdown_url(std::string_view url) {
  return percent_encoded(url, [](char c) { return is_plain(c, "-._~:/?#@!$&'*+,;=%"); });
}

/// The file's name is encoded already (see write_item_images()); in a URL its '%' is "%25".
std::string url_of(const ImageLinks& links, const std::string& path) {
  return markdown_url(links.joined(percent_encoded(path, [](char c) { return c != '%'; })));
}

/// Whether pages show images of the format.
bool is_shown(std::string_view path) {
  constexpr std::array<std::string_view, 6> kShown = {".png", ".svg",  ".jpg",
                                                      ".gif", ".webp", ".jpeg"};
  return std::ranges::any_of(kShown, [&](std::string_view end) { return path.ends_with(end); });
}

/// A table with the images of one file, or why they cannot be read.
std::string image_table(const ItemImages& images, const ImageLinks& links) {
  if (!images.unreadable.empty())
    return fmt::format("Not shown, as it is unreadable: {}\n", cell(images.unreadable));
  std::string head, rule, row;
  for (const auto& [name, path] :
       {std::pair("baseline", &images.baseline), std::pair("current", &images.current),
        std::pair("difference", &images.difference)}) {
    if (path->empty()) continue;
    const std::string url = url_of(links, *path);
    head += fmt::format("| {} ", name);
    rule += "|---";
    row += is_shown(*path) ? fmt::format("| [![{}]({})]({}) ", name, url, url)
                           : fmt::format("| [{}]({}) ", name, url);
  }
  return fmt::format("{}|\n{}|\n{}|\n", head, rule, row);
}

/// The images of the first items that do not pass.
std::string image_sections(const DiffResult& result, const ImageLinks& links) {
  constexpr int kMostItems = 10;
  std::string out;
  int shown = 0;
  for (const DiffItem& item : result.items) {
    if (item.passes) continue;
    const std::vector<const ItemImages*> all = links.of(item.id);
    if (all.empty() || ++shown > kMostItems) continue;
    for (const ItemImages* images : all)
      out += fmt::format("\n#### {}, {}\n\n{}", cell(item.id), cell(images->format),
                         image_table(*images, links));
  }
  return out;
}

/// A text as GitHub reads it: in a property, or behind "::".
std::string github_text(std::string_view text, bool is_property) {
  const std::string_view escaped = is_property ? "%\r\n:," : "%\r\n";
  return percent_encoded(text, [&](char c) { return escaped.find(c) == std::string_view::npos; });
}

/// The file of an item below the baseline, as the current has it; empty for records.
std::string file_below(const DiffResult& result, const DiffItem& item) {
  const auto below = [](const std::filesystem::path& file, const std::string& folder) {
    const std::filesystem::path path = file.lexically_relative(folder);
    return path.empty() || *path.begin() == ".." ? std::string() : path.generic_string();
  };
  for (const ImageFile& image : item.images) {
    const std::string found = image.current.empty() ? below(image.baseline, result.baseline)
                                                    : below(image.current, result.current);
    return found.empty() || found == "." ? "" : found;
  }
  return "";
}

int failures_of(const DiffResult& result, bool unreadable) {
  int count = 0;
  for (const DiffItem& item : result.items)
    count += !item.passes && (item.judgement.verdict == Verdict::kUnreadable) == unreadable;
  return count;
}

/// The line of a cause that several items share.
std::string shared_text(const SharedCause& shared) {
  constexpr std::size_t kMostIds = 4;
  return fmt::format("{:<22}  {}: {}: {}\n", label(shared.verdict),
                     counted(static_cast<long long>(shared.ids.size()), "item"),
                     printable(shared.cause, kLongest),
                     printable(listed(shared.ids, kMostIds), kLongest));
}

/// Where many scores differ for one cause: how they differ, a line for each quantity.
std::string summary_text(const DiffResult& result) {
  std::string text;
  for (const DiffItem& item : result.items)
    if (item.records && !result.shared.empty())
      for (const QuantityDifferences& differences : difference_summary(*item.records))
        text += printable(differences_text(differences), kLongest) + "\n";
  return text;
}

/// The versions that differ; empty if none does.
std::string versions_text(const DiffResult& result) {
  constexpr std::size_t kMostVersions = 6;
  const std::string versions = listed(version_changes(result), kMostVersions);
  return versions.empty() ? "" : "Versions that differ:  " + printable(versions, kLongest) + "\n";
}

}  // namespace

std::string diff_text(const DiffResult& result, DiffWords words) {
  if (words == DiffWords::kFailures && result.passes) return "";
  std::string text;
  for (const DiffItem& item : result.items) {
    const Judgement& reported = item.judgement;
    if (reported.verdict == Verdict::kIdentical || (words == DiffWords::kFailures && item.passes))
      continue;
    if (const SharedCause* shared = shared_cause_of(result, item)) {
      if (shared->ids.front() == item.id) text += shared_text(*shared);
      continue;
    }
    // A cause that refers to records begins with the id itself.
    const std::string head = reported.cause.starts_with(item.id + " ") ? "" : item.id + ": ";
    text += fmt::format("{:<22}  {}\n", label(reported.verdict),
                        printable(head + reported.cause, kLongest));
  }
  text += summary_text(result);
  for (const std::string& remark : result.remarks) text += printable(remark, kLongest) + "\n";
  if (!text.empty()) text += versions_text(result);
  return text +
         fmt::format("{}: {}\n", result.passes ? "passes" : "does not pass", counts_text(result));
}

std::string diff_junit(const DiffResult& result, const ImageLinks& links) {
  const int failures = failures_of(result, false), errors = failures_of(result, true);
  const std::string totals = fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\"",
                                         result.items.size(), failures, errors);
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  out += fmt::format("<testsuites name=\"mapproof diff\" {} time=\"0\">\n", totals);
  out += fmt::format("  <testsuite name=\"mapproof diff\" {} skipped=\"0\" time=\"0\">\n", totals);
  for (const DiffItem& item : result.items) {
    const Judgement& reported = item.judgement;
    out += fmt::format("    <testcase name=\"{}\" classname=\"mapproof.{}\" time=\"0\"",
                       xml(item.id), name(item.kind));
    if (reported.verdict == Verdict::kIdentical) {
      out += "/>\n";
      continue;
    }
    const std::string message = xml(printable(reported.cause, kLongest));
    out += ">\n";
    if (!item.passes) {
      const char* element = reported.verdict == Verdict::kUnreadable ? "error" : "failure";
      out +=
          fmt::format("      <{} type=\"{}\" message=\"{}: {}\">{}</{}>\n", element,
                      name(reported.verdict), label(reported.verdict), message, message, element);
    }
    out += fmt::format("      <system-out>{}: {}{}</system-out>\n    </testcase>\n",
                       label(reported.verdict), message, attachments(links, item));
  }
  if (!result.remarks.empty()) {
    out += "    <system-out>";
    for (const std::string& remark : result.remarks) out += xml(printable(remark, kLongest)) + "\n";
    out += "</system-out>\n";
  }
  return out + "  </testsuite>\n</testsuites>\n";
}

std::string diff_markdown(const DiffResult& result, const ImageLinks& links) {
  std::string out = fmt::format("### mapproof diff: {}\n\n{}\n",
                                result.passes ? "passes" : "does not pass", counts_text(result));
  for (const std::string& remark : result.remarks) out += "\n" + cell(remark) + "\n";
  std::size_t rows = 0, left = 0;
  for (const DiffItem& item : result.items) {
    if (item.judgement.verdict == Verdict::kIdentical) continue;
    if (++rows > kMostRows) {
      ++left;
      continue;
    }
    if (rows == 1) out += "\n| | what | verdict | why |\n|---|---|---|---|\n";
    out += fmt::format("| {} | {} | {} | {} |\n", item.passes ? "passes" : "**fails**",
                       cell(item.id), label(item.judgement.verdict), cell(item.judgement.cause));
  }
  if (left > 0) out += fmt::format("\nand {} more.\n", left);
  return out + image_sections(result, links);
}

std::string github_lines(const DiffResult& result, const std::string& folder) {
  constexpr std::size_t kMostLines = 10;
  std::vector<const DiffItem*> failed;
  for (const DiffItem& item : result.items)
    if (!item.passes && (result.has_baseline || item.judgement.verdict == Verdict::kMissing))
      failed.push_back(&item);
  const std::size_t shown = failed.size() > kMostLines ? kMostLines - 1 : failed.size();
  std::string out;
  for (std::size_t i = 0; i < shown; ++i) {
    const DiffItem& item = *failed[i];
    const std::string below = file_below(result, item);
    const std::string file =
        below.empty() ? folder : (std::filesystem::path(folder) / below).generic_string();
    out +=
        fmt::format("::error file={},title={}::{}\n", github_text(printable(file, kLongest), true),
                    github_text(printable("mapproof: " + item.id, kLongest), true),
                    github_text(fmt::format("{}: {}", label(item.judgement.verdict),
                                            printable(item.judgement.cause, kLongest)),
                                false));
  }
  if (failed.size() > shown)
    out += fmt::format("::error title=mapproof::and {} more items do not pass\n",
                       failed.size() - shown);
  return out;
}

std::string ctest_lines(const DiffResult& result, bool keeps_baseline) {
  constexpr int kMostImages = 10;
  std::string out;
  const std::vector<int> counts = counts_of(result);
  for (std::size_t v = 0; v < kVerdicts.size(); ++v)
    out += fmt::format(
        "<CTestMeasurement type=\"numeric/integer\" name=\"{}\">{}</CTestMeasurement>\n",
        name(kVerdicts[v]), counts[v]);
  int shown = 0;
  for (const DiffItem& item : result.items) {
    if (item.passes) continue;
    for (const ImageFile& image : item.images) {
      if (image.format != "png" || shown >= 2 * kMostImages) continue;
      for (const auto& [side, path] :
           {std::pair("baseline", keeps_baseline ? image.baseline : std::filesystem::path()),
            std::pair("current", image.current)})
        if (!path.empty() && ++shown)
          out += fmt::format(
              "<CTestMeasurementFile type=\"image/png\" name=\"{} {}\">{}</CTestMeasurementFile>\n",
              xml(item.id), side, xml(std::filesystem::absolute(path).string()));
    }
  }
  return out;
}

nlohmann::ordered_json diff_json(const DiffResult& result) { return to_json_value(result); }

}  // namespace mapproof
