set(SOURCES border.cpp loop.cpp section.cpp section_angle.cpp swept.cpp)
set(HEADERS border.hpp job.hpp loop.hpp section.hpp section_angle.hpp)
