#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "reports/tables/write_tables.hpp"
#include "tests/reports/diff/value_cases.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

Table made_up_table(const std::string& id) {
  Table table{id, "How it came out", {}, {}, {"A note."}};
  table.columns = {{"Method", "", "", ""}, {"MPE", "m", "", ""}, {"Runs", "", "", ""}};
  table.rows = {{{TextCell{"LPCA"}, NumberCell{0.2361, 3}, NumberCell{8, 0}}, "", false},
                {{TextCell{"ISOMAP"}, NumberCell{0.1284, 3}, NumberCell{8, 0}}, "", true}};
  return table;
}

const std::string kPage =
    "<!DOCTYPE html><html><style>p {}</style><body><p>ISOMAP is best: 0.128 m.</p>"
    "<figure id=\"figure-map-isomap\"><svg><path d=\"M0 0\"/></svg></figure>"
    "<table aria-labelledby=\"caption-accuracy\"><td>0.128</td></table>"
    "<section id=\"section-provenance\"><p>Made 2026-01-01.</p></section></body></html>\n";

struct Replacement {
  std::string from = {};
  std::string to = {};
};

ValueCase edit(const std::string& file, const std::string& id, const Replacement& replacement,
               Verdict verdict, std::vector<std::string> cause) {
  const auto& [from, to] = replacement;
  return {.name = file + ": " + from + " -> " + to,
          .id = id,
          .verdict = verdict,
          .cause = std::move(cause),
          .passes = verdict <= Verdict::kWithinTolerance,
          .change =
              [=, from = from, to = to](const fs::path& folder) {
                std::string text = read_file(folder / file);
                const std::size_t at = text.find(from);
                if (at == std::string::npos) throw std::out_of_range(from);
                write_file(folder / file, text.replace(at, from.size(), to));
              },
          .alone = true};
}

const std::string kMark =
    "<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M1 1L5 5\"/></svg>\n";

/// As UTF-16 with its mark, little or big end first; ASCII alone.
std::string utf16(const std::string& text, bool big) {
  std::string bytes = big ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : text) bytes += big ? std::string{'\0', c} : std::string{c, '\0'};
  return bytes;
}

/// A drawing of others whose bytes are UTF-16.
void add_utf16(std::vector<ValueCase>& cases) {
  const std::string other = std::string(kMark).replace(kMark.find("5 5"), 3, "9 5");
  const auto add = [&](const std::string& name, const std::string& bytes, Verdict verdict,
                       std::vector<std::string> cause) {
    cases.push_back(
        {.name = name,
         .id = "mark",
         .verdict = verdict,
         .cause = std::move(cause),
         .passes = verdict == Verdict::kIdentical,
         .change = [=](const fs::path& folder) { write_file(folder / "mark.svg", bytes); },
         .alone = true});
  };
  for (const bool big : {false, true}) {
    add("SVG in UTF-16", utf16(kMark, big), Verdict::kIdentical, {});
    add("another SVG in UTF-16", utf16(other, big), Verdict::kChanged,
        {"svg, by its elements alone: 1 change, the first"});
    add("SVG in half of UTF-16", utf16(kMark, big).substr(0, 81), Verdict::kUnreadable,
        {"is UTF-16"});
  }
}

void add_files(std::vector<ValueCase>& cases) {
  for (const auto& [path, id] : {std::pair{"tables/accuracy.csv", "tables/accuracy"},
                                 {"tables/accuracy.md", "tables/accuracy"},
                                 {"tables/accuracy.tex", "tables/accuracy"},
                                 {"report.html", "report.html"},
                                 {"plan.pdf", "plan"}}) {
    const std::string file = path;
    const auto add = [&, id = id](const char* what, Verdict verdict, const auto& change) {
      cases.push_back({.name = file + " " + what,
                       .id = id,
                       .verdict = verdict,
                       .cause = {},
                       .passes = false,
                       .change = [=](const fs::path& folder) { change(folder / file); },
                       .alone = true});
    };
    add("deleted", Verdict::kMissing, [](const fs::path& copy) { fs::remove(copy); });
    add("emptied", Verdict::kUnreadable, [](const fs::path& copy) { fs::resize_file(copy, 0); });
    // Every beginning of a CSV is one, and of Markdown nearly every one.
    if (!file.ends_with(".csv") && !file.ends_with(".md"))
      add("truncated", Verdict::kUnreadable,
          [](const fs::path& copy) { fs::resize_file(copy, fs::file_size(copy) / 2); });
  }
}

}  // namespace

