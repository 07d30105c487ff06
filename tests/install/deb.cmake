# Makes the Debian packages and looks into them.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK})
run(said ${CPACK} -G DEB --config ${BUILD}/CPackConfig.cmake -B ${WORK})
file(GLOB programs ${WORK}/ridgeline_${VERSION}_*.deb)
file(GLOB libraries ${WORK}/libridgeline-dev_${VERSION}_*.deb)

run(said dpkg-deb --contents ${programs})
foreach(file IN ITEMS
    ./usr/bin/ridgeline ./usr/bin/ridgelined ./usr/libexec/ridgeline/ridgeline-step
    ./usr/lib/systemd/system/ridgelined.service
    ./usr/share/man/man1/ridgeline.1 ./usr/share/zsh/vendor-completions/_ridgeline ./usr/share/doc/ridgeline/README.md)
  require_match("${said}" "root/root [^\n]* ${file}\n")
endforeach()
if(said MATCHES "[.]hpp")
  message(FATAL_ERROR "headers are in the package of the programs")
endif()
run(said dpkg-deb --field ${programs} Depends)
foreach(package IN ITEMS libc6 libddsc0debian libsqlite3-0 libocct-data-exchange-7.6)
  require_match("${said}" "(^|, )${package} ")
endforeach()

run(said dpkg-deb --contents ${libraries})
require_match("${said}" "libridgeline_chamfer[.]a\n")
require_match("${said}" "include/ridgeline/core/chamfer/job[.]hpp\n")
run(said dpkg-deb --field ${libraries} Depends)
require_match("${said}" "libeigen3-dev")
