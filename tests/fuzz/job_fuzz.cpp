// Any text as a job document, in any format: from the JSON reader to the answer. The first byte
// chooses the format. A job that computes for long is cancelled, and must heed that.

#include <array>
#include <chrono>
#include <cstdlib>
#include <iostream>

#include "jobs/answer.hpp"
#include "tests/fuzz/input.hpp"

namespace {

using namespace ridgeline;
using Clock = std::chrono::steady_clock;

constexpr std::array formats{"json", "nc", "cl", "csv", "svg", "html", "text", "trace"};
constexpr auto patience = std::chrono::milliseconds(50);

class Definitions : public jobs::Definitions {
public:
  std::optional<jobs::Definition> find(std::string_view kind, std::string_view) const override {
    static const auto workpiece = nlohmann::json::parse(R"({"kind": "workpiece", "name": "w",
      "shape": "thick_walled_cylinder", "inner_radius": 20, "outer_radius": 30, "length": 100,
      "holes": [{"name": "H1", "shape": "circle", "radius": 5}]})");
    static const auto tool = nlohmann::json::parse(
        R"({"kind": "tool", "number": 12, "name": "t", "shape": "ball", "radius": 3})");
    if (kind == "workpiece") return jobs::Definition{workpiece, 1};
    if (kind == "tool") return jobs::Definition{tool, 1};
    return {};
  }
  std::vector<std::string> names(std::string_view) const override { return {"w", "t"}; }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  fuzz::Input input(bytes, size);
  const char* format = formats[input.number<std::uint8_t>() % formats.size()];
  std::stop_source stop;
  const auto end = Clock::now() + patience;
  const Progress progress{.report =
                              [&](double, std::string_view) {
                                if (Clock::now() > end) stop.request_stop();
                              },
                          .stop = stop.get_token()};
  const std::string job = input.rest();
  const jobs::Answer answer = jobs::answer(job, format, Definitions(), progress);
  const std::string text = jobs::to_json(answer);
  const bool is_whole =
      answer.document.is_object() && answer.document.contains("status") && !text.empty();
  const bool is_internal =
      jobs::is_error(answer) && answer.document["error"].value("code", "") == "internal";
  if (is_whole && !is_internal) return 0;
  std::cerr << "answered with " << answer.document << '\n';
  std::abort();
}
