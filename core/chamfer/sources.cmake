set(SOURCES blocks.cpp border.cpp loop.cpp motion.cpp neighbours.cpp route.cpp section.cpp section_angle.cpp solve.cpp swept.cpp validate.cpp)
set(HEADERS blocks.hpp border.hpp job.hpp loop.hpp motion.hpp neighbours.hpp route.hpp section.hpp section_angle.hpp)