void write_base_documents(const fs::path& folder) {
  Report report;
  report.sections = {{"accuracy", "Accuracy", {made_up_table("accuracy")}},
                     {"cost", "Cost", {made_up_table("durations")}}};
  write_tables(report, folder / "tables");
  write_file(folder / "report.html", kPage);
  write_file(folder / "mark.svg", kMark);
  write_file(folder / "plan.pdf",
             "%PDF-1.4\n1 0 obj <</Type /Catalog /Pages 2 0 R>> endobj\n"
             "2 0 obj <</Type /Pages /Kids [3 0 R] /Count 1>> endobj\n"
             "3 0 obj <</Type /Page /Parent 2 0 R /MediaBox [0 0 72 72] /Contents 4 0 R>> endobj\n"
             "4 0 obj <</Length 16>> stream\n10 10 20 20 re f\nendstream endobj\n"
             "trailer <</Root 1 0 R /Info <</Producer (cairo 1.16.0 (x))>>>>\n%%EOF\n");
}

std::vector<ValueCase> document_cases() {
  const std::string csv = "tables/accuracy.csv", md = "tables/accuracy.md";
  const std::string tex = "tables/accuracy.tex", id = "tables/accuracy", page = "report.html";
  using enum Verdict;
  std::vector<ValueCase> cases = {
      edit(csv, id, {"0.1284", "0.1294"}, kChanged,
           {"row 3 (ISOMAP), MPE [m]: 0.1284 \u2192 0.1294", "its records did not change"}),
      edit(csv, id, {"0.1284", "0.12840000001"}, kWithinTolerance, {"1 cell differs within"}),
      edit(csv, id, {"ISOMAP", "LLE"}, kChanged, {"row 3, Method: ISOMAP"}),
      edit(csv, id, {"MPE", "Error"}, kStyle, {"row 1, MPE [m]"}),
      edit(csv, id, {"LPCA,0.2361,8\r\n", ""}, kChanged, {"3 rows \u2192 2 rows"}),
      edit(md, id, {"0.128", "0.129"}, kChanged, {"accuracy.md, row", "MPE"}),
      edit(md, id, {"How it came out", "Outcome"}, kStyle, {"How it came out"}),
      edit(tex, id, {"0.128", "0.129"}, kChanged, {"accuracy.tex, row", "cell 2"}),
      edit(tex, id, {"\\caption{How", "\\caption{Why"}, kStyle, {"accuracy.tex"}),
      edit("tables/durations.csv", "tables/durations", {"0.1284", "9"}, kWithinTolerance, {"vary"}),
      edit("tables/durations.md", "tables/durations", {"0.128", "9"}, kWithinTolerance, {"vary"}),
      edit("tables/durations.csv", "tables/durations", {"MPE", "Error"}, kStyle, {"row 1"}),
      edit(page, page, {"best: 0.128", "best: 0.129"}, kChanged,
           {"ISOMAP is best: 0.128 m. \u2192 ISOMAP is best: 0.129 m."}),
      edit(page, page, {"best", "worst"}, kStyle, {"the text differs", "ISOMAP is worst"}),
      edit(page, page, {"p {}", "p { color: red }"}, kStyle, {"its text is equal"}),
      edit(page, page, {"M0 0", "M9 9"}, kStyle, {"its text is equal"}),
      edit(page, page, {"2026-01-01", "2027-02-03"}, kWithinTolerance, {"provenance"}),
      edit("plan.pdf", "plan", {"10 10 20", "40 10 20"}, kChanged, {"pdf, by its pixels alone"}),
      edit("plan.pdf", "plan", {"1.16.0", "1.18.0"}, Verdict::kIdentical, {})};
  add_files(cases);
  add_utf16(cases);
  return cases;
}

}  // namespace mapproof::test
