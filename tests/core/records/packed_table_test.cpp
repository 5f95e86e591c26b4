#include "core/records/tables/packed_table.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

using Rows = std::vector<std::vector<double>>;

PackedTable packed(const Rows& rows, std::size_t in_memory = PackedTable::kInMemory) {
  PackedTable table(rows.front().size(), in_memory);
  for (const std::vector<double>& row : rows) table.add_row(row);
  table.end();
  return table;
}

bool are_same_bits(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return true;
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Compares every number, in an order other than that of the rows.
void expect_kept(const Rows& rows, const PackedTable& table) {
  const std::size_t height = rows.size(), width = rows.front().size();
  ASSERT_EQ(table.rows(), height);
  std::vector<double> out(height * width);
  table.read({0, height, 1}, {0, width, 1}, out.data(), 1, height);
  for (std::size_t i = 0; i < height; ++i)
    for (std::size_t k = 0; k < width; ++k)
      ASSERT_TRUE(are_same_bits(out[k * height + i], rows[i][k])) << i << ", " << k;
}

/// Numbers as a file of so many decimals has them.
Rows decimals(std::size_t height, std::size_t width, int digits, double size) {
  std::mt19937 random(7);
  const double power = std::pow(10.0, digits);
  Rows rows(height, std::vector<double>(width));
  for (std::vector<double>& row : rows)
    for (double& number : row)
      number = std::strtod(
          std::to_string(std::uniform_real_distribution<double>(-size, size)(random)).c_str(),
          nullptr);
  for (std::vector<double>& row : rows)
    for (double& number : row) number = std::round(number * power) / power;
  return rows;
}

TEST(PackedTable, KeepsEveryBitOfNumbersOfAFile) {
  Rows special = decimals(40, 9, 4, 3.2);
  special[3][2] = kNaN;
  special[4][2] = -0.0;
  special[5][0] = 1.5e18;
  Rows exact = decimals(30, 7, 3, 3.0);
  for (std::vector<double>& row : exact)
    for (double& number : row) number *= M_PI;
  const Rows all[] = {decimals(3, 5000, 4, 3.2),
                      decimals(5000, 3, 5, 3.2),
                      decimals(10, 10, 0, 1.0),
                      decimals(10, 10, 6, 400.0),
                      special,
                      exact};
  for (const Rows& rows : all) expect_kept(rows, packed(rows));
}

TEST(PackedTable, TakesThreeBytesForABearingOfSixDecimals) {
  const Rows rows = decimals(3000, 50, 6, 3.14159);
  EXPECT_LT(packed(rows).bytes(), 3000 * 50 * 3 + 60'000);
}

TEST(PackedTable, ReadsRowsAndColumnsThatAreApart) {
  const Rows shapes[] = {decimals(2500, 60, 4, 3.2), decimals(7, 4000, 4, 3.2)};
  for (const Rows& rows : shapes) {
    const PackedTable table = packed(rows);
    const std::size_t width = rows.front().size();
    const PackedTable::Range some{3, (rows.size() - 4) / 3 + 1, 3},
        others{1, (width - 2) / 13 + 1, 13};
    std::vector<double> out(some.count * others.count);
    table.read(some, others, out.data(), others.count, 1);
    for (std::size_t i = 0; i < some.count; ++i)
      for (std::size_t k = 0; k < others.count; ++k)
        ASSERT_EQ(out[i * others.count + k], rows[3 + 3 * i][1 + 13 * k]) << i << ", " << k;
  }
}

TEST(PackedTable, IsTheSameFromAFile) {
  const Rows rows = decimals(3000, 20, 4, 3.2);
  expect_kept(rows, packed(rows, 1000));
  ::setenv("TMPDIR", "/nowhere", 1);
  expect_kept(rows, packed(rows, 1000));
  ::unsetenv("TMPDIR");
}

}  // namespace
}  // namespace mapproof
