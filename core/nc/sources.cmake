set(SOURCES)
set(HEADERS program.hpp)
