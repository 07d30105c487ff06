set(SOURCES arc.cpp)
set(HEADERS arc.hpp motion.hpp)
