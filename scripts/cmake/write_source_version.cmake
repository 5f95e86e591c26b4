# Runs at each build: cmake -D ROOT= -D VERSION= -D OUT= -P write_source_version.cmake
cmake_minimum_required(VERSION 3.25)
set(commit unknown)
find_program(GIT git)
if(GIT AND EXISTS "${ROOT}/.git")
  execute_process(COMMAND ${GIT} -C ${ROOT} rev-parse --short=12 HEAD
    OUTPUT_VARIABLE head RESULT_VARIABLE failed ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT failed)
    execute_process(COMMAND ${GIT} -C ${ROOT} status --porcelain --untracked-files=no
      OUTPUT_VARIABLE changes ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    set(commit "${head}")
    if(NOT changes STREQUAL "")
      string(APPEND commit "-dirty")
    endif()
  endif()
endif()

# What the solver's digest is made of (docs/decisions/0004): every folder of core is in one of two
# lists. Of those that compute, some sources hold words or start programs; of those that do not, two folders read
# measurements, of which records know the file and not what was read.
set(computing align association base choice embed experiment external graph incremental linalg
  map_fit missing mixed model observe pairs range_slam score simulate statistics studies submaps
  topics uncertainty)
set(not_computing evaluate json records results)
set(words base/child_process base/text/error_text base/text/markup base/text/number_text
  base/text/percent base/text/raised base/text/retired_names base/text/shell_word base/text/slug
  base/text/spelling base/text/unit_text base/text/words base/version)
set(readers records/observations/ records/ranges/)

file(GLOB entries RELATIVE ${ROOT}/core LIST_DIRECTORIES true ${ROOT}/core/*)
foreach(folder IN LISTS entries)
  if(IS_DIRECTORY ${ROOT}/core/${folder} AND NOT folder IN_LIST computing AND NOT folder IN_LIST not_computing)
    message(FATAL_ERROR "core/${folder} is in neither list of scripts/cmake/write_source_version.cmake: "
      "does it compute what records hold?")
  endif()
endforeach()
string(REPLACE ";" "|" folders "${computing}")
string(REPLACE ";" "|" words "${words}")
string(REPLACE ";" "|" readers "${readers}")
file(GLOB_RECURSE sources RELATIVE ${ROOT} ${ROOT}/core/*.cpp ${ROOT}/core/*.hpp)
list(FILTER sources INCLUDE REGEX "^core/((${folders})/|(${readers}))")
list(FILTER sources EXCLUDE REGEX "^core/(${words})\\.")
list(SORT sources)
set(digests "")
foreach(source IN LISTS sources)
  file(SHA256 ${ROOT}/${source} digest)
  string(APPEND digests "${source} ${digest}\n")
endforeach()
string(SHA256 digest "${digests}")

set(text "#define MAPPROOF_VERSION \"${VERSION}\"
#define MAPPROOF_COMMIT \"${commit}\"
#define MAPPROOF_SOLVER_DIGEST \"${digest}\"
")
set(old "")
if(EXISTS ${OUT})
  file(READ ${OUT} old)
endif()
if(NOT old STREQUAL text)
  file(WRITE ${OUT} "${text}")
endif()
