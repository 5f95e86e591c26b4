#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof::test {

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< Directly inside.
};

/// All elements in the order of their start tags. @throws std::runtime_error if `xml` is malformed.
std::vector<XmlElement> parse_xml(std::string_view xml);

}  // namespace mapproof::test
