#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/base/files/byte_source.hpp"
#include "core/model/range_log.hpp"
#include "core/records/observations/landmarks_csv.hpp"

namespace mapproof {

/// A table of numbers out of some file, with what is needed to report the location of a wrong one.
struct NumberTable {
  std::string source;                   ///< The file.
  std::string row_word = "line";        ///< What `rows` counts: "line", "variable GT, row".
  std::vector<std::size_t> rows = {};   ///< n, from 1.
  std::vector<std::string> names = {};  ///< n, of landmarks; or empty.
  Eigen::MatrixXd values = {};          ///< n x k, finite.
  std::size_t left_out = 0;             ///< Rows that were, since their range is missing.
  /// Role and header of each column: {"distance", "Weg [m]"}; empty without a header.
  std::vector<std::pair<std::string, std::string>> columns = {};
  char separator = '\0';  ///< Of the cells; 0: not known.

  /// Takes `values` row by row, as many rows as `rows`.
  void set_values(const std::vector<double>& by_row, Eigen::Index width);

  std::string location(Eigen::Index row) const;
  /// @throws IoError at that row.
  [[noreturn]] void fail(Eigen::Index row, const std::string& what) const;
};

/// Lines of `width` numbers each. @throws IoError with the line.
NumberTable read_number_table(ByteSource& source, std::size_t width);

/// A measurement whose landmark has no row yet.
struct NamedMeasurement {
  double time_s;
  std::string landmark;
  double range_m;
  double sigma_m = 0.0;  ///< Standard deviation; 0: not given.
};

/// The columns of a table as values. All throw IoError at the row that breaks a bound: times within
/// 1e12 s and, but for measurements, ascending; coordinates within 1e9 m; ranges from 0 to 1e6 m.
///
/// @param table  Columns time, x, y and perhaps heading.
Trajectory trajectory_in(const NumberTable& table);
/// @param table  Columns time, distance, heading change and perhaps the sideways distance.
std::vector<Motion> motions_in(const NumberTable& table);
/// @param table  Columns time, range; with names.
std::vector<NamedMeasurement> measurements_in(const NumberTable& table);
/// @param table  Columns x, y; with names, all different.
NamedPoints landmarks_in(const NumberTable& table);

/// Those columns of a table, and the integers in column `names` as the names of landmarks.
/// @throws IoError at a row whose landmark is not an integer within 1e9.
NumberTable selected(const NumberTable& table, const std::vector<Eigen::Index>& columns,
                     Eigen::Index names);

/// @throws IoError if that column holds two different numbers: one robot alone can be mapped.
void check_one_sender(const NumberTable& table, Eigen::Index column);

}  // namespace mapproof
