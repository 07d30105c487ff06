# Run by cpack: the packages that the programs link. CPack's own way asks `file` about every page and picture, which takes
# longer than all the rest.
set(folder ${CPACK_PACKAGE_DIRECTORY}/shlibdeps)
file(WRITE ${folder}/debian/control "Source: ridgeline\nPackage: ridgeline\n")
execute_process(COMMAND dpkg-shlibdeps -O ${CPACK_RIDGELINE_PROGRAMS}
  WORKING_DIRECTORY ${folder} OUTPUT_VARIABLE said ERROR_VARIABLE complaint RESULT_VARIABLE failed)
if(failed OR NOT said MATCHES "shlibs:Depends=([^\n]+)")
  message(FATAL_ERROR "dpkg-shlibdeps (package dpkg-dev): ${failed}\n${said}${complaint}")
endif()
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "${CMAKE_MATCH_1}")
