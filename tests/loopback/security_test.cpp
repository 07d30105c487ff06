#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "idl/domain.hpp"
#include "tests/loopback/network.hpp"

namespace ridgeline {
namespace {

using client::Client;

constexpr char put_tool[] = R"({"job": "library", "operation": "put", "definition":
  {"kind": "tool", "number": 12, "name": "b6", "shape": "ball", "radius": 3}})";

/// A secured service, and identities to take on one after the other.
class LoopbackSecurity : public Loopback {
protected:
  void SetUp() override {
    make("pki",
         {{"north", "service"}, {"olga", "operator"}, {"emil", "engineer"}, {"mia", "monitor"}});
    be("north");
    service_ = start("north");
    setenv("CYCLONEDDS_URI", "", 1);
    dds_set_log_sink([](void*, const dds_log_data_t*) {}, nullptr);  // it warns of what we try
  }
  void TearDown() override {
    unsetenv("CYCLONEDDS_URI");
    unsetenv("RIDGELINE_CLIENT");
  }
  void make(const std::string& pki, const std::map<std::string, std::string>& roles) {
    const std::string folder = (folder_ / pki).string();
    const auto run = [&](std::vector<std::string> arguments) {
      arguments.insert(arguments.begin(), RIDGELINE_SOURCE "/scripts/security");
      arguments.insert(arguments.begin(), {"/bin/sh", "-c", "exec \"$@\" >/dev/null", "sh"});
      return Process(arguments, folder_ / "security.log").wait(30s);
    };
    ASSERT_EQ(run({"init", folder}), 0);
    for (const auto& [name, role] : roles) ASSERT_EQ(run({"add", folder, role, name}), 0);
  }
  /// The next domain that this process enters is entered with that identity.
  void be(const std::string& name, const std::string& pki = "pki") {
    const std::string uri = "file://" RIDGELINE_SOURCE "/service/config/loopback.xml,file://" +
                            (folder_ / pki / name / "cyclonedds.xml").string();
    setenv("CYCLONEDDS_URI", uri.c_str(), 1);
    setenv("RIDGELINE_CLIENT", name.c_str(), 1);
  }
  jobs::Answer ask(const char* job) {
    return Client(options()).ask(job, "json", {.timeout = 10s, .progress = {}, .stop = {}});
  }

  std::unique_ptr<Process> service_;
};

TEST_F(LoopbackSecurity, EachRoleMayWhatItMayAndNoMore) {
  be("olga");
  EXPECT_EQ(code(ask(list)), "ok");
  const jobs::Answer refused = ask(put_tool);
  EXPECT_EQ(code(refused), "unsupported") << refused.document;
  EXPECT_NE(refused.document.dump().find("permissions"), std::string::npos);
  be("emil");
  EXPECT_EQ(code(ask(put_tool)), "ok");
  EXPECT_EQ(ask(list).document.at("definitions").size(), 1u);
  be("mia");
  {
    Client monitor(options());
    EXPECT_EQ(monitor.status(5s).size(), 1u);
    EXPECT_EQ(code(monitor.echo("x")), "unsupported");
  }
}

TEST_F(LoopbackSecurity, WithoutAnIdentityOfItsOwnNobodySeesAnything) {
  setenv("CYCLONEDDS_URI", "", 1);  // the built-in configuration, without security
  setenv("RIDGELINE_CLIENT", "olga", 1);
  {
    Client stranger(options());
    EXPECT_TRUE(stranger.status(500ms).empty());
    EXPECT_EQ(code(stranger.ask(list, "json")), "no_service");
  }
  make("rogue", {{"olga", "engineer"}});  // the same names, other authorities
  be("olga", "rogue");
  {
    Client rogue(options());
    EXPECT_TRUE(rogue.status(500ms).empty());
    EXPECT_EQ(code(rogue.ask(put_tool, "json")), "no_service");
  }
  be("olga");
  EXPECT_TRUE(ask(list).document.at("definitions").empty());
}

TEST_F(LoopbackSecurity, ATrueIdentityWithRightsOfItsOwnMakingIsRefused) {
  make("forged", {{"olga", "engineer"}});
  const auto file = folder_ / "pki/olga/cyclonedds.xml";
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::string configuration = text.str();
  int count = 0;  // her identity as it was made, but rights that she signed herself
  for (const char* name : {"permissions_ca.pem", "governance.p7s", "permissions.p7s"}) {
    const std::string own = "pki/olga/" + std::string(name);
    if (const auto at = configuration.find(own); at != configuration.npos)
      ++count, configuration.replace(at, 3, "forged");
  }
  ASSERT_EQ(count, 3) << configuration;
  std::ofstream(file) << configuration;
  be("olga");
  {
    Client forger(options());
    EXPECT_TRUE(forger.status(1s).empty());
    EXPECT_EQ(code(forger.ask(put_tool, "json")), "no_service");
  }
  be("emil");
  EXPECT_TRUE(ask(list).document.at("definitions").empty());
}

TEST_F(LoopbackSecurity, NobodyReadsTheRepliesOfAnother) {
  be("olga");
  setenv("RIDGELINE_CLIENT", "emil", 1);  // olga's certificate, emil's partition
  const jobs::Answer answer = ask(list);
  EXPECT_EQ(code(answer), "unsupported") << answer.document;
}

}  // namespace
}  // namespace ridgeline
