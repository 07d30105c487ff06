set(SOURCES break_out.cpp edge.cpp line_meetings.cpp material.cpp profile.cpp ridge.cpp seam.cpp solid.cpp surface.cpp trace.cpp workpiece.cpp)
set(HEADERS break_out.hpp frame.hpp line_meetings.hpp material.hpp profile.hpp ridge.hpp solid.hpp surface.hpp trace.hpp workpiece.hpp)
