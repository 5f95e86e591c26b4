# mapproof_library(NAME [HEADER_PACKAGES TARGET...] [PACKAGES TARGET...])
#
# The static library mapproof::NAME of the modules in the folder NAME. HEADER_PACKAGES: what its
# headers include; PACKAGES: what any of its sources may include.
function(mapproof_library name)
  cmake_parse_arguments(PARSE_ARGV 1 library "" "" "HEADER_PACKAGES;PACKAGES")
  add_library(mapproof_${name}_packages INTERFACE)
  target_link_libraries(mapproof_${name}_packages
    INTERFACE ${library_HEADER_PACKAGES} ${library_PACKAGES})
  add_library(mapproof_${name} STATIC)
  add_library(mapproof::${name} ALIAS mapproof_${name})
  target_compile_features(mapproof_${name} PUBLIC cxx_std_20)
  target_include_directories(mapproof_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/mapproof>)
  target_link_libraries(mapproof_${name}
    PUBLIC ${library_HEADER_PACKAGES}
    PRIVATE ${library_PACKAGES} $<BUILD_INTERFACE:mapproof::build_flags>)
  set_target_properties(mapproof_${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
endfunction()

# mapproof_module(PATH [USES PATH...] [PACKAGES TARGET...] SOURCES FILE... [HEADERS FILE...])
#
# The module in the folder PATH ("core/align"), as the object library mapproof_core_align of the
# library that PATH begins with. Call it in that folder.
# USES: the modules that its files may include, itself apart. They must be there already, so that
# there is no circle. tests/app/tree/layers_test holds every #include to them.
# PACKAGES: what this module needs and others do not. HEADERS: what users of the library may include.
function(mapproof_module path)
  cmake_parse_arguments(PARSE_ARGV 1 module "" "" "USES;PACKAGES;SOURCES;HEADERS")
  string(REGEX MATCH "^[^/]+" library ${path})
  string(REPLACE "/" "_" name ${path})
  foreach(used IN LISTS module_USES)
    string(REPLACE "/" "_" used_name ${used})
    if(NOT TARGET mapproof_${used_name})
      message(FATAL_ERROR "The module ${path} uses ${used}, which is not below it.")
    endif()
  endforeach()
  foreach(header IN LISTS module_HEADERS)
    target_sources(mapproof_${library} PUBLIC
      FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${CMAKE_CURRENT_SOURCE_DIR}/${header})
  endforeach()
  if(NOT module_SOURCES)
    add_library(mapproof_${name} INTERFACE)
    return()
  endif()
  add_library(mapproof_${name} OBJECT ${module_SOURCES})
  target_include_directories(mapproof_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  if(MAPPROOF_PYTHON)
    # The module of Python is a shared library. Functions are inlined as in a program.
    set_target_properties(mapproof_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_options(mapproof_${name} PRIVATE -fno-semantic-interposition)
  endif()
  target_link_libraries(mapproof_${name}
    PRIVATE mapproof_${library}_packages ${module_PACKAGES} mapproof::build_flags)
  target_sources(mapproof_${library} PRIVATE $<TARGET_OBJECTS:mapproof_${name}>)
  target_link_libraries(mapproof_${library} PRIVATE ${module_PACKAGES})
  mapproof_unity(mapproof_${name})
endfunction()
