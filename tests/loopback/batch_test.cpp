// `ridgeline batch` over several instances: it survives the loss of one, and goes on where it
// stopped.

#include <csignal>
#include <fstream>

#include "tests/loopback/network.hpp"

namespace ridgeline {
namespace {

namespace fs = std::filesystem;

constexpr int count = 12;

class LoopbackBatch : public Loopback {
protected:
  void SetUp() override {
    fs::create_directory(folder_ / "jobs");
    for (int i = 0; i < count; ++i) {
      const nlohmann::json job = {
          {"job", "chamfer"},
          {"hole", "H1"},
          {"edge", "inner"},
          {"width", 0.3 + 0.01 * i},
          {"points", 3'000},
          {"workpiece",
           {{"shape", "thick_walled_cylinder"},
            {"inner_radius", 20},
            {"outer_radius", 30},
            {"length", 100},
            {"holes", {{{"name", "H1"}, {"shape", "circle"}, {"radius", 5}}}}}},
          {"tool", {{"number", 1}, {"shape", "ball"}, {"radius", 3}}}};
      std::ofstream(job_file(i)) << job;
    }
  }
  fs::path job_file(int i) const { return folder_ / "jobs" / (std::to_string(i) + ".json"); }
  fs::path result(int i) const { return folder_ / "out" / (std::to_string(i) + ".nc"); }
  int results() const {
    int found = 0;
    for (int i = 0; i < count; ++i) found += fs::exists(result(i)) ? 1 : 0;
    return found;
  }
  std::unique_ptr<Process> batch(std::vector<std::string> more = {}) const {
    std::vector<std::string> command = {"/bin/sh",
                                        "-c",
                                        "exec \"$@\" >" + (folder_ / "report").string(),
                                        "sh",
                                        RIDGELINE,
                                        "--domain",
                                        std::to_string(domain_),
                                        "--timeout",
                                        "60",
                                        "--quiet",
                                        "batch",
                                        "--format",
                                        "nc",
                                        "-o",
                                        (folder_ / "out").string()};
    command.insert(command.end(), more.begin(), more.end());
    for (int i = 0; i < count; ++i) command.push_back(job_file(i).string());
    return std::make_unique<Process>(command, folder_ / "batch.log");
  }
  nlohmann::json report() const { return nlohmann::json::parse(std::ifstream(folder_ / "report")); }
  int earlier() const {
    int found = 0;
    const nlohmann::json whole = report();
    for (const auto& job : whole.at("jobs")) found += job.contains("earlier") ? 1 : 0;
    return found;
  }
  int computed(const std::string& instance) const {
    int found = 0;
    for (const auto& each : events(instance, "request"))
      found += each.at("operation") == "chamfer" ? 1 : 0;
    return found;
  }
};

TEST_F(LoopbackBatch, KeepsAllInstancesBusyAndLosesNothingWhenOneDies) {
  const auto north = start("north"), south = start("south");
  client::Client client(options());
  ASSERT_TRUE(eventually([&] { return client.status(1s).size() == 2; }));
  const auto run = batch();
  ASSERT_TRUE(eventually([&] { return computed("south") >= 1; }, 60s));
  south->signal(SIGKILL);
  ASSERT_EQ(run->wait(120s), 0);
  EXPECT_EQ(results(), count);
  EXPECT_GT(computed("north"), 2);
  EXPECT_EQ(report().at("status"), "ok");
  EXPECT_EQ(report().at("jobs").size(), std::size_t{count});
}

TEST_F(LoopbackBatch, GoesOnWhereItStopped) {
  const auto north = start("north");
  {
    const auto run = batch({"--at-once", "1"});
    ASSERT_TRUE(eventually([&] { return results() >= 3; }, 60s));
    run->signal(SIGINT);
    ASSERT_EQ(run->wait(60s), 130);
  }
  const int done = results();
  ASSERT_LT(done, count);
  ASSERT_EQ(batch()->wait(120s), 0);
  EXPECT_EQ(results(), count);
  EXPECT_EQ(earlier(), done);

  fs::remove(result(5));
  std::ofstream(job_file(7), std::ios::app) << "\n";  // another text: another job
  ASSERT_EQ(batch()->wait(120s), 0);
  EXPECT_EQ(earlier(), count - 2);
  EXPECT_EQ(results(), count);

  ASSERT_EQ(batch({"--again"})->wait(120s), 0);
  EXPECT_EQ(earlier(), 0);
}

}  // namespace
}  // namespace ridgeline
