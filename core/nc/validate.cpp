#include "core/nc/validate.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/base/error.hpp"
#include "core/nc/plan.hpp"

namespace ridgeline::nc {
namespace {

[[noreturn]] void refuse(const std::string& field, const std::string& value,
                         const std::string& limit) {
  throw Error(ErrorCode::BadInput, field.substr(1) + " " + value + ": must be " + limit,
              {field, value, limit, std::nullopt, std::nullopt});
}

void require_within(const std::string& field, int value, int low, int high) {
  if (value < low || value > high) {
    refuse(field, std::to_string(value), std::to_string(low) + " to " + std::to_string(high));
  }
}

/// The whole text as a number without sign.
std::optional<int> number_of(std::string_view text) {
  int number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = failure == std::errc{} && end == text.data() + text.size();
  return whole && text.front() != '-' ? std::optional(number) : std::nullopt;
}

/// Number after "G54" style prefixes: "G57" is 57, "G54.1 P12" is 12 after its prefix.
std::optional<int> number_after(std::string_view text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return std::nullopt;
  return number_of(text.substr(prefix.size()));
}

bool is_within(std::optional<int> number, int low, int high) {
  return number && *number >= low && *number <= high;
}

}  // namespace

WorkOffset work_offset(const Program& program) {
  const std::string_view name = program.work_offset;
  const std::optional<int> g = number_after(name, "G");
  const auto found = [&](bool known, const char* limit) {
    if (!known) refuse("/output/work_offset", program.work_offset, limit);
    return WorkOffset{program.work_offset};
  };
  switch (program.dialect) {
    case Dialect::Fanuc: {
      std::optional<int> extended = number_after(name, "G54.1 P");
      if (!extended) extended = number_after(name, "G54.1P");
      return found(is_within(g, 54, 59) || is_within(extended, 1, 300),
                   "G54 to G59 or G54.1 P1 to P300");
    }
    case Dialect::LinuxCnc:
      return found(is_within(g, 54, 59) || is_within(number_after(name, "G59."), 1, 3),
                   "G54 to G59 or G59.1 to G59.3");
    case Dialect::Siemens:
      return found(is_within(g, 54, 57) || is_within(g, 505, 599), "G54 to G57 or G505 to G599");
    case Dialect::Heidenhain: {
      const std::optional<int> datum = number_of(name.empty() ? "x" : name);
      found(is_within(g, 54, 59) || is_within(datum, 0, 254),
            "a datum number 0 to 254, or G54 to G59 for 1 to 6");
      return {std::to_string(datum ? *datum : *g - 53)};
    }
  }
  throw Error(ErrorCode::Internal, "dialect without a name");
}

void validate(const Program& program) {
  require_within("/output/decimals", program.decimals, 1, 6);
  require_within("/output/program", program.number, 1, 99'999'999);
  require_within("/tool/number", program.tool_number, 0, 99'999'999);
  require_within("/tool/length_offset", program.length_offset, 0, 9'999);
  if (program.block_number_step) {
    require_within("/output/block_number_step", *program.block_number_step, 1, 1000);
  }
  if (!(program.spindle_speed >= 0 && program.spindle_speed <= 999'999)) {
    refuse("/spindle_speed", std::to_string(program.spindle_speed), "0 to 999999 rev/min");
  }
  if (!program.work_offset.empty()) work_offset(program);
  const double length = program.tool_axis.norm();
  if (!(std::abs(length - 1) <= 1e-6)) {
    refuse("/tool_axis", "of length " + std::to_string(length), "a unit vector");
  }
  const bool has_inline = program.dialect == Dialect::Fanuc || program.dialect == Dialect::LinuxCnc;
  if (program.kind == ProgramKind::Inline && (is_tilted(program) || !has_inline)) {
    throw Error(ErrorCode::Unsupported,
                "motion within another program is for FANUC and LinuxCNC with a machine axis",
                {"/output/kind", "inline", "", std::nullopt, std::nullopt});
  }
  if (in_work_plane(program) && program.dialect == Dialect::LinuxCnc) {
    throw Error(ErrorCode::Unsupported,
                "LinuxCNC has no tilted work plane: ask for coordinates in the work frame or "
                "another dialect",
                {"/output/tilted", "", "", std::nullopt, std::nullopt});
  }
}

}  // namespace ridgeline::nc
