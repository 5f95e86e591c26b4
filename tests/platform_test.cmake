# What Platform.cmake lets pass, and what it refuses in one line: `cmake -P platform_test.cmake`.
function(expect_platform system bytes order code line)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -D CMAKE_SYSTEM_NAME=${system} -D CMAKE_SIZEOF_VOID_P=${bytes}
            -D CMAKE_CXX_BYTE_ORDER=${order} -P ${CMAKE_CURRENT_LIST_DIR}/../scripts/cmake/Platform.cmake
    RESULT_VARIABLE result ERROR_VARIABLE error)
  string(REGEX REPLACE "^CMake Error at [^\n]*\n" "" said "${error}")
  string(STRIP "${said}" said)
  if(NOT result EQUAL code OR NOT said STREQUAL line)
    message(SEND_ERROR "${system}, ${bytes} bytes, ${order}: exit ${result}, said \"${said}\"")
  endif()
endfunction()

expect_platform(Linux 8 LITTLE_ENDIAN 0 "")
expect_platform(Linux 4 LITTLE_ENDIAN 1 "mapproof needs 64 bits; these are pointers of 4 bytes")
expect_platform(Linux 8 BIG_ENDIAN 1
  "mapproof needs a little-endian processor; this is BIG_ENDIAN")
expect_platform(Windows 8 LITTLE_ENDIAN 1 "mapproof runs on Linux only; this is Windows")
expect_platform(Darwin 8 LITTLE_ENDIAN 1 "mapproof runs on Linux only; this is Darwin")
