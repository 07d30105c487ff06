// Macro programs and cycles over DDS: the answer of the service is the answer of the same code
// here.
#include "tests/loopback/network.hpp"

namespace ridgeline {
namespace {

using client::Client;
using Json = nlohmann::json;

TEST_F(Loopback, MacroProgramsAndCyclesAnswerAsLocally) {
  const auto service = start("north");
  Client client(options());
  const Json run = {{"job", "macro"},
                    {"program",
                     "O1\n#100=0\nWHILE[#100 LT 2000]DO1\nG01 X#100 Y[SIN[#100]] F100\n"
                     "#100=#100+1\nEND1\nG65 P9100 A2.\nM30\n"},
                    {"programs", {{"9100", "O9100\n#101=#1*2\nG02 X#1 Y0 R5000.\nM99\n"}}},
                    {"trace", true}};
  const Json alarm = {{"job", "macro"}, {"program", "O3\n#1=5/0\nM30\n"}};
  const Json check = {{"job", "macro"}, {"operation", "check"}, {"program", "GOTO 5\nM30\n"}};
  const Json cycle = {{"job", "cycle"},
                      {"family", "corner R circle"},
                      {"method", 2},
                      {"params", {{"D", 10}, {"r", 2}, {"R", 3}, {"R0", 20}, {"side", "outside"}}}};
  int compared_answers = 0;
  for (const Json& job : {run, alarm, check, cycle}) {
    for (const char* format : {"json", "nc", "csv", "svg", "trace", "text"}) {
      SCOPED_TRACE(job.dump().substr(0, 60) + format);
      const jobs::Answer there = client.ask(job.dump(), format);
      const jobs::Answer here = jobs::answer(job.dump(), format, jobs::NoDefinitions());
      EXPECT_EQ(jobs::to_json(there), jobs::to_json(here));
      EXPECT_EQ(there.text, here.text);
      ++compared_answers;
    }
  }
  EXPECT_EQ(compared_answers, 24);
  EXPECT_EQ(client.ask(alarm.dump(), "json").document.at("alarm").at("number"), 112);
}

// A program that would run for ever is stopped by its client.
TEST_F(Loopback, EndlessProgramsAreCancelled) {
  const auto service = start("north");
  Client client(options());
  ASSERT_EQ(code(client.echo("it is there")), "ok");
  const Json job = {
      {"job", "macro"}, {"program", "WHILE[1 EQ 1]DO1\nEND1\n"}, {"limits", {{"steps", 1e12}}}};
  const jobs::Answer answer =
      client.ask(job.dump(), "json", {.timeout = 500ms, .progress = {}, .stop = {}});
  EXPECT_EQ(code(answer), "timeout");
  EXPECT_EQ(code(client.ask(R"({"job": "macro", "program": "M30"})", "json")), "ok");
}

}  // namespace
}  // namespace ridgeline
