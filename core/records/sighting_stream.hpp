#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/model/sighting_log.hpp"
#include "core/records/growing_table.hpp"
#include "core/records/sighting_rows.hpp"

namespace mapproof {

/// All that one look of a growing file showed.
struct StreamedLook {
  LookKey look;
  std::vector<Sighting> sightings;  ///< Ascending by landmark; their step is 0.
};

/// Gathers the rows of a long table of sightings (see read_sightings) into looks as they come. A
/// look is complete once a later row of the same robot is there. A robot's looks come in ascending
/// order.
class LookGatherer {
 public:
  /// @param source  What to call the table in errors; must outlive the object.
  LookGatherer(const std::string& source, const SightingFormat& format)
      : source_(source), rows_(source, format) {}

  /// @param row  The first one may be a header. @throws IoError with the line, as read_sightings;
  ///             or for a look that is not ascending.
  void take(const TableRow& row);

  /// There will be no more: the last looks are complete.
  void end();

  /// The looks that became complete since the last call, in order of each robot.
  std::vector<StreamedLook> looks() { return std::exchange(complete_, {}); }

  const SightingRows& rows() const { return rows_; }

 private:
  void open(const LookKey& look, const TableRow& row);
  void close(StreamedLook& look);

  const std::string& source_;
  SightingRows rows_;
  bool begun_ = false;              ///< The first row was read.
  std::vector<StreamedLook> open_;  ///< The last look of each robot.
  std::vector<StreamedLook> complete_;
  std::size_t looks_ = 0;
  std::size_t sightings_ = 0;
};

/// Reads a long table of sightings as it grows: see GrowingTable and LookGatherer.
class SightingStream {
 public:
  /// @param source  What to call the file in errors.
  SightingStream(std::string source, const SightingFormat& format)
      : table_(std::move(source)), gatherer_(table_.source(), format) {}
  SightingStream(const SightingStream&) = delete;
  SightingStream& operator=(const SightingStream&) = delete;

  /// @throws IoError with the line.
  void take(std::string_view bytes) {
    table_.take(bytes, [this](const TableRow& row) { gatherer_.take(row); });
  }

  /// Forgets a line whose end has not come, as of a file that is still written to.
  void drop_half_line() { table_.drop_half_line(); }

  /// There will be no more: the last line needs no end. @throws IoError as take().
  void end() {
    table_.end([this](const TableRow& row) { gatherer_.take(row); });
    gatherer_.end();
  }

  std::vector<StreamedLook> looks() { return gatherer_.looks(); }

  /// What has to be said after end(), a sentence each.
  std::vector<std::string> remarks() const;

  bool is_timed() const { return gatherer_.rows().looks().is_timed(); }
  /// Of all landmarks so far, in the order in which they came.
  const std::vector<std::string>& names() const { return gatherer_.rows().names().names(); }

 private:
  GrowingTable table_;
  LookGatherer gatherer_;
};

}  // namespace mapproof
