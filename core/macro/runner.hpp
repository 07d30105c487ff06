#pragma once

#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/macro/interpreter.hpp"
#include "core/macro/nc_executor.hpp"
#include "core/macro/system_variables.hpp"

namespace ridgeline::macro {

/// Program flow of one run (design section 2.4): blocks, jumps, loops, calls, limits.
class Runner {
public:
  Runner(std::string text, const Options& options, const Progress& progress);
  Result run();

private:
  /// Arguments of a macro call.
  struct Arguments {
    Locals values;
    std::uint64_t undotted = 0;
    double scale = 1;
  };
  enum class FrameKind { Main, Subprogram, Macro, Modal };
  struct Frame {
    FrameKind kind = FrameKind::Main;
    const Program* program = nullptr;
    std::int32_t next = 0;               ///< block
    std::int64_t repeats = 1;            ///< runs left, this one included
    std::size_t modal_depth = no_limit;  ///< G66 calls that its moves may trigger
    Arguments arguments;
  };
  struct ModalCall {
    const Program* program = nullptr;
    std::int64_t repeats = 1;
    Arguments arguments;
  };
  static constexpr std::size_t no_limit = static_cast<std::size_t>(-1);

  // runner.cpp
  void prepare();
  void loop();
  void step(Frame& frame, const Block& block);
  void check_limits();
  void assign(const Frame& frame, const Block& block);
  void take_room(std::size_t bytes);
  void assign_system(const Program& program, const Block& block, int number, Value value);
  bool holds(const Frame& frame, const Block& block) const;
  void jump(Frame& frame, std::int32_t from, const Block& block);
  void print(const Program& program, const Block& block);
  void nc(Frame& frame, const Block& block);
  void trace(const Program& program, const Block& block);
  void finish();

  // calls.cpp
  const Program& find(int number, int column);
  const Program* loaded(int number);
  void load(std::string text);
  void note_commons(const Program& program);
  void call_macro(Frame& frame, const Block& block);
  void call_modal(Frame& frame, const Block& block);
  void after_move();
  void call_subprogram();
  void return_from(bool to_label);
  void restart_main();
  Arguments read_arguments(const Program& program, const Block& block, std::int64_t& repeats,
                           int& number, int& number_column);
  void push(Frame frame, int column);
  int levels(bool macros) const;

  const Options& options_;
  const Progress& progress_;
  Result result_;
  State state_;
  ControlVariables system_;
  Variables variables_;
  Recorder recorder_;
  NcExecutor executor_;
  NcWords words_;
  std::deque<Program> programs_;  ///< stays in place while frames point into it
  std::map<int, const Program*> by_number_;
  std::vector<Frame> frames_;
  std::vector<ModalCall> modal_calls_;
  bool ended_ = false;
  std::uint64_t next_check_ = 0;
  std::size_t text_bytes_ = 0;
  std::chrono::steady_clock::time_point start_;
  const Block* block_ = nullptr;   ///< being executed
  int assigned_ = 0;               ///< variable of the last assignment, for the trace
  const Block* hazard_ = nullptr;  ///< last block warned of
  struct Restart {
    std::array<Value, 1000> commons;
    Locals locals;
    Axes machine;
    bool is_set = false;
  } restart_;
};

}  // namespace ridgeline::macro
