#include "tests/support/xml.hpp"

#include <memory>
#include <stdexcept>

#include <expat.h>

namespace mapproof::test {
namespace {

struct State {
  std::vector<XmlElement> elements;
  std::vector<std::size_t> open;
};

void start(void* data, const char* name, const char** attributes) {
  auto& state = *static_cast<State*>(data);
  XmlElement element{name, {}, {}};
  for (; *attributes != nullptr; attributes += 2) element.attributes[attributes[0]] = attributes[1];
  state.open.push_back(state.elements.size());
  state.elements.push_back(std::move(element));
}

void end(void* data, const char*) { static_cast<State*>(data)->open.pop_back(); }

void text(void* data, const char* characters, int length) {
  auto& state = *static_cast<State*>(data);
  state.elements[state.open.back()].text.append(characters, static_cast<std::size_t>(length));
}

}  // namespace

std::vector<XmlElement> parse_xml(std::string_view xml) {
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
      XML_ParserCreate("UTF-8"), &XML_ParserFree);
  State state;
  XML_SetUserData(parser.get(), &state);
  XML_SetElementHandler(parser.get(), start, end);
  XML_SetCharacterDataHandler(parser.get(), text);
  if (XML_Parse(parser.get(), xml.data(), static_cast<int>(xml.size()), 1) != XML_STATUS_OK)
    throw std::runtime_error(XML_ErrorString(XML_GetErrorCode(parser.get())));
  return std::move(state.elements);
}

}  // namespace mapproof::test
