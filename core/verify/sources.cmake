set(SOURCES band.cpp clearance.cpp hull_bound.cpp measure.cpp overcut.cpp)
set(HEADERS band.hpp clearance.hpp extreme.hpp hull_bound.hpp measure.hpp overcut.hpp)
