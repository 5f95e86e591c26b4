#include "reports/tables/write_tables.hpp"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"

namespace mapproof {
namespace {

Table sample() {
  Table table{"t",
              "A & B",
              {{"Name", "", "", ""}, {"MPE", "m", "", ""}, {"95 %", "m", "G", ""}},
              {},
              {"A note_1."}};
  table.rows.push_back(
      {{TextCell{"x, \"y\""}, NumberCell{0.1 + 0.2, 2}, IntervalCell{0, 1, 1}}, "", true});
  table.rows.push_back(
      {{TextCell{"plain"}, NumberCell{std::nan(""), 2}, MissingCell{}}, "", false});
  return table;
}

Table with_name(const std::string& name) {
  return {"t", "c", {{"Name", "", "", ""}}, {{{TextCell{name}}, "", false}}, {}};
}

TEST(CsvTable, KeepsEveryDigitAndQuotesAsRfc4180Asks) {
  EXPECT_EQ(table_csv(sample()),
            "Name,MPE [m],\"G: 95 % [m], low\",\"G: 95 % [m], high\"\r\n"
            "\"x, \"\"y\"\"\",0.30000000000000004,0,1\r\n"
            "plain,,,\r\n");
}

TEST(CsvTable, HasTheDigitsOfANumberForATitle) {
  Table table = with_name("a");
  table.columns.front() = {"10⁻⁶", "", "stops at", "", std::nullopt, 1e-6};
  EXPECT_EQ(table_csv(table), "stops at: 1e-06\r\na\r\n");
  EXPECT_TRUE(table_markdown(table).find("10⁻⁶") != std::string::npos);
}

TEST(CsvTable, KeepsALineBreakWithinItsField) {
  EXPECT_EQ(table_csv(with_name("a\nb")), "Name\r\n\"a\nb\"\r\n");
}

TEST(CsvTable, HoldsNothingThatASpreadsheetTakesForAFormula) {
  for (const char* name : {"=1+1", "+1", "-1", "@SUM(A1)", "\tx"}) {
    const std::string csv = table_csv(with_name(name));
    const std::size_t at = csv.find_first_not_of('"', csv.find("\r\n") + 2);
    EXPECT_EQ(csv[at], '\'') << csv;
  }
  EXPECT_EQ(table_csv(with_name("a=1")), "Name\r\na=1\r\n");
}

TEST(TableLines, AreTheWholeTableRowByRow) {
  for (const TableLines& lines : {csv_lines(sample()), latex_lines(sample())}) {
    ASSERT_EQ(lines.rows.size(), 2u);
    EXPECT_NE(lines.rows[1].find("plain"), std::string::npos);
  }
  EXPECT_EQ(joined(latex_lines(sample())), table_latex(sample()));
}

TEST(LatexTable, IsABooktabsTableWithGroupRulesAndBoldBest) {
  const std::string text = table_latex(sample());
  for (const char* part :
       {"\\begin{tabular}{lrr}", "\\toprule", "\\cmidrule(lr){3-3}", "\\midrule", "\\bottomrule",
        "\\caption{A \\& B}", "\\textbf{0.30}", "plain & -- & -- \\\\", "A note\\_1."})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(LatexTable, EscapesWhatTexReadsAsItsOwn) {
  const std::string text = table_latex(with_name("&%$#_{}~^\\\u03c3\u00b2\u2013"));
  EXPECT_NE(text.find("\\&\\%\\$\\#\\_\\{\\}\\textasciitilde{}\\textasciicircum{}"
                      "\\textbackslash{}$\\sigma^2$--"),
            std::string::npos)
      << text;
}

TEST(LatexTable, SetsGreekInMathMode) {
  EXPECT_NE(table_latex(with_name("\u03c3\u00b2 = 0.5")).find("$\\sigma^2$ = 0.5"),
            std::string::npos);
  EXPECT_NE(table_latex(with_name("\u03c7\u00b2")).find("$\\chi^2$"), std::string::npos);
}

TEST(LatexTable, CannotBeLeftByARowThatBeginsWithABracket) {
  EXPECT_NE(table_latex(with_name("[1ex]")).find("{[}1ex"), std::string::npos);
}

TEST(MarkdownTable, HasOneLineARowAndNothingThatIsReadAsMarkup) {
  const std::string text = table_markdown(with_name("a|b\n<script>*x*</script>[l](u)`c`"));
  EXPECT_NE(text.find("| a\\|b<br>&lt;script&gt;\\*x\\*&lt;/script&gt;\\[l\\]\\(u\\)\\`c\\` |"),
            std::string::npos)
      << text;
}

TEST(MarkdownTable, AlignsNumbersRight) {
  EXPECT_NE(table_markdown(sample()).find("| :--- | ---: | ---: |"), std::string::npos);
}

TEST(WriteTables, WritesThreeFilesATableNamedByItsId) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "tables";
  std::filesystem::remove_all(folder);
  const Report report{"t", "", {{"s", "S", {sample()}}}, ""};
  EXPECT_EQ(write_tables(report, folder), (std::vector<std::string>{"t.csv", "t.md", "t.tex"}));
  EXPECT_EQ(read_file(folder / "t.csv"), table_csv(sample()));
}

TEST(WriteTables, RefusesANameThatLeavesTheFolder) {
  Table table = sample();
  table.id = "../../x";
  EXPECT_THROW(write_tables({"t", "", {{"s", "S", {table}}}, ""}, ::testing::TempDir()),
               InvalidInput);
}

}  // namespace
}  // namespace mapproof
