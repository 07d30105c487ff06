# run(<out> <command>...): runs it; fails with what it said when it fails.
function(run out)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE said ERROR_VARIABLE complaint RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${ARGN}: ${failed}\n${said}${complaint}")
  endif()
  set(${out} "${said}" PARENT_SCOPE)
endfunction()

function(require_match text pattern)
  if(NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "no match for ${pattern} in:\n${text}")
  endif()
endfunction()
