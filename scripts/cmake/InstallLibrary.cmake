# Installs the libraries of this build, with their headers and what find_package(mapproof) reads.
# Each is a component of its own, so that a package can hold core alone.
include(CMakePackageConfigHelpers)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/mapproof)
set(libraries core)
if(NOT MAPPROOF_CORE_ONLY)
  list(APPEND libraries render reports)
endif()
foreach(library IN LISTS libraries)
  set_target_properties(mapproof_${library} PROPERTIES EXPORT_NAME ${library})
  install(TARGETS mapproof_${library} EXPORT mapproof-${library}
    ARCHIVE COMPONENT ${library}
    FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/mapproof COMPONENT ${library})
  install(EXPORT mapproof-${library} NAMESPACE mapproof:: DESTINATION ${config_folder}
    COMPONENT ${library})
  string(SUBSTRING ${library} 0 1 first)
  string(SUBSTRING ${library} 1 -1 rest)
  string(TOUPPER ${first} first)
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/${first}${rest}Packages.cmake
    DESTINATION ${config_folder} COMPONENT ${library})
endforeach()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/mapproofConfig.cmake.in
  ${PROJECT_BINARY_DIR}/mapproofConfig.cmake INSTALL_DESTINATION ${config_folder})
# The interfaces may change between minor versions (docs/stability.md).
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mapproofConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mapproofConfig.cmake
  ${PROJECT_BINARY_DIR}/mapproofConfigVersion.cmake
  ${CMAKE_CURRENT_LIST_DIR}/FindCsdp.cmake ${CMAKE_CURRENT_LIST_DIR}/FindReferenceBlas.cmake
  DESTINATION ${config_folder} COMPONENT core)
