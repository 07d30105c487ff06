set(SOURCES error.cpp)
set(HEADERS angle.hpp error.hpp progress.hpp tolerance.hpp)
