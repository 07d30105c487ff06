#include "core/nc/reader.hpp"

#include "core/nc/g_code_block.hpp"
#include "core/nc/tracer.hpp"

namespace ridgeline::nc {

Dialect dialect_of(std::string_view text, const Progress& progress) {
  std::size_t lines = 0;
  while (!text.empty()) {
    if (lines++ % 1024 == 0) progress.at(0, "dialect");
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.find("BEGIN PGM ") != line.npos) return Dialect::Heidenhain;
    if (line.starts_with("%_N_") || line.starts_with(";$PATH=")) return Dialect::Siemens;
    const std::string_view code = line.substr(0, std::min(line.find_first_of(";("), line.size()));
    for (const std::string_view word : {"CYCLE800", "TRAORI", "G710", "G500", "SUPA", "CR="}) {
      if (code.find(word) != code.npos) return Dialect::Siemens;
    }
    const bool is_o_word = line.starts_with("o<") || line.starts_with("O<");
    if (is_o_word || code.find("G91.1") != code.npos) return Dialect::LinuxCnc;
  }
  return Dialect::Fanuc;
}

Reading read(std::string_view program, const ReadOptions& options, const Progress& progress) {
  const Dialect dialect = options.dialect ? *options.dialect : dialect_of(program, progress);
  if (dialect == Dialect::Heidenhain) return read_klartext(program, options, progress);
  return read_g_code(program, dialect, options, progress);
}

}  // namespace ridgeline::nc
