# mapproof_source_version: at each build, writes source_version.inc (version, commit, digest of the
# sources of core) if it has changed.
add_custom_target(mapproof_source_version
  COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -D VERSION=${PROJECT_VERSION}
          -D OUT=${PROJECT_BINARY_DIR}/generated/source_version.inc
          -P ${PROJECT_SOURCE_DIR}/scripts/cmake/write_source_version.cmake
  BYPRODUCTS ${PROJECT_BINARY_DIR}/generated/source_version.inc
  VERBATIM)
