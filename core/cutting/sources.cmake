set(SOURCES along.cpp beam.cpp boundary.cpp carve.cpp chip_force.cpp chip_search.cpp chips.cpp compliance.cpp cut.cpp cutter.cpp floquet.cpp
  follower.cpp force.cpp height_map.cpp iterate.cpp lobes.cpp modal_fit.cpp oscillator.cpp predict.cpp require.cpp response.cpp secants.cpp
  station.cpp time_domain.cpp wedge.cpp)
set(HEADERS along.hpp beam.hpp boundary.hpp carve.hpp chip_force.hpp chip_search.hpp chips.hpp compliance.hpp cut.hpp cutter.hpp floquet.hpp
  force.hpp height_map.hpp iterate.hpp lobes.hpp modal_fit.hpp oscillator.hpp predict.hpp require.hpp response.hpp rows.hpp secants.hpp
  station.hpp stock.hpp time_domain.hpp wedge.hpp)
# std::complex products without the branch for NaN and infinity: G and F are finite.
set_source_files_properties(cutting/response.cpp PROPERTIES COMPILE_OPTIONS
  $<$<CXX_COMPILER_ID:GNU>:-fcx-limited-range>)
# Square roots as one instruction: nothing here reads errno.
set_source_files_properties(cutting/chips.cpp cutting/chip_search.cpp PROPERTIES COMPILE_OPTIONS
  -fno-math-errno)
