set(SOURCES cl.cpp expand.cpp g_code_block.cpp g_code_words.cpp g_code_reader.cpp g_code_writer.cpp klartext_reader.cpp klartext_tokens.cpp klartext_writer.cpp
    plan.cpp reader.cpp text.cpp tilted_plane.cpp tracer.cpp turning.cpp validate.cpp write.cpp)
set(HEADERS cl.hpp expand.hpp g_code_block.hpp g_code_words.hpp klartext_tokens.hpp plan.hpp program.hpp reader.hpp text.hpp tilted_plane.hpp tracer.hpp turning.hpp validate.hpp
    writers.hpp)
