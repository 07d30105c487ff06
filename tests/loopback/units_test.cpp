#include <fstream>
#include <sstream>

#include "jobs/answer.hpp"
#include "tests/loopback/network.hpp"

namespace ridgeline {
namespace {

using client::Client;
using Json = nlohmann::json;

std::string part(const std::string& name) {
  std::ifstream in(RIDGELINE_TESTS "/parts/" + name, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST_F(Loopback, TurningProgramsArePlannedEditedAndWrittenAsLocally) {
  const auto service = start("north");
  Client client(options());
  const auto both = [&](const Json& job) {
    const Json local = jobs::assemble(jobs::answer(job.dump(), "json", jobs::NoDefinitions()));
    const Json remote = jobs::assemble(client.ask(job.dump(), "json"));
    EXPECT_EQ(remote, local);
    return remote;
  };
  const Json program = both({{"job", "units"}, {"product_step", part("own_flanged_shaft.step")}});
  ASSERT_EQ(program["status"], "ok") << program.dump().substr(0, 400);
  EXPECT_EQ(program["units"].size(), 24u);
  const std::string show =
      Json({{"job", "units"}, {"operation", "show"}, {"program", program}}).dump();
  EXPECT_TRUE(client.ask(show, "html").text ==
              jobs::answer(show, "html", jobs::NoDefinitions()).text);
  const Json after = both({{"job", "units"},
                           {"operation", "edit"},
                           {"program", program},
                           {"edits", {{{"unit", 3}, {"set", {{"shape/2/end", {12, 125}}}}}}}});
  EXPECT_EQ(after["revision"], 1);
  const Json nc = both({{"job", "units"}, {"operation", "nc"}, {"program", after}});
  EXPECT_EQ(nc["programs"].size(), 2u);
}

// A line without its point: Open CASCADE 7.6 takes it for one and faults.
TEST_F(Loopback, AFileThatKillsTheTranslatorDoesNotKillTheService) {
  const auto service = start("north");
  Client client(options());
  std::string text = part("own_hard_shaft.step");
  const std::size_t line = text.find("= LINE('',#");
  ASSERT_NE(line, std::string::npos);
  text.replace(line + 10, text.find(',', line + 10) - line - 10, "#2");
  const Json broken = {{"job", "units"}, {"product_step", text}};
  EXPECT_EQ(code(client.ask(broken.dump(), "json")), "bad_file");
  const Json sound = {{"job", "units"}, {"product_step", part("own_hard_shaft.step")}};
  EXPECT_EQ(code(client.ask(sound.dump(), "json")), "ok");
}

TEST_F(Loopback, TheServiceOpensNoPathOfAClient) {
  const auto service = start("north");
  Client client(options());
  EXPECT_EQ(code(client.ask(R"({"job": "units", "product": "/etc/passwd"})", "json")),
            "unknown_definition");
}

}  // namespace
}  // namespace ridgeline
