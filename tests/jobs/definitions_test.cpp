#include "jobs/definitions.hpp"

#include <cmath>

#include "tests/jobs/refusal_of.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

Json tube() {
  return Json::parse(R"({"kind": "workpiece", "name": "tube-40", "shape": "thick_walled_cylinder",
    "inner_radius": 20, "outer_radius": 30, "length": 100, "material": "S45C",
    "holes": [{"name": "H1", "shape": "circle", "radius": 5}]})");
}
Json block() {
  return Json::parse(R"({"kind": "workpiece", "name": "valve", "shape": "manifold_block",
    "bore_radius": 10, "size": [40, 80, 50]})");
}
Json lollipop() {
  return Json::parse(R"({"kind": "tool", "number": 12, "name": "lollipop 6", "shape": "lollipop",
    "radius": 3, "neck_radius": 1.5, "neck_length": 30, "shank_radius": 3, "holder_radius": 15,
    "stickout": 50, "flutes": 2, "helix_angle": 30, "spindle": "cw", "wear": -0.01})");
}
Json material() {
  return Json::parse(R"({"kind": "material", "name": "S45C", "Ktc": 2100, "Krc": 800, "Kac": 0,
    "Kte": 20, "Kre": 30, "Kae": 0})");
}

geometry::Workpiece workpiece(const Json& json) {
  return read_workpiece(Value(json));
}

TEST(Definitions, ExamplesOfTheContractAreValid) {
  for (const Json& definition : {tube(), block(), lollipop(), material()})
    EXPECT_NO_THROW(validate_definition(definition)) << definition;
}

