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
  /// What a block that calls a macro says.
  struct Call {
    Arguments arguments;
    std::int64_t repeats = 1;
    int number = -1;  ///< P
    int name = -1;    ///< <NAME>
    int column = 0;   ///< of either, else of the block
    double code = 0;  ///< G or M code that calls
  };
  enum class FrameKind { Main, Subprogram, Macro, Modal };
  struct Frame {
    FrameKind kind = FrameKind::Main;
    const Program* program = nullptr;
    std::int32_t next = 0;               ///< block
    std::int32_t first = 0;              ///< where each of its runs begins
    std::int64_t repeats = 1;            ///< runs left, this one included
    std::size_t modal_depth = no_limit;  ///< G66 calls that its moves may trigger
    bool is_by_code = false;             ///< called by a G, M or T code of CodeCalls
    Arguments arguments;
  };
  struct ModalCall {
    const Program* program = nullptr;
    std::int64_t repeats = 1;
    Arguments arguments;
    bool is_each_block = false;  ///< G66.1: in place of every block, its words are the arguments
  };
  static constexpr std::size_t no_limit = static_cast<std::size_t>(-1);

  // runner.cpp
  void prepare();
  void loop();
  void step(Frame& frame, const Block& block);
  void check_limits();
  int computed_number(const Program& program, std::int32_t code, int column) const;
  void assign(const Frame& frame, const Block& block);
  void take_room(std::size_t bytes);
  void assign_system(const Program& program, const Block& block, int number, Value value);
  bool holds(const Frame& frame, const Block& block) const;
  void jump(Frame& frame, std::int32_t from, const Block& block);
  void print(const Program& program, const Block& block);
  void name_variables(const Program& program, const Block& block);
  void nc(Frame& frame, const Block& block);
  void trace(const Program& program, const Block& block);
  void finish();

  // code_calls.cpp
  bool may_call_by_code() const;
  bool macro_by_code(Frame& frame, const Block& block);
  const Program* subprogram_by_code();
  void call_by_code(const Program& called, int column);

  // calls.cpp
  const Program& find(int number, int column);
  const Program& find(const std::string& name, int column);
  const Program& called_by(const Program& program, const Call& call);
  const Program* loaded(int number);
  void load(std::string text);
  void note_commons(const Program& program);
  void call_macro(Frame& frame, const Block& block);
  void call_modal(Frame& frame, const Block& block);
  void add_modal(const Program& program, const Call& call, int column);
  void after_move();
  void call_modally(const ModalCall& call, const Arguments& arguments, std::size_t depth,
                    int column);
  std::size_t modal_depth() const;
  void note_modal_call();
  bool is_each_block_call() const;
  void call_each_block(const Program& program, const Block& block);
  void call_subprogram(const Program& program);
  const Program& numbered_subprogram(std::int64_t& repeats);
  void return_from(bool to_label);
  void restart_main();
  Call read_call(const Program& program, const Block& block);
  Call read_call(const Program& program, const Block& block, char letter, double low, double high);
  Value word_value(const Program& program, const Word& word) const;
  void take_argument(Arguments& arguments, const Word& word, Value value, int variable) const;
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
  std::map<std::string, const Program*, std::less<>> by_name_;
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
