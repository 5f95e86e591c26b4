# Refuses, in one line, the systems that mapproof does not run on. Include it after project().
if(NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
  message(FATAL_ERROR "mapproof runs on Linux only; this is ${CMAKE_SYSTEM_NAME}")
elseif(NOT CMAKE_SIZEOF_VOID_P EQUAL 8)
  message(FATAL_ERROR "mapproof needs 64 bits; these are pointers of ${CMAKE_SIZEOF_VOID_P} bytes")
elseif(NOT CMAKE_CXX_BYTE_ORDER STREQUAL "LITTLE_ENDIAN")
  message(FATAL_ERROR "mapproof needs a little-endian processor; this is ${CMAKE_CXX_BYTE_ORDER}")
endif()
