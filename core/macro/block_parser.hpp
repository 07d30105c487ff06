#pragma once

#include <cstdint>

#include "core/macro/expression_parser.hpp"
#include "core/macro/line_reader.hpp"
#include "core/macro/program.hpp"

namespace ridgeline::macro {

/// Reads one block (a line, or the part of it up to ;) into a Program: lexical rules and statements
/// of design sections 2.1 and 2.4.
class BlockParser {
public:
  BlockParser(LineReader& line, Program& program, const Profile& profile)
      : line_(line), program_(program), expression_(line, program, profile), profile_(profile) {}

  /// Appends one block, two or more for IF..THEN, none for a line without content. A block that
  /// cannot be read becomes Faulty.
  void parse(Block block);

private:
  void head(Block& block);
  void skip_mark(Block& block);
  std::int32_t sequence_number();
  void statement(Block& block);
  void keyword(Block& block);
  void finish(const Block& block);
  [[noreturn]] void leftover();
  void assignment(Block& block);
  void conditional(Block& block);
  void consequence(Block& then);
  void loop(Block& block, BlockKind kind);
  std::int32_t loop_number();
  void jump(Block& block, BlockKind kind);
  void print(Block& block);
  void names(Block& block);
  int print_format();
  void nc(Block& block);
  void classify(Block& block, const Word& word) const;
  Word word();
  void literal(Word& word);

  LineReader& line_;
  Program& program_;
  ExpressionParser expression_;
  const Profile& profile_;
  int conditions_ = 0;  ///< IF of this block
};

}  // namespace ridgeline::macro
