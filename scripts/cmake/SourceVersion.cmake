# mapproof_source_version: writes source_version.inc (commit, digest of core's sources) at each
# build, and touches it only when it changes.
add_custom_target(mapproof_source_version
  COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -D VERSION=${PROJECT_VERSION}
          -D OUT=${PROJECT_BINARY_DIR}/generated/source_version.inc
          -P ${PROJECT_SOURCE_DIR}/scripts/cmake/write_source_version.cmake
  BYPRODUCTS ${PROJECT_BINARY_DIR}/generated/source_version.inc
  VERBATIM)
