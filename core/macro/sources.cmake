set(SOURCES
  alarm.cpp block_parser.cpp call_arguments.cpp calls.cpp canned.cpp check.cpp code_calls.cpp compensation.cpp compile.cpp corner.cpp corner_break.cpp cycle.cpp
  cycle_cusp.cpp cycle_motion.cpp cycle_program.cpp cycle_section.cpp cycle_validate.cpp evaluate.cpp hole_edge.cpp
  expression_parser.cpp line_reader.cpp listing.cpp loops.cpp macro_text.cpp motion_builder.cpp names.cpp nc_executor.cpp nc_motion.cpp nc_setting.cpp nc_words.cpp outline_motion.cpp parameters.cpp profile.cpp program_arguments.cpp program_body.cpp program_outline.cpp program_passes.cpp
  recorder.cpp refuse.cpp runner.cpp state.cpp system_variables.cpp text.cpp value_types.cpp variables.cpp)
set(HEADERS
  alarm.hpp block_parser.hpp check.hpp compensation.hpp corner.hpp corner_break.hpp cycle.hpp cycle_motion.hpp cycle_program.hpp
  cycle_section.hpp expression_parser.hpp hole_edge.hpp interpreter.hpp
  line_reader.hpp listing.hpp loops.hpp macro_text.hpp motion_builder.hpp names.hpp parameters.hpp nc_executor.hpp nc_words.hpp outline_motion.hpp profile.hpp program.hpp program_body.hpp recorder.hpp refuse.hpp result.hpp runner.hpp
  segment.hpp state.hpp system_variables.hpp text.hpp value.hpp value_types.hpp variables.hpp)
