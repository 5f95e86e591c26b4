#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/model/method.hpp"
#include "core/model/sensor.hpp"
#include "core/model/status.hpp"
#include "core/model/study.hpp"
#include "core/records/limits.hpp"

namespace mapproof {

/// The small values that several files hold, to and from JSON. Readers throw IoError.

Sensor read_sensor(const JsonCursor& value);

nlohmann::ordered_json run_id_value(const RunId& run);
RunId read_run_id(const JsonCursor& value);

/// The method that a key or a value names. @throws IoError at `place`, with "did you mean".
Method read_method(const std::string& name, const JsonCursor& place);

/// The value of a method's parameter, within the bounds of its ParameterInfo.
double read_parameter(const ParameterInfo& parameter, const JsonCursor& value);

/// Adds "method" and, if it has one, its parameter under its symbol: "K".
void put_setting(nlohmann::ordered_json& object, const MethodSetting& setting);
/// @param keys  The symbols that may stand in `object` are appended.
MethodSetting read_setting(const JsonCursor& object, std::vector<std::string_view>& keys);

/// A number that is an integer is written as one.
nlohmann::ordered_json number_value(double number);

nlohmann::ordered_json statuses_value(const std::vector<Status>& statuses);
std::vector<Status> read_statuses(const JsonCursor& value);

/// Whether a text is [a-z0-9-]+, which is safe in ids and names of files.
bool is_plain_id(std::string_view text);

/// A plain id that begins with a letter. @throws IoError.
std::string read_id(const JsonCursor& value);

/// A name of an experiment: letters, digits, '-' and '_', at most 64. @throws IoError.
std::string read_study_name(const JsonCursor& value);

/// Reads an object's optional key into a value that holds its default.
void read_if_there(const JsonCursor& object, const char* key, double least, double most,
                   double& value);
void read_if_there(const JsonCursor& object, const char* key, int least, int most, int& value);

/// Different, not empty names of at most kLongestName bytes.
std::vector<std::string> read_names(const JsonCursor& value);

}  // namespace mapproof
