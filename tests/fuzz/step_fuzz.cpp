// Changed STEP files: from the reader in its own process to the plan of what it finds. An input is
// a recipe: which part of tests/parts, then what to change in it and where, so that a few bytes
// make a file that is nearly sound. The reader may die of a file, and must then be named as what it
// is; under the sanitizers a fault of our own code ends it with a status in place of a signal.

#include <array>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>

#include "core/base/error.hpp"
#include "jobs/answer.hpp"
#include "jobs/step_reader.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ridgeline;
using Json = nlohmann::json;

constexpr std::array parts{"own_hard_shaft.step", "own_flanged_shaft.step", "own_cross_tube.step",
                           "own_manifold.step"};
constexpr std::array numbers{"0.", "-1.", "1.E30", "1.E-30", "1.E400", "25.0001", "", "-.", "12"};
constexpr std::array words{
    "CIRCLE",     "LINE",           "PLANE",        "CYLINDRICAL_SURFACE",
    "EDGE_CURVE", "ADVANCED_FACE",  "DIRECTION",    "TOROIDAL_SURFACE",
    "EDGE_LOOP",  "ORIENTED_EDGE",  "CLOSED_SHELL", "B_SPLINE_CURVE_WITH_KNOTS",
    "VECTOR",     "CARTESIAN_POINT"};
constexpr std::size_t most_changes = 12;

const std::string& file_of(std::size_t part) {
  static const auto texts = [] {
    std::array<std::string, parts.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i) {
      std::ifstream in(std::string(RIDGELINE_PARTS "/") + parts[i], std::ios::binary);
      all[i].assign(std::istreambuf_iterator<char>(in), {});
      if (all[i].empty()) std::abort();
    }
    return all;
  }();
  return texts[part % texts.size()];
}

/// The next piece of one kind of characters that begins with `first`, from `at` on.
struct Piece {
  std::size_t at = 0;
  std::size_t length = 0;
};
Piece next(const std::string& text, std::size_t at, std::string_view first, std::string_view more) {
  const std::size_t begin = text.find_first_of(first, at);
  if (begin == std::string::npos) return {at, 0};
  const std::size_t end = text.find_first_not_of(more, begin + 1);
  return {begin, std::min(end, text.size()) - begin};
}

constexpr std::string_view digits = "0123456789";
constexpr std::string_view capitals = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";

/// One entity with its number: from a line's "#" to its ";".
Piece entity(const std::string& text, std::size_t at) {
  const std::size_t begin = text.find("\n#", at);
  const std::size_t end = begin == std::string::npos ? begin : text.find(';', begin);
  if (end == std::string::npos) return {at, 0};
  return {begin + 1, end + 1 - (begin + 1)};
}

void change(std::string& text, fuzz::Input& input) {
  const auto kind = input.number<std::uint8_t>();
  const std::size_t at = input.number<std::uint32_t>() % std::max<std::size_t>(text.size(), 1);
  const auto value = input.number<std::uint16_t>();
  const auto replace = [&](const Piece& piece, std::string_view with) {
    text.replace(piece.at, piece.length, with);
  };
  switch (kind % 9) {
    case 0: replace({at, 1}, std::string(1, static_cast<char>(value))); break;
    case 1:
      replace(next(text, at, "-0123456789", "0123456789.E+-"), numbers[value % numbers.size()]);
      break;
    case 2: replace(next(text, at, "#", digits), "#" + std::to_string(value % 2000)); break;
    case 3: replace(entity(text, at), ""); break;
    case 4: {
      const Piece other = entity(text, value * 16U % text.size());
      const std::string body = text.substr(other.at, other.length);
      const Piece here = entity(text, at);
      const std::size_t is = text.find('=', here.at);
      if (here.length == 0 || is >= here.at + here.length || body.find('=') == body.npos) break;
      replace({is, here.at + here.length - is}, body.substr(body.find('=')));
      break;
    }
    case 5: replace({at, std::min<std::size_t>(value % 64, text.size() - at)}, ""); break;
    case 6:
      replace(next(text, at, capitals, std::string(capitals) + "_"), words[value % words.size()]);
      break;
    case 7: {
      const std::size_t flag = text.find(".T.", at);
      if (flag != std::string::npos) replace({flag, 3}, value % 2 == 0 ? ".F." : ".U.");
      break;
    }
    default:
      if (value % 16 == 0) text.resize(at);
      break;
  }
}

/// Told at the end: a run in which everything is refused, or nothing, tries little.
struct Tally {
  int files = 0;
  int refused = 0;
  ~Tally() { std::cerr << files << " files, " << refused << " refused by name\n"; }
} tally;

[[noreturn]] void fail(const Json& answer) {
  std::cerr << "answered with " << answer.dump().substr(0, 2000) << '\n';
  std::abort();
}

/// The document, or nothing where the file was refused by name.
Json reading(const Json& wish, const std::string& file) {
  const jobs::ReaderLimits limits{.seconds = 6, .gigabytes = 2};
  Json document;
  try {
    document = jobs::read_step_file(wish, file, {}, limits);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::BadFile) fail(error.what());
    return {};
  }
  if (!document.contains("error")) return document;
  for (const char* code : {"bad_file", "not_turned", "several_solids", "absurd_size"})
    if (document["error"]["code"] == code) return {};
  fail(document);
}

/// For the reader, where it is built with the sanitizers: faults of Open CASCADE stay signals.
const int is_reader_set =
    ::setenv("ASAN_OPTIONS",
             "handle_segv=0:handle_abort=0:handle_sigfpe=0:handle_sigbus=0:handle_sigill=0:"
             "allocator_may_return_null=1:soft_rss_limit_mb=2500:detect_leaks=0",
             1);

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  fuzz::Input input(bytes, size);
  std::string file = file_of(input.number<std::uint8_t>());
  for (std::size_t i = 0; i < most_changes && !input.is_empty() && !file.empty(); ++i)
    change(file, input);
  ++tally.files;
  if (const Json found = reading({{"want", "product"}}, file); !found.is_null()) {
    const Json job = {{"job", "units"}, {"product", found.at("product")}};
    const jobs::Answer answer = jobs::answer(job.dump(), "json", jobs::NoDefinitions());
    const Json error = answer.document.value("error", Json::object());
    if (error.value("code", "") == "internal") fail(answer.document);
  } else {
    ++tally.refused;
  }
  reading({{"want", "mouths"}}, file);
  return 0;
}
