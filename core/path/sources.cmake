set(SOURCES arc.cpp arc_fit.cpp closed_curve.cpp equal_error.cpp pieces.cpp)
set(HEADERS arc.hpp arc_fit.hpp closed_curve.hpp equal_error.hpp motion.hpp pieces.hpp)
