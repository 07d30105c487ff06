set(SOURCES edge.cpp profile.cpp ridge.cpp surface.cpp workpiece.cpp)
set(HEADERS frame.hpp profile.hpp ridge.hpp surface.hpp workpiece.hpp)
