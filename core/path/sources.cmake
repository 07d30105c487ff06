set(SOURCES)
set(HEADERS motion.hpp)
