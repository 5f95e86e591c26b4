#include "core/records/observations/input_kind.hpp"

#include <string_view>

#include "core/base/files/input_file.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"

namespace mapproof {

bool is_json(ByteSource& source) {
  if (unpacked_name(source.path()).extension() == ".json") return true;
  const std::string_view start = source.peek();
  const std::size_t first = start.find_first_not_of("\xEF\xBB\xBF \t\r\n");
  return first != std::string_view::npos && start[first] == '{';
}

std::string json_schema(ByteSource& source) {
  std::string name = schema_name_in(source.peek());
  if (name.empty() && source.holds_more_than(ByteSource::kPeek))
    name = schema_name_in(source.peek(ByteSource::kLargest));
  return name;
}

}  // namespace mapproof
