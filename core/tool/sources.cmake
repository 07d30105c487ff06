set(SOURCES)
set(HEADERS coefficients.hpp tool.hpp)
