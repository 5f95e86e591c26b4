#include "core/records/observations/mat_tables.hpp"

#include <matio.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"
#include "core/records/limits.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kHeaderBytes = 128;
constexpr std::size_t kTagBytes = 8;
constexpr std::size_t kMostColumns = 16;
constexpr std::size_t kMostVariables = 1000;

std::uint32_t word_at(const std::string& bytes, std::size_t at, bool is_swapped) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return is_swapped ? __builtin_bswap32(word) : word;
}

/// Whether the file's byte order is not this processor's. @throws IoError if it is no such file.
bool check_header(const std::string& bytes, const std::string& source) {
  if (bytes.size() < kHeaderBytes || !bytes.starts_with("MATLAB"))
    throw IoError(source, "is not a MATLAB file");
  std::uint16_t mark = 0;
  std::uint16_t version = 0;
  std::memcpy(&version, bytes.data() + 124, sizeof version);
  std::memcpy(&mark, bytes.data() + 126, sizeof mark);
  constexpr std::uint16_t kMark = 0x4D49;
  const bool is_swapped = mark == 0x494D;
  if (!is_swapped && mark != kMark)
    throw IoError(source, "is not a MATLAB file: no byte order mark");
  if (is_swapped) version = __builtin_bswap16(version);
  if (version != 0x0100)
    throw IoError(source, "is not of MATLAB 5 to 7.2: save it with -v7 or older");
  return is_swapped;
}

/// Follows the elements from tag to tag. @return How many there are.
/// @throws IoError unless they are variables that fill the file.
std::size_t count_variables(const std::string& bytes, bool is_swapped, const std::string& source) {
  constexpr std::uint32_t kMatrix = 14;
  constexpr std::uint32_t kCompressed = 15;
  std::size_t count = 0;
  for (std::size_t at = kHeaderBytes; at < bytes.size(); ++count) {
    const std::string place = fmt::format("variable {}", count + 1);
    if (count == kMostVariables)
      throw IoError(source, fmt::format("more than {} variables", kMostVariables));
    if (bytes.size() - at < kTagBytes) throw IoError(source, place, "is cut off");
    const std::uint32_t type = word_at(bytes, at, is_swapped);
    const std::size_t size = word_at(bytes, at + 4, is_swapped);
    if (type != kMatrix && type != kCompressed)
      throw IoError(source, place, fmt::format("is damaged: element of type {}", type));
    at += kTagBytes;
    if (size > bytes.size() - at) throw IoError(source, place, "is cut off");
    at += size;
  }
  return count;
}

struct CloseFile {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatFile = std::unique_ptr<mat_t, CloseFile>;
using MatVariable = std::unique_ptr<matvar_t, FreeVariable>;

bool is_table(const matvar_t& variable) {
  return variable.class_type == MAT_C_DOUBLE && variable.rank == 2 && variable.isComplex == 0 &&
         variable.dims != nullptr;
}

NumberTable read_table(mat_t* file, matvar_t* variable, const std::string& source) {
  const std::string name = "variable " + printable(variable->name);
  const std::size_t rows = variable->dims[0];
  const std::size_t columns = variable->dims[1];
  if (rows > kMostSteps || columns > kMostColumns)
    throw IoError(
        source, name,
        fmt::format("{} x {} numbers; at most {} x {}", rows, columns, kMostSteps, kMostColumns));
  NumberTable table{
      .source = source, .row_word = name + ", row", .rows = std::vector<std::size_t>(rows)};
  std::iota(table.rows.begin(), table.rows.end(), std::size_t{1});
  table.values.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  if (table.values.size() == 0) return table;
  // Where a damaged file gives fewer numbers than it says, matio leaves the rest as it was.
  table.values.setConstant(std::numeric_limits<double>::quiet_NaN());
  std::array<int, 2> start = {0, 0};
  std::array<int, 2> stride = {1, 1};
  std::array<int, 2> count = {static_cast<int>(rows), static_cast<int>(columns)};
  if (Mat_VarReadData(file, variable, table.values.data(), start.data(), stride.data(),
                      count.data()) != 0)
    throw IoError(source, name, "is damaged");
  for (Eigen::Index row = 0; row < table.values.rows(); ++row)
    if (!table.values.row(row).allFinite()) table.fail(row, "a number is not finite");
  return table;
}

}  // namespace

std::map<std::string, NumberTable> read_mat_tables(ByteSource& input) {
  const std::string& source = input.name();
  const std::string bytes = input.rest();
  const bool is_swapped = check_header(bytes, source);
  const std::size_t count = count_variables(bytes, is_swapped, source);
  // matio seeks, and opens by a name: it gets the very bytes that were checked.
  const Descriptor seekable = anonymous_file(bytes, source);
  const MatFile file(Mat_Open(path_of(seekable).c_str(), MAT_ACC_RDONLY));
  if (!file) throw IoError(source, "is not a MATLAB file");

  // All heads first: reading numbers moves the place from which matio reads the next head.
  std::vector<MatVariable> variables;
  for (std::size_t i = 0; i < count; ++i) {
    variables.emplace_back(Mat_VarReadNextInfo(file.get()));
    if (!variables.back()) throw IoError(source, fmt::format("variable {}", i + 1), "is damaged");
  }
  std::map<std::string, NumberTable> tables;
  for (const MatVariable& variable : variables) {
    if (variable->name == nullptr || !is_table(*variable)) continue;
    if (!tables.emplace(variable->name, read_table(file.get(), variable.get(), source)).second)
      throw IoError(source, "variable " + printable(variable->name), "is there twice");
  }
  return tables;
}

}  // namespace mapproof
