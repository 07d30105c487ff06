// Any text as an NC program. The first byte chooses the dialect, or leaves it to be told.

#include "core/base/error.hpp"
#include "core/nc/reader.hpp"
#include "tests/fuzz/input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace ridgeline;
  fuzz::Input input(bytes, size);
  nc::ReadOptions options;
  const auto choice = input.number<std::uint8_t>();
  constexpr nc::Dialect dialects[] = {nc::Dialect::Fanuc, nc::Dialect::Siemens,
                                      nc::Dialect::Heidenhain, nc::Dialect::LinuxCnc};
  if (choice % 5 < 4) options.dialect = dialects[choice % 5];
  if (choice >= 128) options.start = Eigen::Vector3d::Zero();
  try {
    const nc::Reading reading = nc::read(input.rest(), options);
    if (reading.lines.size() != reading.motion.moves.size()) __builtin_trap();
  } catch (const Error&) {
    // Refused by name, as it should be.
  }
  return 0;
}
