set(SOURCES arc.cpp pieces.cpp)
set(HEADERS arc.hpp motion.hpp pieces.hpp)
