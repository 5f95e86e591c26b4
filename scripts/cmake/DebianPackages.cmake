# The Debian packages that scripts/package makes of this build by CPack (docs/packages.md). Paths are
# those of the prefix /usr.
option(MAPPROOF_PACKAGES "Prepare the Debian packages; needs the prefix /usr" OFF)
if(NOT MAPPROOF_PACKAGES)
  return()
endif()
if(NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  message(FATAL_ERROR "MAPPROOF_PACKAGES needs -D CMAKE_INSTALL_PREFIX=/usr")
endif()

# "+deb12": a package holds for the system that it was built on.
file(STRINGS /etc/os-release release REGEX "^(ID|VERSION_ID)=")
string(REGEX MATCH "VERSION_ID=\"?([0-9.]+)" found "${release}")
set(system_number ${CMAKE_MATCH_1})
string(REGEX MATCH "(^|;)ID=\"?([a-z]+)" found "${release}")
string(REPLACE "debian" "deb" system_name "${CMAKE_MATCH_2}")
set(MAPPROOF_PACKAGE_VERSION ${PROJECT_VERSION}+${system_name}${system_number})

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_PACKAGE_NAME mapproof)
set(CPACK_PACKAGE_VERSION ${MAPPROOF_PACKAGE_VERSION})
set(CPACK_DEBIAN_PACKAGE_VERSION ${MAPPROOF_PACKAGE_VERSION})
set(CPACK_PACKAGE_CONTACT "The mapproof authors <mapproof@packages.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
# Compresses manual pages, strips static libraries, and dates all files alike.
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/scripts/cmake/finish_packages.cmake)

string(TIMESTAMP MAPPROOF_PACKAGE_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
# "  NAME: LICENCE (USE)", a line per library.
file(READ ${PROJECT_SOURCE_DIR}/scripts/dependencies.txt text)
string(REGEX REPLACE "#[^\n]*\n" "" text "${text}")
string(REGEX REPLACE "([^;\n]+); ([^;\n]+); [^;\n]+; ([a-z]+)\n" "   \\1: \\2 (\\3)\n"
  MAPPROOF_PACKAGE_LIBRARIES "${text}")

# LICENSE as a paragraph of a copyright file.
file(READ ${PROJECT_SOURCE_DIR}/LICENSE text)
string(REGEX REPLACE "^.*Permission is" "Permission is" text "${text}")
string(REPLACE "\n\n" "\n.\n" text "${text}")
string(STRIP "${text}" text)
string(REPLACE "\n" "\n " text "${text}")
set(MAPPROOF_LICENCE "License: Expat\n ${text}\n")

# mapproof_package(GROUP PACKAGE SECTION SUMMARY COMPONENT...): what every package has.
macro(mapproof_package group package section summary)
  string(TOUPPER ${group} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}")
  foreach(component IN ITEMS ${ARGN})
    set(CPACK_COMPONENT_${component}_GROUP ${group})
    string(TOUPPER ${component} component_upper)
    set(CPACK_COMPONENT_${component_upper}_GROUP ${group})
    list(APPEND CPACK_COMPONENTS_ALL ${component})
  endforeach()
  list(GET CPACK_COMPONENTS_ALL -1 documented)
  set(MAPPROOF_PACKAGE ${package})
  set(folder ${PROJECT_BINARY_DIR}/packages/doc/${package})
  configure_file(${PROJECT_SOURCE_DIR}/scripts/deb/copyright.in ${folder}/copyright @ONLY)
  configure_file(${PROJECT_SOURCE_DIR}/scripts/deb/changelog.in ${folder}/changelog @ONLY)
  install(FILES ${folder}/copyright ${folder}/changelog
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${documented})
  if(EXISTS ${PROJECT_SOURCE_DIR}/scripts/deb/${package}.overrides)
    install(FILES ${PROJECT_SOURCE_DIR}/scripts/deb/${package}.overrides RENAME ${package}
      DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides COMPONENT ${documented})
  endif()
endmacro()

set(CPACK_COMPONENTS_ALL "")
mapproof_package(program mapproof science
"maps from what a robot observed, without estimating its pose
Builds maps of landmarks from bearings, ranges or the mere visibility that
a robot recorded, with figures, a self-contained report, and a comparison
that says why a figure changed. The package holds the program, what draws
3-D figures and animations, manual pages and completions."
  program)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# The program loads the reference BLAS and LAPACK (scripts/cmake/FindReferenceBlas.cmake).
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libblas3, liblapack3")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "git, poppler-utils")

mapproof_package(core libmapproof-core-dev libdevel
"mapping and range-only SLAM without pose estimation, library core
The static library mapproof::core with its headers: reading observations,
simulation, the mapping methods, range-only SLAM, alignment and scores.
Use it by find_package(mapproof COMPONENTS core)."
  core)
set(CPACK_DEBIAN_CORE_PACKAGE_DEPENDS "libblas-dev, libboost-dev, libceres-dev, libdeflate-dev, \
libeigen3-dev, libfmt-dev, libgfortran5, liblapack-dev, liblzma-dev, libmatio-dev, libmd-dev, \
libsdp-dev, libtbb-dev, libzip-dev, nlohmann-json3-dev, pkg-config | pkgconf, zlib1g-dev")

mapproof_package(libraries libmapproof-dev libdevel
"figures and reports of maps, libraries render and reports
The static libraries mapproof::render and mapproof::reports with their
headers: figures as values, SVG, PNG and PDF, reports, comparison of
folders. Use them by find_package(mapproof COMPONENTS render reports)."
  render reports)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_DEPENDS "libmapproof-core-dev (= ${MAPPROOF_PACKAGE_VERSION}), \
libcairo2-dev, libdeflate-dev, libexpat1-dev, libfreetype-dev, libharfbuzz-dev, libpng-dev, \
libsqlite3-dev")

if(MAPPROOF_PYTHON)
  mapproof_package(python python3-mapproof python
"maps from what a robot observed, module of Python
The module mapproof: observation histories, distances, all mapping methods,
alignment, scores, studies as pandas frames, and figures in notebooks."
    python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  # The extension loads in the Python that it was compiled for, and in no other minor version.
  foreach(number IN ITEMS MAJOR MINOR)
    get_directory_property(python_${number} DIRECTORY ${PROJECT_SOURCE_DIR}/app/python
      DEFINITION Python3_VERSION_${number})
  endforeach()
  math(EXPR python_next "${python_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= ${python_MAJOR}.${python_MINOR}~), \
python3 (<< ${python_MAJOR}.${python_next}), python3-numpy, python3:any")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-pandas)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/scripts/deb/postinst ${PROJECT_SOURCE_DIR}/scripts/deb/prerm)
endif()
include(CPack)
