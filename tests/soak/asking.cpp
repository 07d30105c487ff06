#include "tests/soak/asking.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <random>
#include <string>

#include "clients/client.hpp"

namespace ridgeline::soak {
namespace {

using namespace std::chrono_literals;

struct Request {
  std::string job;  ///< empty: an echo of `text`
  std::string text;
  std::string code = "ok";  ///< expected of an answer
};

std::string random_text(std::mt19937_64& random, std::size_t size) {
  std::string text = std::to_string(getpid()) + ":" + std::to_string(random()) + ":";
  while (text.size() < size) text += static_cast<char>('a' + random() % 26);
  return text;
}

/// Mostly echoes of all sizes, some jobs, some that are refused.
Request request(std::mt19937_64& random) {
  const auto draw = random() % 100;
  if (draw < 60) return {"", random_text(random, random() % 2000), "ok"};
  if (draw < 65) return {"", random_text(random, 400'000), "ok"};
  if (draw < 85) {
    const double width = 0.2 + static_cast<double>(random() % 1000) / 2000;
    return {fmt::format(R"({{"job": "chamfer", "hole": "H1", "edge": "inner", "width": {},
      "points": 36, "workpiece": {{"shape": "thick_walled_cylinder", "inner_radius": 20,
      "outer_radius": 30, "length": 100, "holes": [{{"name": "H1", "shape": "circle",
      "radius": 5}}]}}, "tool": {{"number": 1, "shape": "ball", "radius": 3}}}})",
                        width),
            fmt::format("{}", width), "ok"};
  }
  if (draw < 95) return {R"({"job": "library", "operation": "list"})", "", "ok"};
  return {R"({"job": "no such job"})", "", "bad_input"};
}

std::string code_of(const jobs::Answer& answer) {
  return jobs::is_error(answer) ? answer.document.at("error").value("code", "") : "ok";
}

/// Is the answer that of the request? A named failure of the way is one too.
bool is_own(const Request& request, const jobs::Answer& answer) {
  const std::string code = code_of(answer);
  if (code == "timeout" || code == "no_service" || code == "busy") return true;
  if (code != request.code) return false;
  if (request.job.empty()) return answer.text == request.text;
  if (request.job.find("chamfer") != std::string::npos)
    return fmt::format("{}", answer.document.at("width").get<double>()) == request.text;
  return true;
}

void tell(const std::string& line) {
  const std::string whole = line + '\n';  // one write, so that lines of many clients stay whole
  if (write(STDOUT_FILENO, whole.data(), whole.size()) < 0) _exit(1);
}

}  // namespace

int ask(unsigned domain, std::uint64_t seed, int count, double timeout) {
  std::mt19937_64 random(seed);
  client::Options options;
  options.domain = domain;
  options.discovery = 20s;
  options.absence = 20s;
  client::Client client(options);
  const client::Patience patience{
      .timeout = std::chrono::milliseconds(static_cast<int>(timeout * 1000)),
      .progress = {},
      .stop = {}};
  for (int i = 1; i <= count; ++i) {
    const Request asked = request(random);
    tell(fmt::format("begin {} {}", seed, i));
    const jobs::Answer answer = asked.job.empty() ? client.echo(asked.text, patience)
                                                  : client.ask(asked.job, "json", patience);
    tell(fmt::format("end {} {} {}", seed, i, is_own(asked, answer) ? code_of(answer) : "foreign"));
  }
  return 0;
}

}  // namespace ridgeline::soak
