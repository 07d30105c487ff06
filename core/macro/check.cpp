#include "core/macro/check.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "core/macro/loops.hpp"
#include "core/macro/program.hpp"
#include "core/macro/text.hpp"
#include "core/macro/value_types.hpp"

namespace ridgeline::macro {

namespace {

constexpr std::int64_t last_program_number = 999999999;

bool is_literal(const Word& word) {
  return (word.flags & Word::is_literal) != 0;
}

/// Does the block have this M code, written as a number?
bool has_m(const Program& program, const Block& block, int code) {
  if (block.kind != BlockKind::Nc) return false;
  const auto* first = program.words.data() + block.first_word;
  return std::any_of(first, first + block.words, [code](const Word& word) {
    return word.letter == 'M' && is_literal(word) && word.number == code;
  });
}

// Computed jumps and returns with M99 P reach labels that cannot be told.
bool jumps_anywhere(const Program& program) {
  return std::any_of(program.blocks.begin(), program.blocks.end(), [&](const Block& block) {
    if (has_m(program, block, 99)) {
      const auto* first = program.words.data() + block.first_word;
      return std::any_of(first, first + block.words,
                         [](const Word& word) { return word.letter == 'P'; });
    }
    return (block.kind == BlockKind::Goto || block.kind == BlockKind::IfGoto) &&
           block.goto_code >= 0;
  });
}

/// What the programs of a text have in common.
struct Context {
  explicit Context(const std::vector<Program>& programs)
      : types(programs),
        is_entered_by_label(std::any_of(programs.begin(), programs.end(), jumps_anywhere)) {
    for (const Program& program : programs) numbers.insert(program.number);
  }
  ValueTypes types;
  bool is_entered_by_label = false;
  std::set<int> numbers;
};

/// Looks at one program of a text.
class ProgramCheck {
public:
  ProgramCheck(const Program& program, const Context& context, std::vector<Finding>& findings)
      : program_(program), context_(context), findings_(findings) {}

  void run(const std::function<bool(int)>& has_program) {
    for (std::size_t i = 0; i < program_.blocks.size(); ++i) {
      const Block& block = program_.blocks[i];
      if (block.kind == BlockKind::Faulty) faulty(block);
      jumps(static_cast<std::int32_t>(i));
      comparisons(block);
      growth(block);
      calls(block, has_program);
    }
    reads();
    labels();
    reachability();
  }

private:
  void report(const std::string& rule, Severity severity, const Block& block,
              const std::string& message, int column = 0) {
    findings_.push_back({rule, severity, message, program_.number, static_cast<int>(block.line),
                         column > 0 ? column : block.column});
  }

  void faulty(const Block& block) {
    const Alarm& alarm = program_.alarms[static_cast<std::size_t>(block.target)];
    const bool is_loop = alarm.number == static_cast<int>(AlarmNumber::EndMissing) ||
                         alarm.number == static_cast<int>(AlarmNumber::LoopNumber);
    report(is_loop ? "missing_end" : "format", Severity::Error, block,
           numbered("alarm ", alarm.number) + ": " + readable(alarm.message), alarm.column);
  }

  void jumps(std::int32_t index) {
    const Block& block = program_.blocks[static_cast<std::size_t>(index)];
    const bool is_jump = block.kind == BlockKind::Goto || block.kind == BlockKind::IfGoto;
    if (!is_jump || block.goto_code >= 0) return;
    if (block.target < 0) {
      report("goto_target", Severity::Error, block,
             numbered("there is no N", block.variable) + " in the program");
    } else if (!may_jump(program_, index, block.target)) {
      report("goto_into_loop", Severity::Error, block,
             numbered("N", block.variable) + " is inside a loop that this block is not in");
    }
  }

  void comparisons(const Block& block) {
    const bool has_condition = block.kind == BlockKind::IfGoto || block.kind == BlockKind::IfThen ||
                               block.kind == BlockKind::While;
    if (!has_condition) return;
    std::vector<ValueTypes::Comparison> compared;
    context_.types.of(program_, block.code, &compared);
    for (const ValueTypes::Comparison& each : compared) {
      const bool tests_vacant = each.left == ValueType::Vacant || each.right == ValueType::Vacant;
      if (tests_vacant || (each.left != ValueType::Real && each.right != ValueType::Real)) continue;
      report("real_equality", Severity::Warning, block,
             "EQ or NE between computed reals; compare ABS[a-b] with a small number", each.column);
    }
  }

  // #i = #i +- x inside a loop, where x is a fraction.
  void growth(const Block& block) {
    if (block.kind != BlockKind::Assign || block.loop < 0 || block.variable <= 0) return;
    const auto* code = program_.code.data() + block.code;  // ends with Return
    const auto is_variable = [&](const Instruction& at) {
      return (at.op == Op::Local || at.op == Op::Common) && at.index == block.variable;
    };
    const bool is_growth = is_variable(code[0]) && code[1].op != Op::Return &&
                           (code[2].op == Op::Add || code[2].op == Op::Subtract) &&
                           code[3].op == Op::Return;
    if (!is_growth) return;
    const bool is_fraction =
        code[1].op == Op::Literal &&
        code[1].number != static_cast<double>(static_cast<long>(code[1].number));
    if (!is_fraction && !tests_in_loop(block)) return;
    if (is_fraction || context_.types.of(program_, block.code) == ValueType::Real) {
      report("adds_up", Severity::Warning, block,
             numbered("#", block.variable) +
                 " grows by a fraction in each pass: its rounding adds up and may lose or double "
                 "the last pass; compute start + count * step");
    }
  }

