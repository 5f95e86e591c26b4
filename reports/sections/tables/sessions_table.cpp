#include "reports/sections/tables/sessions_table.hpp"

#include <utility>

namespace mapproof {

Table sessions_table(std::string id, std::span<const Session> sessions) {
  Table table;
  table.id = std::move(id);
  table.caption = "Starts of the program on this study";
  table.columns = {{"Started (UTC)", "", "", ""},
                   {"Command", "", "", ""},
                   {"Host", "", "", ""},
                   {"Jobs", "", "", ""},
                   {"Duration", "s", "", "Wall clock; the records alone, without figures."},
                   {"Peak memory", "MiB", "", "Of the process, until its records were made."}};
  for (const Session& session : sessions)
    table.rows.push_back(
        {{TextCell{session.started_utc, Emphasis::kData},
          TextCell{session.command, Emphasis::kCode}, TextCell{session.host, Emphasis::kData},
          NumberCell{static_cast<double>(session.jobs), 0}, NumberCell{session.seconds, 1},
          session.peak_memory_mib ? Cell{NumberCell{*session.peak_memory_mib, 0}}
                                  : Cell{MissingCell{}}},
         "",
         false});
  return table;
}

}  // namespace mapproof
