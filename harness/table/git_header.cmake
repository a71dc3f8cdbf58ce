# Writes ${OUTPUT}: the commit that ${SOURCE} is at, and whether tracked files differ from it. Leaves the file alone where nothing changed,
# so that nothing is compiled again.
set(commit "unknown")
set(dirty 0)
set(sources "")  # what the program is built from: git's names of the folders' content, where no file there differs from them
find_package(Git QUIET)
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --verify HEAD WORKING_DIRECTORY ${SOURCE}
    OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
  if(status EQUAL 0)
    set(commit ${head})
    execute_process(COMMAND ${GIT_EXECUTABLE} status --porcelain --untracked-files=no WORKING_DIRECTORY ${SOURCE}
      OUTPUT_VARIABLE changes ERROR_QUIET)
    if(NOT changes STREQUAL "")
      set(dirty 1)
    endif()
    execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse HEAD:core HEAD:harness
      WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE trees OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE status)
    if(status EQUAL 0 AND NOT changes MATCHES "[ /\"](core|harness)/")
      string(REPLACE "\n" " " sources "${trees}")
    endif()
  endif()
endif()
set(content "#define HYBRAY_GIT_COMMIT \"${commit}\"\n#define HYBRAY_GIT_DIRTY ${dirty}\n#define HYBRAY_GIT_SOURCES \"${sources}\"\n")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} old)
endif()
if(NOT "${content}" STREQUAL "${old}")
  file(WRITE ${OUTPUT} "${content}")
endif()