  // Does the loop of the block test the variable that the block assigns?
  bool tests_in_loop(const Block& block) const {
    const Block& loop = program_.blocks[static_cast<std::size_t>(block.loop)];
    if (loop.kind != BlockKind::While) return false;
    for (const auto* at = program_.code.data() + loop.code; at->op != Op::Return; ++at) {
      if ((at->op == Op::Local || at->op == Op::Common) && at->index == block.variable) return true;
    }
    return false;
  }

  void calls(const Block& block, const std::function<bool(int)>& has_program) {
    const bool is_call = block.kind == BlockKind::Call || block.kind == BlockKind::ModalCall ||
                         has_m(program_, block, 98);
    if (!is_call) return;
    for (std::uint32_t i = 0; i < block.words; ++i) {
      const Word& word = program_.words[block.first_word + i];
      if (word.letter != 'P' || !is_literal(word)) continue;
      const auto number = static_cast<std::int64_t>(word.number);
      const auto has = [&](std::int64_t wanted) {
        if (wanted > last_program_number) return false;
        const int program = static_cast<int>(wanted);
        return context_.numbers.contains(program) || (has_program && has_program(program));
      };
      if (has(number) || (number > 9999 && has(number % 10000))) continue;
      report("missing_program", Severity::Warning, block,
             numbered("O", number) + " is not in the text or the library", word.column);
    }
  }

  // Locals of a main program, and system variables that depend on the motion.
  void reads() {
    const bool is_main =
        std::any_of(program_.blocks.begin(), program_.blocks.end(), [this](const Block& block) {
          return has_m(program_, block, 30) || has_m(program_, block, 2);
        });
    std::set<int> warned;
    for (const Block& block : program_.blocks) {
      for (const std::int32_t code : {block.code, block.goto_code}) {
        if (code >= 0) expression_reads(block, code, is_main, warned);
      }
      const bool has_words = block.kind == BlockKind::Nc || block.kind == BlockKind::Call ||
                             block.kind == BlockKind::ModalCall;
      for (std::uint32_t i = 0; has_words && i < block.words; ++i) {
        const Word& word = program_.words[block.first_word + i];
        if (!is_literal(word)) expression_reads(block, word.code, is_main, warned);
      }
    }
  }

  void expression_reads(const Block& block, std::int32_t code, bool is_main,
                        std::set<int>& warned) {
    for (const auto* at = program_.code.data() + code; at->op != Op::Return; ++at) {
      const int n = at->index;
      if (at->op == Op::System && ((n > 5020 && n < 5060) || n == 3001 || n == 3002)) {
        report("look_ahead", Severity::Warning, block,
               numbered("#", n) +
                   " is read while the motion before it may still run; put a block that stops the "
                   "look-ahead before it (G53, M00)",
               at->column);
      }
      if (at->op == Op::Local && is_main && !context_.types.is_assigned(n) &&
          warned.insert(n).second) {
        report("never_assigned", Severity::Warning, block,
               numbered("#", n) + " is vacant: nothing assigns it", at->column);
      }
    }
  }

  void labels() {
    std::set<int> targets;
    for (const Block& block : program_.blocks) {
      const bool is_jump = block.kind == BlockKind::Goto || block.kind == BlockKind::IfGoto;
      if (is_jump && block.goto_code < 0) targets.insert(block.variable);
    }
    for (std::size_t i = 1; i < program_.labels.size(); ++i) {
      const int number = program_.labels[i].number;
      if (number != program_.labels[i - 1].number || !targets.contains(number)) continue;
      report("double_label", Severity::Warning,
             program_.blocks[static_cast<std::size_t>(program_.labels[i].block)],
             numbered("N", number) +
                 " stands twice; a GOTO goes to the next one, then to the first of the program");
    }
  }

  void reachability() {
    const std::size_t count = program_.blocks.size();
    std::vector<bool> reached(count, false);
    std::vector<std::size_t> open;
    const auto visit = [&](std::size_t block) {
      if (block < count && !reached[block]) {
        reached[block] = true;
        open.push_back(block);
      }
    };
    visit(0);
    if (context_.is_entered_by_label) {
      for (const Label& label : program_.labels) visit(static_cast<std::size_t>(label.block));
    }
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      follow(i, visit);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const bool begins = !reached[i] && (i == 0 || reached[i - 1]);
      if (begins && program_.blocks[i].kind != BlockKind::Empty) {
        report("unreachable", Severity::Warning, program_.blocks[i], "no way leads to this block");
      }
    }
  }

  template <class Visit>
  void follow(std::size_t i, const Visit& visit) const {
    const Block& block = program_.blocks[i];
    const auto target = static_cast<std::size_t>(std::max(block.target, 0));
    switch (block.kind) {
      case BlockKind::Goto:
        if (block.goto_code < 0 && block.target >= 0) visit(target);
        if (block.goto_code < 0) return;
        break;
      case BlockKind::IfGoto:
        if (block.target >= 0 && block.goto_code < 0) visit(target);
        break;
      case BlockKind::IfThen: visit(target); break;
      case BlockKind::While: visit(target + 1); break;
      case BlockKind::End: visit(target); return;
      case BlockKind::Nc:
        if (has_m(program_, block, 30) || has_m(program_, block, 2) || has_m(program_, block, 99)) {
          return;
        }
        break;
      default: break;
    }
    visit(i + 1);
  }

  const Program& program_;
  const Context& context_;
  std::vector<Finding>& findings_;
};

}  // namespace

std::vector<Finding> check(std::string text, const Profile& profile,
                           const std::function<bool(int number)>& has_program) {
  const std::vector<Program> programs = compile(std::move(text), profile);
  const Context context(programs);
  std::vector<Finding> findings;
  for (const Program& program : programs) {
    ProgramCheck(program, context, findings).run(has_program);
  }
  std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
    return std::pair(a.line, a.column) < std::pair(b.line, b.column);
  });
  return findings;
}

}  // namespace ridgeline::macro
