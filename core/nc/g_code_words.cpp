#include "core/nc/g_code_words.hpp"

#include <algorithm>
#include <array>

#include "core/nc/tilted_plane.hpp"

namespace ridgeline::nc {

bool is_harmless_g(int code, Block& block, Dialect dialect) {
  static constexpr std::array all{90, 150, 400, 500, 501, 531, 610, 611, 670, 940, 970, 980, 990};
  static constexpr std::array siemens{600, 6010, 6020, 6030, 6410, 6420};
  const auto takes = [&](std::string_view letters) {
    bool any = false;
    for (const char letter : letters) any = block.use(letter) != nullptr || any;
    return any;
  };
  switch (code) {
    case 40: return takes("PXU");
    case 50: return dialect == Dialect::Fanuc && takes("P");
    case 51: return takes("Q") && (takes("RP"), true);
    case 80: return takes("P");
    case 640: takes("PQ"); return true;
    default: break;
  }
  if (dialect == Dialect::Siemens && std::ranges::find(siemens, code) != siemens.end()) {
    return true;
  }
  return std::ranges::find(all, code) != all.end();
}

void refuse_g(int code, const Spot& spot) {
  switch (code) {
    case 410:
    case 420: spot.unsupported("the radius that the control would correct is not known");
    case 650:
    case 660: spot.unsupported("macro calls are for `ridgeline expand` or `macro run`");
    case 680: spot.unsupported("rotation of coordinates is not read");
    case 100:
    case 520:
    case 920: spot.unsupported("offsets that a program sets are not read");
    case 930:
    case 950: spot.unsupported("feeds are read in mm/min (G94) only");
    default: break;
  }
  if (code >= 730 && code <= 899) spot.unsupported("cycles are not read");
  spot.bad("this G code is not read");
}

bool is_harmless_name(std::string_view name) {
  static constexpr std::array<std::string_view, 12> names{
      "BRISK",  "SOFT", "DRIVE", "FFWON", "FFWOF", "COMPOF",
      "STOPRE", "CFC",  "CFTCP", "CFIN",  "MSG",   "$SC_TOOL_LENGTH_CONST"};
  return std::ranges::find(names, name) != names.end();
}

// CYCLE800(_FR, _TC, _ST, _MODE, X0, Y0, Z0, A, B, C, X1, Y1, Z1, ...)
SwivelPlane swivel_plane(const Name& name, const Spot& spot) {
  if (trimmed(name.arguments).empty()) return {};
  const std::vector<std::string> values = pieces(name.arguments);
  const auto value = [&](std::size_t n) {
    if (n >= values.size() || values[n].empty()) return Nano{0};
    std::string_view text = values[n];
    const std::optional<Nano> number = take_number(text);
    if (!number || !text.empty()) spot.bad(values[n] + " is not a number");
    return *number;
  };
  if (value(3) != 57 * nano) spot.unsupported("only mode 57 (A, B, C about X, Y, Z) is read");
  if (value(2) != 0) spot.unsupported("only a new plane is read, not one on top");
  if (value(10) != 0 || value(11) != 0 || value(12) != 0) {
    spot.unsupported("a shift after the turn is not read");
  }
  return {plane_of_swivel({real(value(7)), real(value(8)), real(value(9))}),
          {real(value(4)), real(value(5)), real(value(6))}};
}

}  // namespace ridgeline::nc
