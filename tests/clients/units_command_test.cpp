#include <gtest/gtest.h>

#include <filesystem>

#include "tests/clients/process.hpp"

namespace ridgeline::tests {
namespace {

using Json = nlohmann::json;

Finished units(std::vector<std::string> arguments, const std::string& in = {}) {
  arguments.insert(arguments.begin(), "units");
  arguments.emplace_back("--local");
  return ridgeline(arguments, in);
}

// The walk of docs/units.md, on its example files.
TEST(UnitsCommand, PlansShowsEditsUndoesAndWrites) {
  const TemporaryFolder folder;
  const std::string program = folder.file("program.json");
  const Finished planned = units({"plan", "clients/examples/units_shaft.json", "-o", program});
  ASSERT_EQ(planned.status, 0) << planned.err;
  const Finished tree = units({"show", program});
  EXPECT_NE(tree.out.find("process 2 (sub spindle)"), std::string::npos) << tree.out;
  EXPECT_NE(units({"show", program, "--format", "svg"}).out.find("<svg"), std::string::npos);
  const std::string longer = folder.file("longer.json");
  const Finished edited =
      units({"edit", program, "clients/examples/units_longer_bore.json", "-o", longer});
  ASSERT_EQ(edited.status, 0) << edited.err;
  int kept = 0;
  const Json longer_program = Json::parse(read(longer));
  for (const Json& unit : longer_program.at("units")) kept += unit["state"] == "kept";
  EXPECT_EQ(kept, 19);
  const Finished undone = units({"edit", longer, "--undo", "1"});
  EXPECT_EQ(undone.json().at("units"), Json::parse(read(program)).at("units"));
  const Finished nc = units({"nc", longer});
  ASSERT_EQ(nc.status, 0) << nc.err;
  EXPECT_NE(nc.out.find("O0002"), std::string::npos);
  EXPECT_EQ(units({"nc", longer, "--dialect", "linuxcnc"}).status, 1);
  EXPECT_EQ(units({"nc", longer, "--dialect", "linuxcnc", "--process", "2"}).status, 0);
}

TEST(UnitsCommand, FilesThatAreNoneAreToldApartFromJobsThatAreRefused) {
  const TemporaryFolder folder;
  const std::string step = folder.write("part.step", "solid\n");
  const std::string job = folder.write("job.json", R"({"job": "units", "product": "part.step"})");
  const Finished refused = units({"plan", job});
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.json().at("error").at("code"), "bad_file");
  EXPECT_EQ(units({"plan", folder.file("none.json")}).status, 2);
  const Finished gone = units({"plan", "-"}, R"({"job": "units", "product": "nowhere/part.step"})");
  EXPECT_EQ(gone.status, 2);
  EXPECT_EQ(gone.json().at("error").at("code"), "bad_file");
  EXPECT_EQ(units({"plan", "-"}, R"({"job": "units", "product": "shaft-7"})")
                .json()
                .at("error")
                .at("code"),
            "unknown_definition");
}

// The libraries of Open CASCADE cost every start 35 ms: only the reader links them.
TEST(UnitsCommand, TheReaderOfStepFilesIsAProgramOfItsOwn) {
  const std::string program = read(RIDGELINE_COMMAND);
  EXPECT_EQ(program.find("libTKernel.so"), std::string::npos);
  const std::string reader = std::filesystem::path(RIDGELINE_COMMAND).parent_path() /
                             "../../libexec/ridgeline/ridgeline-step";
  EXPECT_NE(read(reader).find("libTKernel.so"), std::string::npos);
}

TEST(UnitsCommand, ReadsStepFilesWhereItIsInstalledAndSaysWhatIsMissing) {
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  fs::create_directories(folder.file("bin"));
  fs::create_directories(folder.file("libexec/ridgeline"));
  const std::string moved = folder.file("bin/ridgeline");
  fs::copy_file(RIDGELINE_COMMAND, moved);
  const std::vector<std::string> plan = {"units", "plan", "-", "--local"};
  const std::string job = R"({"job": "units", "product": "tests/parts/own_hard_shaft.step"})";
  const Finished without = run(moved, plan, job);
  EXPECT_EQ(without.status, 2);
  EXPECT_EQ(without.json().at("error").at("code"), "storage");
  EXPECT_NE(without.err.find("libexec/ridgeline/ridgeline-step"), std::string::npos) << without.err;
  fs::copy_file(
      fs::path(RIDGELINE_COMMAND).parent_path() / "../../libexec/ridgeline/ridgeline-step",
      folder.file("libexec/ridgeline/ridgeline-step"));
  const Finished with = run(moved, plan, job);
  EXPECT_EQ(with.status, 0) << with.err;
}

TEST(UnitsCommand, HoleEdgesOfAPartBecomeWorkpiecesAndJobs) {
  const TemporaryFolder folder;
  const std::string library = folder.file("library.db");
  const std::string part = "tests/parts/own_cross_tube.step";
  const Finished imported = ridgeline({"library", "import", part, "--local", "--library", library});
  ASSERT_EQ(imported.status, 0) << imported.out << imported.err;
  EXPECT_EQ(imported.json().at("new"), 2);  // the tube and the part
  const Finished by_name = ridgeline({"units", "plan", "-", "--local", "--library", library},
                                     R"({"job": "units", "product": "own_cross_tube"})");
  EXPECT_EQ(by_name.status, 0) << by_name.out;
  EXPECT_EQ(by_name.json().at("units").size(), 15u);
  ridgeline({"library", "put", "-", "--local", "--library", library},
            R"({"kind": "tool", "number": 12, "name": "lollipop 4", "shape": "lollipop",
                "radius": 2, "neck_radius": 1, "neck_length": 60, "shank_radius": 1.5})");
  const Finished found = ridgeline(
      {"units", "holes", part, "--tool", "12", "--width", "0.2", "--local", "--library", library});
  ASSERT_EQ(found.status, 0) << found.out << found.err;
  const Json result = found.json();
  ASSERT_FALSE(result.at("workpieces").empty()) << found.out;
  const Json& tube = result.at("workpieces").at(0);
  EXPECT_NEAR(tube["inner_radius"].get<double>(), 25, 5e-5);
  EXPECT_NEAR(tube["outer_radius"].get<double>(), 40, 5e-5);
  EXPECT_GE(tube["holes"].size(), 7u);
  EXPECT_EQ(result["jobs"].size(), result["edges"].size());
  for (const Json& left : result["unnamed"]) EXPECT_FALSE(left["why"].get<std::string>().empty());
  int done = 0;
  for (const Json& job : result["jobs"]) {
    const Finished chamfered =
        ridgeline({"chamfer", "-", "--local", "--library", library}, job.dump());
    done += chamfered.status == 0;
    if (chamfered.status != 0) {  // what a tool cannot do is told by name
      EXPECT_EQ(chamfered.status, 1);
      EXPECT_NE(chamfered.json().at("error").at("code"), "internal");
      EXPECT_NE(chamfered.json().at("error").at("code"), "bad_input");
    }
  }
  EXPECT_GE(done, 3);
}

}  // namespace
}  // namespace ridgeline::tests
