# Runs by CPack over the files of each package before it is closed: what Debian's policy asks for,
# and a date that does not depend on when the package was made.
set(date $ENV{SOURCE_DATE_EPOCH})
if(NOT date)
  string(TIMESTAMP date "%s" UTC)
endif()
file(GLOB_RECURSE files LIST_DIRECTORIES true ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*)
foreach(file IN LISTS files)
  if(file MATCHES "/man/man1/[^/]+\\.1$|/changelog$" AND NOT IS_DIRECTORY ${file})
    execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
  elseif(file MATCHES "\\.a$")
    execute_process(COMMAND strip --strip-debug --remove-section=.comment --remove-section=.note
      --enable-deterministic-archives ${file} COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()
execute_process(COMMAND find ${CPACK_TEMPORARY_INSTALL_DIRECTORY} -exec touch -h -d @${date} {} +
  COMMAND_ERROR_IS_FATAL ANY)
