#include <gtest/gtest.h>

#include <cmath>

#include "tests/clients/process.hpp"

namespace ridgeline::tests {
namespace {

using Json = nlohmann::json;

// The shop of the examples, in a file of its own.
struct Shop {
  TemporaryFolder folder;
  std::string library = folder.file("library.db");
  Shop() {
    const Finished imported = ridgeline(
        {"library", "import", "clients/examples/library.json", "--local", "--library", library});
    EXPECT_EQ(imported.status, 0) << imported.err;
  }
  Finished predict(const std::string& job, std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {"predict", job, "--local", "--quiet", "--library", library});
    return ridgeline(options);
  }
};

std::string example(const std::string& name) {
  return "clients/examples/predict/" + name + ".json";
}

// An example as it is but for a coarser step of its numbers, to be quick.
std::string coarse(const Shop& shop, const std::string& name) {
  Json job = Json::parse(read(example(name)));
  if (job.contains("along")) job.update({{"N", 256}, {"nq", 64}, {"stability", "none"}});
  if (name == "port") job["along"]["points"] = 8;
  if (name == "cycle") job["along"]["stock"]["cell"] = 0.2;
  return shop.folder.write(name + ".json", job.dump());
}

TEST(Predict, EveryExample) {
  const Shop shop;
  for (const char* name : {"slope", "port", "program", "cycle"}) {
    SCOPED_TRACE(name);
    const Finished result = shop.predict(coarse(shop, name));
    ASSERT_EQ(result.status, 0) << result.out.substr(0, 1000) << result.err;
    EXPECT_EQ(result.json().at("status"), "ok");
  }
}

TEST(Predict, EveryFormat) {
  const Shop shop;
  for (const char* name : {"slope", "port"}) {
    const std::string job = coarse(shop, name);
    EXPECT_NE(shop.predict(job, {"--format", "svg"}).out.find("<svg"), std::string::npos);
    EXPECT_NE(shop.predict(job, {"--format", "csv"}).out.find("_N,"), std::string::npos);
  }
}

// Over the speed the error swings by more than a rigid tool's would, and some speeds chatter.
TEST(Predict, SweepAndLobes) {
  const Shop shop;
  Json sweep = Json::parse(read(example("speeds")));
  sweep["case"]["N"] = 256;
  sweep["speeds_rpm"]["step"] = 3500;
  const Finished speeds = shop.predict(shop.folder.write("speeds.json", sweep.dump()));
  ASSERT_EQ(speeds.status, 0) << speeds.out << speeds.err;
  EXPECT_EQ(speeds.json().at("e_mm").size(), 5);
  Json lobes = Json::parse(read(example("lobes")));
  lobes["speeds_rpm"]["step"] = 12000;
  lobes["depths"]["steps"] = 4;
  const Finished limits = shop.predict(shop.folder.write("lobes.json", lobes.dump()));
  ASSERT_EQ(limits.status, 0) << limits.out << limits.err;
  EXPECT_EQ(limits.json().at("depth_limit").size(), 3);
}

TEST(Predict, CorrectWritesAProgramThatTheReaderTakes) {
  const Shop shop;
  const std::string program = shop.folder.file("O9201.nc");
  const Finished made =
      shop.predict(coarse(shop, "port"), {"--correct", "--format", "nc", "-o", program});
  ASSERT_EQ(made.status, 0) << made.out.substr(0, 1000) << made.err;
  EXPECT_EQ(made.out, "");
  EXPECT_NE(read(program).find("CORRECTED FOR TOOL DEFLECTION"), std::string::npos);
  // Cut by a tool that does not give way it is a little too wide: that is what the correction is.
  const std::string job =
      shop.folder.write("job.json", Json::parse(read(example("port"))).at("along").dump());
  const Finished verified =
      ridgeline({"verify", program, "--job", job, "--local", "--library", shop.library});
  const Json report = verified.json().at("report");
  EXPECT_GT(report.at("width_max").get<double>(), 0.2 * std::sqrt(2.0) + 0.002);
  EXPECT_LT(report.at("width_max").get<double>(), 0.2 * std::sqrt(2.0) + 0.05);
  EXPECT_GT(report.at("neck_clearance").get<double>(), 0);
}

// A path's own job stands for the prediction along it; its workpiece names the material.
TEST(Predict, TakesTheJobOfAPath) {
  const Shop shop;
  Json job = Json::parse(read(example("port"))).at("along");
  job["points"] = 4;
  job["feed"] = 2400;
  const Finished result = shop.predict(shop.folder.write("chamfer.json", job.dump()));
  ASSERT_EQ(result.status, 0) << result.out.substr(0, 1000) << result.err;
  EXPECT_EQ(result.json().at("material").at("name"), "S45C");
  EXPECT_EQ(result.json().at("along"), "chamfer");
}

TEST(Predict, RefusalsAreJsonAndExitStatusOne) {
  const Shop shop;
  const Finished no_program = shop.predict(example("port"), {"--format", "nc"});
  EXPECT_EQ(no_program.status, 1);
  EXPECT_EQ(no_program.json().at("error").at("code"), "unsupported");
  Json soft = Json::parse(read(example("port")));
  soft["dynamics"] = {{"modes", {{600, 0.03, 150}}}};
  soft["along"]["points"] = 4;
  soft.update({{"N", 256}, {"nq", 64}});
  const Finished chatters =
      shop.predict(shop.folder.write("soft.json", soft.dump()), {"--correct"});
  EXPECT_EQ(chatters.status, 1);
  EXPECT_EQ(chatters.json().at("error").at("code"), "not_converged");
  EXPECT_EQ(shop.predict(shop.folder.write("no.json", "{")).status, 2);
}

}  // namespace
}  // namespace ridgeline::tests
