set(SOURCES arc.cpp closed_curve.cpp equal_error.cpp pieces.cpp)
set(HEADERS arc.hpp closed_curve.hpp equal_error.hpp motion.hpp pieces.hpp)
