set(SOURCES contour.cpp curve.cpp offset.cpp overlay.cpp region.cpp)
set(HEADERS contour.hpp curve.hpp offset.hpp overlay.hpp region.hpp tolerance.hpp)
