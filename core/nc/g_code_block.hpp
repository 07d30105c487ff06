#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/nc/tracer.hpp"

namespace ridgeline::nc {

/// A letter with its number.
struct Word {
  char letter = 0;
  Nano value = 0;
  std::string text;
  bool used = false;  ///< something acted on it
};

/// A name of Siemens with what follows it: CYCLE800(...), CR=5, TRAORI.
struct Name {
  std::string name;  ///< upper case
  std::string arguments;
  std::string text;
};

/// One block of G code, comments gone.
struct Block {
  Spot spot;  ///< word: the whole block
  std::vector<Word> words;
  std::vector<Name> names;  ///< Siemens only

  /// The word of a letter, now marked as used; nullptr when there is none or something else used
  /// it. Two of them are an error.
  Word* use(char letter);
  bool has(char letter) const;
};

/// Takes a line apart. Throws Error{BadFile} for what is not a word.
Block block_of(std::string_view line, int number, Dialect dialect);

char upper_case(char c);
bool is_letter(char c);
std::string_view trimmed(std::string_view text);

/// How much of a text of `size` bytes is read when `rest` is left of it.
inline double read_share(std::string_view rest, std::size_t size) {
  return 1 - static_cast<double>(rest.size()) / static_cast<double>(size);
}

/// "a, b,c" in pieces without the blanks around them.
std::vector<std::string> pieces(std::string_view text);

}  // namespace ridgeline::nc
