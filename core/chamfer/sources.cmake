set(SOURCES loop.cpp section.cpp section_angle.cpp)
set(HEADERS job.hpp loop.hpp section.hpp section_angle.hpp)
