#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/macro/alarm.hpp"
#include "core/macro/profile.hpp"

namespace ridgeline::macro {

/// Step of a compiled expression; operands are on a stack.
enum class Op : std::uint8_t {
  Return,
  Literal,   ///< push `number`
  Local,     ///< push #1..#33
  Common,    ///< push a common variable
  System,    ///< push any other variable by number
  Indirect,  ///< replace the top by the variable of that number
  Negate,
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
  BitAnd,
  BitOr,
  BitXor,
  Equal,
  NotEqual,
  Greater,
  GreaterEqual,
  Less,
  LessEqual,
  LogicalAnd,
  LogicalOr,
  LogicalXor,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Atan2,
  Sqrt,
  Abs,
  Bin,
  Bcd,
  Round,
  Fix,
  Fup,
  Ln,
  Exp,
  Pow,
  Adp,
  NameNumber,  ///< push the number of the common variable that SETVN named `index` of names
  Subscript,   ///< replace the top, n, by `index` + n; n from 0 to `number`
  Parameter    ///< PRM; `index`: bit 0 a bit number, bit 1 an axis on the stack above the number
};

struct Instruction {
  Op op = Op::Return;
  std::uint16_t column = 0;
  std::int32_t index = 0;  ///< variable number
  double number = 0;
};

/// One address with its value, e.g. X12.5, G#8, Y-[#1*2]. '<' is a program name of M98, G65, G66:
/// `number` is its index in Program::names.
struct Word {
  static constexpr std::uint8_t is_literal = 1, has_point = 2;
  char letter = 0;  ///< upper case; 'c' and 'r' stand for ,C and ,R
  std::uint8_t flags = 0;
  std::uint16_t column = 0;
  std::int32_t code = 0;  ///< first instruction, unless literal
  double number = 0;      ///< of a literal, as written
};

enum class BlockKind : std::uint8_t {
  Empty,
  Nc,
  Assign,  ///< #i = expression
  IfGoto,  ///< IF[c]GOTO: jumps when the condition holds
  IfThen,  ///< IF[c]THEN: the statement is the next block; `target` follows it
  While,   ///< `target` is the END
  Do,      ///< endless loop, `target` is the END
  End,     ///< `target` is the WHILE or DO
  Goto,
  Call,       ///< G65
  ModalCall,  ///< G66 G66.1
  Print,      ///< DPRNT
  Name,       ///< SETVN: `words` names from `first_word` on, for `variable` and those after it
  Ignored,    ///< POPEN, PCLOS, BPRNT
  Faulty      ///< raises alarm `target` of Program::alarms when it is reached
};

struct Block {
  BlockKind kind = BlockKind::Empty;
  bool optional = false;        ///< begins with /
  std::uint16_t column = 0;     ///< of the statement
  std::uint32_t line = 0;       ///< from 1
  std::int32_t label = -1;      ///< N
  std::int32_t code = -1;       ///< condition or assigned value
  std::int32_t target = -1;     ///< block to jump to; the loop's partner; an alarm
  std::int32_t goto_code = -1;  ///< computed GOTO
  std::int32_t variable = -1;   ///< assigned variable; -1: `goto_code` computes its number
  std::int32_t loop = -1;       ///< innermost WHILE or DO that holds this block
  std::uint32_t first_word = 0;
  std::uint32_t words = 0;
  std::uint32_t text = 0;  ///< offset of the line in the source
};

struct Label {
  std::int32_t number = 0;
  std::int32_t block = 0;
};

/// One O program, compiled.
struct Program {
  int number = 0;    ///< 0: no O number
  std::string name;  ///< of a program <NAME>
  int line = 1;      ///< of the O word
  std::shared_ptr<const std::string> source;
  std::vector<Block> blocks;
  std::vector<Word> words;
  std::vector<Instruction> code;
  std::vector<Alarm> alarms;       ///< of Faulty blocks
  std::vector<Label> labels;       ///< by number, then by block
  std::vector<std::string> names;  ///< of variables and programs, as its blocks say them
};

/// Compiles a text, which may hold several O programs, with or without % marks. Never fails:
/// a block that cannot be read becomes Faulty and raises its alarm when a run reaches it, as on a
/// control. A text without any block gives one empty program.
std::vector<Program> compile(std::string text, const Profile& profile);

/// The block that GOTO n reaches from block `from`: searched from the next block to the end, then
/// from the top. -1: there is none.
std::int32_t goto_target(const Program& program, int n, std::int32_t from);

/// The line of a block as written, without line end.
std::string_view line_text(const Program& program, const Block& block);

/// The first comment after the beginning of the block's statement on its line, without brackets.
std::string_view comment_text(const Program& program, const Block& block);

}  // namespace ridgeline::macro
