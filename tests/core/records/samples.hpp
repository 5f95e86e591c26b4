#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "core/records/studies/study_store.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {

/// A file below tests/data.
std::filesystem::path data_file(std::string_view name);

/// What the IoError says that `action` throws; "no error" if it throws none.
std::string error_of(const std::function<void()>& action);

/// Every file below a folder with its bytes, in the order of their names; timings.jsonl left out.
std::string contents(const std::filesystem::path& folder);

/// The experiment of tests/data/experiments/small.json: 2 layouts x 2 poses.
Experiment small_experiment();

Provenance made_up_provenance(const std::string& solver_digest = "0123abcd");

/// A run whose numbers are made up from its id: two records, one of them failed, and one map.
RunDetails made_up_details(const RunId& id);
RunResult made_up_result(const RunId& id);

Session made_up_session();

}  // namespace mapproof::test
