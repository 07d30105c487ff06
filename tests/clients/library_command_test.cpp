#include <gtest/gtest.h>

#include "tests/clients/process.hpp"

namespace ridgeline::tests {
namespace {

const char* const tool = R"({"kind": "tool", "number": 12, "name": "lollipop 6",
                             "shape": "lollipop", "radius": 3, "neck_radius": 1.5})";
const char* const tube =
    R"({"kind": "workpiece", "name": "tube-40", "shape": "thick_walled_cylinder",
                             "inner_radius": 20, "outer_radius": 30, "length": 100})";

class LibraryCommand : public testing::Test {
protected:
  Finished library(std::vector<std::string> arguments, const std::string& in = {}) const {
    arguments.insert(arguments.begin(), "library");
    arguments.insert(arguments.end(), {"--local", "--library", folder_.file("library.db")});
    return ridgeline(arguments, in);
  }
  TemporaryFolder folder_;
};

TEST_F(LibraryCommand, PutMakesRevisionsThatGetPrints) {
  EXPECT_EQ(library({"put", "-"}, tool).json().at("revision"), 1);
  std::string changed = tool;
  changed.replace(changed.find("1.5"), 3, "1.2");
  EXPECT_EQ(library({"put", folder_.write("tool.json", changed)}).json().at("revision"), 2);
  const Finished by_number = library({"get", "tool", "12"});
  EXPECT_EQ(by_number.status, 0);
  EXPECT_EQ(by_number.json().at("revision"), 2);
  EXPECT_EQ(by_number.json().at("definition"), nlohmann::json::parse(changed));
  const Finished first = library({"get", "tool", "lollipop 6", "--revision", "1"});
  EXPECT_EQ(first.json().at("definition"), nlohmann::json::parse(tool));
}

TEST_F(LibraryCommand, ExportImportsAgain) {
  const std::string both = std::string("[") + tool + "," + tube + "]";
  EXPECT_EQ(library({"import", "-"}, both).json().at("new"), 2);
  const std::string file = folder_.file("export.json");
  EXPECT_EQ(library({"export", "-o", file}).status, 0);
  const Finished again = library({"import", file});
  EXPECT_EQ(again.status, 0);
  EXPECT_EQ(again.json().at("new"), 0);
  EXPECT_EQ(library({"list"}).json().at("definitions").size(), 2);
  EXPECT_EQ(library({"list", "tool"}).json().at("definitions").size(), 1);
}

TEST_F(LibraryCommand, ImportsAllOrNothing) {
  const std::string broken = std::string("[") + tool + R"(, {"kind": "tool", "shape": "cube"}])";
  const Finished finished = library({"import", "-"}, broken);
  EXPECT_EQ(finished.status, 1);
  EXPECT_EQ(finished.json().at("error").at("code"), "bad_input");
  EXPECT_EQ(finished.json().at("error").at("field"), "/definitions/1/shape");
  EXPECT_EQ(library({"put", "-"}, tube).status, 0);
  EXPECT_EQ(library({"list"}).json().at("definitions").size(), 1);
}

TEST_F(LibraryCommand, RemovedDefinitionsAreUnknownButRemembered) {
  library({"put", "-"}, tool);
  EXPECT_EQ(library({"remove", "tool", "12"}).status, 0);
  const Finished finished = library({"get", "tool", "12"});
  EXPECT_EQ(finished.status, 1);
  EXPECT_EQ(finished.json().at("error").at("code"), "unknown_definition");
  EXPECT_EQ(library({"get", "tool", "lollipop 6", "--revision", "1"}).status, 0);
}

TEST_F(LibraryCommand, ReadingDoesNotMakeAFile) {
  const Finished finished = library({"list"});
  EXPECT_EQ(finished.status, 2);
  EXPECT_EQ(finished.json().at("error").at("code"), "bad_file");
}

TEST_F(LibraryCommand, UnfitDefinitionsAreRefusedByTheirField) {
  const Finished finished =
      library({"put", "-"}, R"({"kind": "tool", "number": 1, "shape": "ball", "radius": -3})");
  EXPECT_EQ(finished.status, 1);
  EXPECT_EQ(finished.json().at("error").at("field"), "/definition/radius");
}

}  // namespace
}  // namespace ridgeline::tests
