set(SOURCES boundary.cpp chip_force.cpp chips.cpp compliance.cpp cut.cpp cutter.cpp force.cpp height_map.cpp iterate.cpp
  oscillator.cpp predict.cpp require.cpp response.cpp time_domain.cpp)
set(HEADERS boundary.hpp chip_force.hpp chips.hpp compliance.hpp cut.hpp cutter.hpp force.hpp height_map.hpp iterate.hpp
  oscillator.hpp predict.hpp require.hpp response.hpp rows.hpp stock.hpp time_domain.hpp)
# std::complex products without the branch for NaN and infinity: G and F are finite.
set_source_files_properties(cutting/response.cpp PROPERTIES COMPILE_OPTIONS -fcx-limited-range)
