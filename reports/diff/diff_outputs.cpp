#include "reports/diff/diff_outputs.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/json/record_writer.hpp"
#include "reports/diff/diff_fields.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostRows = 50;
constexpr std::size_t kLongest = 2000;  // Characters of a cause.

/// A text as XML on one line.
std::string xml(const std::string& text) {
  std::string out = html_escaped(text);
  std::ranges::replace_if(
      out, [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return out;
}

/// Makes a text fit for a cell of a Markdown table on a page that accepts HTML.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : xml(printable(text, kLongest))) {
    if (std::string_view("|\\`*_[]#~@").find(c) != std::string_view::npos)
      out += fmt::format("&#{};", static_cast<int>(c));
    else
      out += c;
  }
  return out;
}

std::string counts_text(const DiffResult& result) {
  const std::vector<int> counts = counts_of(result);
  std::string text;
  for (std::size_t v = kVerdicts.size(); v-- > 0;)
    if (counts[v] > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[v], label(kVerdicts[v]));
  return text;
}

int failures_of(const DiffResult& result, bool unreadable) {
  int count = 0;
  for (const DiffItem& item : result.items)
    count += !item.passes && (item.judgement.verdict == Verdict::kUnreadable) == unreadable;
  return count;
}

}  // namespace

std::string diff_text(const DiffResult& result, DiffWords words) {
  if (words == DiffWords::kFailures && result.passes) return "";
  std::string text;
  for (const DiffItem& item : result.items) {
    const Judgement& reported = item.judgement;
    if (reported.verdict == Verdict::kIdentical || (words == DiffWords::kFailures && item.passes))
      continue;
    // A cause that refers to records begins with the id itself.
    const std::string head = reported.cause.starts_with(item.id + " ") ? "" : item.id + ": ";
    text += fmt::format("{:<22}  {}\n", label(reported.verdict),
                        printable(head + reported.cause, kLongest));
  }
  for (const std::string& remark : result.remarks) text += printable(remark, kLongest) + "\n";
  return text +
         fmt::format("{}: {}\n", result.passes ? "passes" : "does not pass", counts_text(result));
}

std::string diff_junit(const DiffResult& result) {
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
    out += fmt::format("      <system-out>{}: {}</system-out>\n    </testcase>\n",
                       label(reported.verdict), message);
  }
  if (!result.remarks.empty()) {
    out += "    <system-out>";
    for (const std::string& remark : result.remarks) out += xml(printable(remark, kLongest)) + "\n";
    out += "</system-out>\n";
  }
  return out + "  </testsuite>\n</testsuites>\n";
}

std::string diff_markdown(const DiffResult& result) {
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
  return out;
}

std::string ctest_lines(const DiffResult& result) {
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
           {std::pair("baseline", image.baseline), std::pair("current", image.current)})
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
