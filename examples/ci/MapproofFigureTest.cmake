# mapproof_add_figure_test(NAME name COMMAND program [argument...] BASELINE folder
#                          [OUT folder] [WRITES folder] [SETTINGS file]
#                          [ALLOW verdict...] [INCLUDE pattern...] [EXCLUDE pattern...]
#                          [LABELS label...])
#
# Adds a test that runs a command which draws figures, and compares what it wrote with the baseline
# by "mapproof check" (docs/ci.md). The command runs in a new folder, or with WRITES in the current
# folder of the test, and then writes below that folder. COMMAND may begin with a target of the
# project, and may hold generator expressions. What was drawn, the images of what differs and a page
# stay in OUT, by default figures/NAME in the build folder:
#
#   include(MapproofFigureTest)
#   mapproof_add_figure_test(NAME figures.path COMMAND draw_path --format png
#                            BASELINE ${CMAKE_SOURCE_DIR}/baseline)
#
# The program is found by find_program(), or as MAPPROOF_PROGRAM.
include_guard()

function(mapproof_add_figure_test)
  cmake_parse_arguments(PARSE_ARGV 0 figure "" "NAME;BASELINE;OUT;WRITES;SETTINGS"
                        "COMMAND;ALLOW;INCLUDE;EXCLUDE;LABELS")
  foreach(key NAME COMMAND BASELINE)
    if(NOT figure_${key})
      message(FATAL_ERROR "mapproof_add_figure_test: ${key} is missing")
    endif()
  endforeach()
  if(figure_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "mapproof_add_figure_test: unknown ${figure_UNPARSED_ARGUMENTS}")
  endif()
  find_program(MAPPROOF_PROGRAM mapproof REQUIRED)

  set(out ${CMAKE_CURRENT_BINARY_DIR}/figures/${figure_NAME})
  if(figure_OUT)
    set(out ${figure_OUT})
  endif()
  set(options --baseline ${figure_BASELINE} --out ${out}/candidate --images ${out}/images
              --page ${out}/diff.html)
  if(figure_WRITES)
    list(APPEND options --writes ${figure_WRITES})
  endif()
  if(figure_SETTINGS)
    list(APPEND options --settings ${figure_SETTINGS})
  endif()
  if(figure_ALLOW)
    list(JOIN figure_ALLOW "," allowed)
    list(APPEND options --allow ${allowed})
  endif()
  foreach(pattern IN LISTS figure_INCLUDE)
    list(APPEND options --include ${pattern})
  endforeach()
  foreach(pattern IN LISTS figure_EXCLUDE)
    list(APPEND options --exclude ${pattern})
  endforeach()

  # add_test() puts the path of a target only where its name is the first word.
  list(POP_FRONT figure_COMMAND program)
  if(TARGET ${program})
    set(program $<TARGET_FILE:${program}>)
  endif()
  file(MAKE_DIRECTORY ${out})
  add_test(NAME ${figure_NAME}
           COMMAND ${MAPPROOF_PROGRAM} check ${options} -- ${program} ${figure_COMMAND})
  if(figure_LABELS)
    set_tests_properties(${figure_NAME} PROPERTIES LABELS "${figure_LABELS}")
  endif()
endfunction()
