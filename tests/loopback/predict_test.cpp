#include <fstream>
#include <sstream>

#include "jobs/answer.hpp"
#include "service/library.hpp"
#include "service/library_job.hpp"
#include "tests/loopback/network.hpp"

namespace ridgeline {
namespace {

using client::Client;
using Json = nlohmann::json;

Json example(const std::string& name) {
  return Json::parse(std::ifstream(RIDGELINE_SOURCE "/clients/examples/" + name));
}

/// The result without what differs each time.
Json lasting(const jobs::Answer& answer) {
  Json document = jobs::assemble(answer);
  document.erase("solve_seconds");
  if (document.contains("report")) document["report"].erase("solve_seconds");
  return document;
}

/// Few coarse stations, so that the test is short; the arithmetic is the same.
Json coarse(Json job) {
  job["N"] = 256;
  job["nq"] = 64;
  job["stability_every"] = 20;
  return job;
}

class LoopbackPredict : public Loopback {
protected:
  void SetUp() override {
    service_ = start("north");
    client_ = std::make_unique<Client>(options());
    const std::string import =
        Json(
            {{"job", "library"}, {"operation", "import"}, {"definitions", example("library.json")}})
            .dump();
    ASSERT_EQ(code(client_->ask(import, "json")), "ok");
    service::answer_library(Json::parse(import), library_);
  }

  /// Answers of the service and of the same code in this process are the same; here it is.
  Json both(const Json& job, const char* format) {
    const jobs::Answer there = client_->ask(job.dump(), format);
    const jobs::Answer here = jobs::answer(job.dump(), format, library_);
    EXPECT_EQ(code(there), "ok") << there.document;
    EXPECT_TRUE(lasting(there) == lasting(here)) << job.dump().substr(0, 200);
    EXPECT_EQ(there.text, here.text);
    EXPECT_EQ(there.text.empty(), format == std::string("json"));
    return lasting(there);
  }

  /// The page is the same, or its refusal where no viewer was built.
  void same_page(const Json& job) {
    const jobs::Answer there = client_->ask(job.dump(), "html");
    const jobs::Answer here = jobs::answer(job.dump(), "html", library_);
    EXPECT_EQ(code(there), code(here)) << there.document;
    EXPECT_TRUE(there.text == here.text);
  }

  service::Library library_{":memory:"};
  std::unique_ptr<Process> service_;
  std::unique_ptr<Client> client_;
};

TEST_F(LoopbackPredict, OneEngagementAnswersTheOracleKeyForKey) {
  const Json oracle = Json::parse(
      std::ifstream(RIDGELINE_SOURCE "/tests/oracle/error/01-ball-down-milling-1-groove.json"));
  const Json answer = both({{"job", "predict"},
                            {"case", oracle.at("case")},
                            {"speed_rpm", oracle.at("speed_rpm")},
                            {"options", oracle.at("options")}},
                           "json");
  EXPECT_EQ(answer.at("F").size(), answer.at("D").size());
  same_page(example("predict/slope.json"));
}

TEST_F(LoopbackPredict, APathItsCorrectionAndItsProgramComeAsLocally) {
  Json job = coarse(example("predict/port.json"));
  job["along"]["tolerance"] = 0.05;
  both(job, "csv");
  same_page(job);
  job["correct"] = true;
  const Json answer = both(job, "json");
  EXPECT_EQ(answer.at("corrected").at("position").size(), answer.at("position").size());
  EXPECT_GT(answer.at("position").size(), 8u);
  both(job, "nc");
  job["along"]["spring_pass"] = true;
  job["dynamics"] = Json::parse(R"({"modes": [[2200, 0.03, 4000]]})");
  job["N"] = 512;  // so thin a cut takes more than the coarse ones
  job["nq"] = 128;
  EXPECT_EQ(both(job, "json").at("corrected").at("finish_shift").size(),
            answer.at("position").size());
  both(job, "nc");
}

TEST_F(LoopbackPredict, ATiltedProgramIsCorrectedAsLocally) {
  Json job = coarse(example("predict/program.json"));
  job["along"]["program"] =
      "%\nO1\nG90\nS8000 M3\nG54\nG68.2 X0. Y0. Z0. I90. J20. K-90.\nG53.1\nG0 Z20.\n"
      "G0 X9.44 Y8.\nG0 Z9.\nG1 Z3.308 F300.\nG1 Y12. F1600.\nG0 Z20.\nG69\nM30\n%\n";
  job["along"]["stock"]["cell"] = 0.2;
  job["along"]["step"] = 2;
  job["along"]["normal"] = {0, 0, 1};
  job["correct"] = true;
  EXPECT_GT(both(job, "json").at("corrected").at("report").at("stations_cutting"), 0);
  both(job, "nc");
}

TEST_F(LoopbackPredict, ARefusalKeepsItsCodeFieldAndLimit) {
  Json job = example("predict/slope.json");
  job["case"]["tool"]["r"] = -1;
  const Json there = client_->ask(job.dump(), "json").document;
  EXPECT_EQ(there, jobs::answer(job.dump(), "json", library_).document);
  EXPECT_EQ(there.at("error").at("field"), "/case/tool/r");
}

TEST_F(LoopbackPredict, ProgressIsToldAndACancelStopsTheWork) {
  Json job = example("predict/slope.json");
  job.erase("speed_rpm");
  job["speeds_rpm"] = {{"from", 1000}, {"to", 16000}, {"step", 1}};  // minutes of work
  job["method"] = "time_domain";
  std::stop_source stop;
  double fraction = -1;
  const jobs::Answer answer = client_->ask(job.dump(), "json",
                                           {.timeout = 60s,
                                            .progress =
                                                [&](const client::ProgressReport& report) {
                                                  fraction = report.fraction;
                                                  stop.request_stop();
                                                },
                                            .stop = stop.get_token()});
  EXPECT_EQ(code(answer), "cancelled");
  EXPECT_GE(fraction, 0);
  EXPECT_LT(fraction, 1);
  EXPECT_TRUE(eventually([&] { return client_->status(1s).at(0).running == 0; }));
}

}  // namespace
}  // namespace ridgeline
