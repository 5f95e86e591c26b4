#pragma once

#include <cstdint>

#include <expat.h>

namespace mapproof {

/// Where a parser of XML stands, from 1. Expat has other names for it from 2.9 on.
#if XML_MAJOR_VERSION > 2 || XML_MINOR_VERSION >= 9
inline std::uint64_t line_of(XML_Parser parser) { return XML_GetCurrentLineNumber64(parser); }
inline std::uint64_t column_of(XML_Parser parser) {
  return XML_GetCurrentColumnNumber64(parser) + 1;
}
#else
inline std::uint64_t line_of(XML_Parser parser) { return XML_GetCurrentLineNumber(parser); }
inline std::uint64_t column_of(XML_Parser parser) { return XML_GetCurrentColumnNumber(parser) + 1; }
#endif

}  // namespace mapproof
