#include <gtest/gtest.h>

#include "tests/clients/process.hpp"

namespace ridgeline::tests {
namespace {

constexpr int usage = 2;

std::string code_of(const Finished& finished) {
  return finished.json().at("error").at("code").get<std::string>();
}

TEST(Command, HelpGoesToStandardOutput) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"chamfer", "--help"},
                                                    {"verify", "--help"},
                                                    {"library", "--help"}}) {
    const Finished finished = ridgeline(arguments);
    EXPECT_EQ(finished.status, 0);
    EXPECT_NE(finished.out.find("Usage: ridgeline"), std::string::npos) << finished.out;
    EXPECT_EQ(finished.err, "");
  }
}

TEST(Command, WrongUsageLeavesStandardOutputEmpty) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                    {"camfer"},
                                                    {"chamfer"},
                                                    {"chamfer", "-", "--fromat", "nc"},
                                                    {"chamfer", "-", "--format", "pdf"},
                                                    {"chamfer", "-", "--timeout", "-1"},
                                                    {"chamfer", "-", "--domain", "x"},
                                                    {"verify", "p.nc"},
                                                    {"library"},
                                                    {"library", "get", "tool"},
                                                    {"chamfer", "-", "--library", "x.db"}}) {
    const Finished finished = ridgeline(arguments);
    EXPECT_EQ(finished.status, usage) << testing::PrintToString(arguments);
    EXPECT_EQ(finished.out, "") << testing::PrintToString(arguments);
    EXPECT_NE(finished.err, "") << testing::PrintToString(arguments);
  }
}

TEST(Command, FilesThatCannotBeReadAreAnErrorObjectAndStatus2) {
  const TemporaryFolder folder;
  for (const std::string& path : {folder.file("absent.json"), folder.file("")}) {
    const Finished finished = ridgeline({"chamfer", path, "--local"});
    EXPECT_EQ(finished.status, usage);
    EXPECT_EQ(code_of(finished), "bad_file");
    EXPECT_NE(finished.err.find("cannot read"), std::string::npos);
  }
}

TEST(Command, TextThatIsNotJsonIsAnErrorObjectAndStatus2) {
  for (const char* text : {"", "%\nO9101\n", "{\"job\":", "{\"a\": NaN}"}) {
    const Finished finished = ridgeline({"chamfer", "-", "--local"}, text);
    EXPECT_EQ(finished.status, usage) << text;
    EXPECT_EQ(code_of(finished), "bad_input") << text;
  }
}

TEST(Command, DocumentsOf50MegabytesAreAnErrorObjectAndStatus2) {
  const Finished finished =
      ridgeline({"chamfer", "-", "--local"}, "[" + std::string(50'000'000, ' ') + "]");
  EXPECT_EQ(finished.status, usage);
  EXPECT_EQ(code_of(finished), "bad_file");
}

TEST(Command, RefusedJobsPrintTheErrorObjectAndStatus1) {
  const Finished finished = ridgeline({"chamfer", "-", "--local"}, R"({"job": "camfer"})");
  EXPECT_EQ(finished.status, 1);
  EXPECT_EQ(finished.json().at("status"), "error");
  EXPECT_EQ(finished.json().at("error").at("field"), "/job");
  EXPECT_NE(finished.err.find("/job must be"), std::string::npos);
}

TEST(Command, QuietSaysNothingOnStandardError) {
  const Finished finished =
      ridgeline({"chamfer", "-", "--local", "--quiet"}, R"({"job": "camfer"})");
  EXPECT_EQ(finished.status, 1);
  EXPECT_EQ(finished.err, "");
}

TEST(Command, RefusedJobsLeaveTheOldResultFile) {
  const TemporaryFolder folder;
  const std::string file = folder.write("O9101.nc", "old");
  const Finished finished =
      ridgeline({"chamfer", "-", "--local", "-o", file}, R"({"job": "camfer"})");
  EXPECT_EQ(finished.status, 1);
  EXPECT_EQ(code_of(finished), "bad_input");
  EXPECT_EQ(read(file), "old");
}

}  // namespace
}  // namespace ridgeline::tests
