set(SOURCES
  alarm.cpp block_parser.cpp calls.cpp canned.cpp compensation.cpp compile.cpp corner.cpp corner_break.cpp evaluate.cpp
  expression_parser.cpp line_reader.cpp loops.cpp nc_executor.cpp nc_motion.cpp nc_setting.cpp nc_words.cpp profile.cpp
  recorder.cpp runner.cpp state.cpp system_variables.cpp text.cpp variables.cpp)
set(HEADERS
  alarm.hpp block_parser.hpp compensation.hpp corner.hpp corner_break.hpp expression_parser.hpp interpreter.hpp
  line_reader.hpp loops.hpp nc_executor.hpp nc_words.hpp profile.hpp program.hpp recorder.hpp result.hpp runner.hpp
  segment.hpp state.hpp system_variables.hpp text.hpp value.hpp variables.hpp)
