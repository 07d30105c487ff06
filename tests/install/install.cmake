# Installs, looks for what packages and users expect, runs it, and builds the example of find_package against it.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)
file(REMOVE_RECURSE ${WORK})
set(prefix ${WORK}/prefix)
run(said ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
foreach(file IN ITEMS
    bin/ridgeline bin/ridgelined libexec/ridgeline/ridgeline-step
    include/ridgeline/core/chamfer/job.hpp
    ${LIBDIR}/libridgeline_chamfer.a ${LIBDIR}/cmake/Ridgeline/RidgelineConfig.cmake
    lib/systemd/system/ridgelined.service
    share/man/man1/ridgeline.1 share/man/man8/ridgelined.8
    share/bash-completion/completions/ridgeline share/zsh/site-functions/_ridgeline
    share/doc/ridgeline/README.md share/doc/ridgeline/CHANGELOG.md share/doc/ridgeline/docs/dds.md
    share/ridgeline/config/network.xml share/ridgeline/examples/valve_port.json
    share/ridgeline/examples/controller/controller.c share/ridgeline/idl/ridgeline.idl share/ridgeline/schema/ridgeline.schema.json)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()

foreach(program IN ITEMS ridgeline ridgelined)
  run(said ${prefix}/bin/${program} --version)
  if(NOT said STREQUAL "${program} ${VERSION}\n")
    message(FATAL_ERROR "${program} --version prints ${said}")
  endif()
endforeach()
run(said ${prefix}/bin/ridgeline chamfer ${prefix}/share/ridgeline/examples/inline.json --local --format nc)
require_match("${said}" "RIDGELINE")
file(WRITE ${WORK}/part.json "{\"job\": \"units\", \"product\": \"${CMAKE_CURRENT_LIST_DIR}/../parts/own_hard_shaft.step\"}")
run(said ${prefix}/bin/ridgeline units plan ${WORK}/part.json --local)
require_match("${said}" "bar_outer")

# A copy, so that nothing but the installed files can be found.
file(COPY ${prefix}/share/ridgeline/examples/core DESTINATION ${WORK})
run(said ${CMAKE_COMMAND} -S ${WORK}/core -B ${WORK}/build -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CXX}
  -DCMAKE_CXX_FLAGS=${FLAGS})
run(said ${CMAKE_COMMAND} --build ${WORK}/build)
run(said ${WORK}/build/chamfer_edge)
# The tolerance of the path is 0.005 mm.
require_match("${said}" "^Ridgeline ${VERSION}: [0-9]+ points, width 0[.](49[5-9]|50)[0-9]* to 0[.]50[0-5][0-9]* mm, overcut 0 mm\n$")
