set(SOURCES error.cpp text.cpp version.cpp)
set(HEADERS angle.hpp error.hpp progress.hpp root.hpp text.hpp tolerance.hpp version.hpp)
