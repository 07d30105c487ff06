set(SOURCES cl.cpp g_code_writer.cpp klartext_writer.cpp plan.cpp text.cpp tilted_plane.cpp validate.cpp write.cpp)
set(HEADERS cl.hpp plan.hpp program.hpp text.hpp tilted_plane.hpp validate.hpp writers.hpp)
