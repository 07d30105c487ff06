set(SOURCES)
set(HEADERS measure.hpp)
