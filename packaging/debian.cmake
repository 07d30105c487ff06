# cpack -G DEB: ridgeline (programs, unit, documentation) and libridgeline-dev (the libraries of core/).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR Ridgeline)
set(CPACK_PACKAGE_CONTACT "The Ridgeline developers <ridgeline@localhost>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime debian development)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENT_RUNTIME_GROUP programs)
set(CPACK_COMPONENT_DEBIAN_GROUP programs)
set(CPACK_COMPONENT_DEVELOPMENT_GROUP libraries)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/depends.cmake)
set(CPACK_RIDGELINE_PROGRAMS ${PROJECT_BINARY_DIR}/clients/ridgeline/ridgeline ${PROJECT_BINARY_DIR}/service/ridgelined
  ${PROJECT_BINARY_DIR}/libexec/ridgeline/ridgeline-step)

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME ridgeline)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "Tool paths that chamfer and deburr the edges of cross holes
 The service ridgelined, which answers over DDS, and the command ridgeline.")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_CONTROL_EXTRA
  ${CMAKE_CURRENT_LIST_DIR}/debian/postinst ${CMAKE_CURRENT_LIST_DIR}/debian/prerm ${CMAKE_CURRENT_LIST_DIR}/debian/postrm)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME libridgeline-dev)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)")
set(CPACK_COMPONENT_LIBRARIES_DESCRIPTION "Ridgeline's solvers as C++ libraries
 Static libraries, headers and find_package(Ridgeline).")
include(CPack)
