set(SOURCES surface.cpp)
set(HEADERS coefficients.hpp surface.hpp tool.hpp)
