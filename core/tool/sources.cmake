set(SOURCES)
set(HEADERS tool.hpp)
