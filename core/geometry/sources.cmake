set(SOURCES)
set(HEADERS frame.hpp profile.hpp ridge.hpp surface.hpp workpiece.hpp)