TEST(Definitions, DefaultsAreThoseOfTheContract) {
  const geometry::Workpiece w = workpiece(tube());
  EXPECT_EQ(w.position, Eigen::Vector3d::Zero());
  EXPECT_EQ(w.axis, Eigen::Vector3d::UnitY());
  EXPECT_EQ(w.holes.at(0).axis, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(w.holes.at(0).position, w.position);
  EXPECT_EQ(w.holes.at(0).walls, 2);
  EXPECT_FALSE(w.holes.at(0).eccentric_distance);
}

// [0066]: counter-clockwise seen from above; a quarter turn brings A1 from Y to -X.
TEST(Definitions, ArrangementAngleTurnsCounterClockwise) {
  Json json = tube();
  json["arrangement_angle"] = 90;
  EXPECT_TRUE(workpiece(json).axis.isApprox(-Eigen::Vector3d::UnitX(), 1e-15));
  json["holes"][0]["penetration_angle"] = 30;  // towards A1: towards -X
  const Eigen::Vector3d expected(-0.5, 0, std::sqrt(0.75));
  EXPECT_TRUE(workpiece(json).holes[0].axis.isApprox(expected, 1e-15));
}

// A1 along Y passes at x = -f of the hole axis, so the hole stands at x = +f of A1.
TEST(Definitions, EccentricDistancePlacesTheHole) {
  Json json = tube();
  json["position"] = {1, 2, 3};
  json["holes"][0]["eccentric_distance"] = 4;
  EXPECT_TRUE(workpiece(json).holes[0].position.isApprox(Eigen::Vector3d(5, 2, 3)));
  json["arrangement_angle"] = 90;  // x' turns from X to Y
  EXPECT_TRUE(workpiece(json).holes[0].position.isApprox(Eigen::Vector3d(1, 6, 3)));
}

TEST(Definitions, EccentricDistanceAgreesWithThePositions) {
  Json json = tube();
  json["holes"][0]["position"] = {4, 50, -7};  // along A1 and along A2 is free
  json["holes"][0]["eccentric_distance"] = 4;
  EXPECT_NO_THROW(workpiece(json));
  json["holes"][0]["eccentric_distance"] = 4.00001;
  const Error error = refusal_of([&] { workpiece(json); });
  EXPECT_EQ(error.code(), ErrorCode::InconsistentEccentricity);
  EXPECT_EQ(error.details().field, "/holes/0/eccentric_distance");
}

TEST(Definitions, AxesReplaceTheAngles) {
  Json json = tube();
  json["axis"] = {0, 0, 2};
  json["holes"][0]["axis"] = {3, 0, 4};
  const geometry::Workpiece w = workpiece(json);
  EXPECT_EQ(w.axis, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(w.holes[0].axis.isApprox(Eigen::Vector3d(0.6, 0, 0.8)));
  json["arrangement_angle"] = 0;
  EXPECT_EQ(refusal_of([&] { workpiece(json); }).details().field, "/arrangement_angle");
}

TEST(Definitions, AnglesAreRadiansInTheCore) {
  const Json json = lollipop();
  EXPECT_DOUBLE_EQ(read_tool(Value(json)).helix_angle, std::numbers::pi / 6);
}

// One change of a valid definition each; the field is what the error has to name.
struct Broken {
  std::string name;
  Json definition;
  std::string pointer;  // where `value` is put
  Json value;           // discarded: the member is removed
  std::string field;
};
void PrintTo(const Broken& broken, std::ostream* out) {
  *out << broken.name;
}

class BrokenDefinition : public testing::TestWithParam<Broken> {};

TEST_P(BrokenDefinition, IsRefusedByItsField) {
  Json definition = GetParam().definition;
  const Json::json_pointer pointer(GetParam().pointer);
  if (GetParam().value.is_discarded())
    definition.at(pointer.parent_pointer()).erase(pointer.back());
  else
    definition[pointer] = GetParam().value;
  const Error error = refusal_of([&] { validate_definition(definition); });
  EXPECT_EQ(error.code(), ErrorCode::BadInput);
  EXPECT_EQ(error.details().field, GetParam().field) << error.what();
}

const Json removed(Json::value_t::discarded);

INSTANTIATE_TEST_SUITE_P(
    All, BrokenDefinition,
    testing::Values(
        Broken{"NoKind", tube(), "/kind", removed, "/kind"},
        Broken{"UnknownKind", tube(), "/kind", "wrokpiece", "/kind"},
        Broken{"NoName", tube(), "/name", removed, "/name"},
        Broken{"NumberName", tube(), "/name", 5, "/name"},
        Broken{"UnknownShape", tube(), "/shape", "sphere", "/shape"},
        Broken{"UnknownKey", tube(), "/colour", "red", "/colour"},
        Broken{"NegativeRadius", tube(), "/inner_radius", -20, "/inner_radius"},
        Broken{"TinyRadius", tube(), "/inner_radius", 1e-300, "/inner_radius"},
        Broken{"HugeRadius", tube(), "/outer_radius", 1e300, "/outer_radius"},
        Broken{"TextRadius", tube(), "/inner_radius", "20", "/inner_radius"},
        Broken{"NullRadius", tube(), "/inner_radius", nullptr, "/inner_radius"},
        Broken{"OuterInsideInner", tube(), "/outer_radius", 20, "/outer_radius"},
        Broken{"NoLength", tube(), "/length", removed, "/length"},
        Broken{"ZeroAxis", tube(), "/axis", Json::array({0, 0, 0}), "/axis"},
        Broken{"FlatPosition", tube(), "/position", Json::array({0, 0}), "/position"},
        Broken{"HolesObject", tube(), "/holes", Json::object(), "/holes"},
        Broken{"HoleNoName", tube(), "/holes/0/name", removed, "/holes/0/name"},
        Broken{"HoleUnknownKey", tube(), "/holes/0/radios", 5, "/holes/0/radios"},
        Broken{"HoleThreeWalls", tube(), "/holes/0/walls", 3, "/holes/0/walls"},
        Broken{"HoleTooOblique", tube(), "/holes/0/penetration_angle", 80,
               "/holes/0/penetration_angle"},
        Broken{"CircleWithStraight", tube(), "/holes/0/straight_along", 5,
               "/holes/0/straight_along"},
        Broken{"BlindThroughBothWalls", tube(), "/holes/0",
               Json::parse(R"({"name":"H","shape":"circle","radius":5,"depth":9,"walls":2})"),
               "/holes/0/walls"},
        Broken{"TwoHolesOneName", tube(), "/holes/1",
               Json::parse(R"({"name":"H1","shape":"circle","radius":5})"), "/holes/1/name"},
        Broken{"BoreFillsBlock", block(), "/bore_radius", 20, "/size"},
        Broken{"BlockWithOuterRadius", block(), "/outer_radius", 20, "/outer_radius"},
        Broken{"ToolNoNameNoNumber", Json::parse(R"({"kind":"tool","shape":"ball","radius":3})"),
               "/radius", 3, "/name"},
        Broken{"ToolNumberZero", lollipop(), "/number", 0, "/number"},
        Broken{"ToolNumberBroken", lollipop(), "/number", 1.5, "/number"},
        Broken{"NeckAsThickAsBall", lollipop(), "/neck_radius", 3, "/neck_radius"},
        Broken{"NeckInsideBall", lollipop(), "/neck_length", 2.9, "/neck_length"},
        Broken{"StickoutBelowNeck", lollipop(), "/stickout", 29, "/stickout"},
        Broken{"ShankNowhere", lollipop(), "/neck_length", removed, "/neck_length"},
        Broken{"HolderNowhere", lollipop(), "/stickout", removed, "/stickout"},
        Broken{"WearTakesTheBall", lollipop(), "/wear", -3, "/wear"},
        Broken{"NoFlutes", lollipop(), "/flutes", 0, "/flutes"},
        Broken{"UnknownSpindle", lollipop(), "/spindle", "left", "/spindle"},
        Broken{"MaterialWithoutKtc", material(), "/Ktc", removed, "/Ktc"}),
    [](const auto& test) { return test.param.name; });

/// A library of two workpieces and a tool, for looking names up.
class Shelf : public Definitions {
public:
  std::optional<Definition> find(std::string_view kind, std::string_view name) const override {
    if (kind == "workpiece" && name == "tube-40") return Definition{tube(), 7};
    if (kind == "tool" && (name == "12" || name == "lollipop 6")) return Definition{lollipop(), 3};
    return std::nullopt;
  }
  std::vector<std::string> names(std::string_view kind) const override {
    if (kind == "workpiece") return {"tube-40", "valve"};
    if (kind == "tool") return {"lollipop 6"};
    return {};
  }
};

TEST(Definitions, NamesNumbersAndObjectsResolve) {
  const Shelf shelf;
  const Json by_name = "tube-40", number = 12, tool_name = "lollipop 6", inline_tool = lollipop();
  EXPECT_EQ(resolve_workpiece(Value(by_name), shelf).revision, 7);
  EXPECT_EQ(resolve_workpiece(Value(by_name), shelf).material, "S45C");
  EXPECT_EQ(resolve_tool(Value(number), shelf).tool.number, 12);
  EXPECT_EQ(resolve_tool(Value(tool_name), shelf).revision, 3);
  EXPECT_EQ(resolve_tool(Value(inline_tool), shelf).revision, std::nullopt);
}

TEST(Definitions, UnknownNamesSayWhatThereIs) {
  const Shelf shelf;
  const Json wrong = "tube-04", number = 13;
  const Error workpiece = refusal_of([&] { resolve_workpiece(Value(wrong, "/workpiece"), shelf); });
  EXPECT_EQ(workpiece.code(), ErrorCode::UnknownWorkpiece);
  EXPECT_EQ(workpiece.details().field, "/workpiece");
  EXPECT_EQ(workpiece.details().value, "tube-04");
  EXPECT_NE(std::string(workpiece.what()).find("nearest: tube-40"), std::string::npos);
  const Error tool = refusal_of([&] { resolve_tool(Value(number, "/tool"), shelf); });
  EXPECT_EQ(tool.code(), ErrorCode::UnknownTool);
  const Json tube_document = tube(), hole = "H2";
  const geometry::Workpiece w = read_workpiece(Value(tube_document));
  const Error of_hole = refusal_of([&] { resolve_hole(Value(hole, "/hole"), w); });
  EXPECT_EQ(of_hole.code(), ErrorCode::UnknownHole);
  EXPECT_NE(std::string(of_hole.what()).find("H1"), std::string::npos);
}

TEST(Definitions, KeysNameAToolByNameAndNumber) {
  EXPECT_EQ(key_of(tube()).name, "tube-40");
  EXPECT_EQ(key_of(lollipop()).name, "lollipop 6");
  EXPECT_EQ(key_of(lollipop()).alias, "12");
  const Json unnamed = {{"kind", "tool"}, {"number", 9}, {"shape", "ball"}, {"radius", 3}};
  EXPECT_EQ(key_of(unnamed).name, "9");
}

}  // namespace
}  // namespace ridgeline::jobs
