// Holes and faces that are neither along nor across the axis: the tilted work plane of the text,
// turned back by the angles as the control's manual has them, lies on the part's own geometry.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <sstream>

#include "jobs/answer.hpp"

namespace ridgeline::jobs {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;
using Json = nlohmann::json;

constexpr double length = 60, radius = 25;  // of the shaft [mm]

Json run(const Json& job) {
  return assemble(answer(job.dump(), "json", NoDefinitions()));
}

Json row(double x0, double z0, double x1, double z1) {
  return {{"pattern", "line"}, {"start", {x0, z0}}, {"end", {x1, z1}}};
}

Json shaft() {
  return {{"name", "shaft"},
          {"shape",
           Json::array({Json::array({row(0, 0, radius, 0), row(radius, 0, radius, length),
                                     row(radius, length, 0, length), row(0, length, 0, 0)})})}};
}

Json triple(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Json nc_of(const Json& product, const char* dialect) {
  const Json program = run({{"job", "units"}, {"product", product}});
  EXPECT_EQ(program.at("status"), "ok") << program.at("error");
  return run({{"job", "units"},
              {"operation", "nc"},
              {"program", program},
              {"output", {{"dialect", dialect}}}});
}

double radians_of(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// A point of a block within the tilted plane, in the product's frame, and the block's G code.
struct Place {
  int g = -1;
  Vector3d at;
};

/// What is done in tilted planes: C, then G68.2 X Y Z I J K until G69.1. X Y Z of the plane.
std::vector<Place> places_of(const Json& result) {
  std::vector<Place> places;
  for (const Json& program : result.at("programs")) {
    const int process = program.at("process");
    std::istringstream lines(program.at("text").get<std::string>());
    bool is_tilted = false;
    int g = 0;
    double c = 0;
    Vector3d origin = Vector3d::Zero(), at = Vector3d::Zero();
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    for (std::string line; std::getline(lines, line);) {
      if (line.find_first_of("(%O") == 0) continue;
      std::istringstream in(line);
      std::map<char, double> words;
      std::string code;
      for (std::string word; in >> word;) {
        if (word[0] == 'G') code = word;
        words[word[0]] = std::stod(word.substr(1));
      }
      if (!is_tilted && words.contains('C')) c = words['C'];
      if (code == "G69.1") is_tilted = false;
      if (code == "G68.2") {
        is_tilted = true;
        origin = Vector3d(words['X'], words['Y'], words['Z']);
        axes = (AngleAxisd(radians_of(words['I']), Vector3d::UnitZ()) *
                AngleAxisd(radians_of(words['J']), Vector3d::UnitX()) *
                AngleAxisd(radians_of(words['K']), Vector3d::UnitZ()))
                   .toRotationMatrix();
        continue;
      }
      if (!is_tilted || (code == "G0" && words.contains('C'))) continue;
      if (words.count('X') + words.count('Y') + words.count('Z') == 0) continue;
      if (!code.empty()) g = static_cast<int>(words['G']);
      for (int i = 0; i < 3; ++i)
        if (words.contains("XYZ"[i])) at[i] = words["XYZ"[i]];
      const Vector3d machine =
          AngleAxisd(radians_of(c), Vector3d::UnitZ()) * Vector3d(origin + axes * at);
      const Vector3d p = process == 1 ? Vector3d(machine.x(), -machine.y(), -machine.z())
                                      : Vector3d(machine.x(), machine.y(), machine.z() + length);
      places.push_back({g, p});
    }
  }
  return places;
}

TEST(UnitsTilted, DrillsEndWhereTheHolesDo) {
  std::mt19937 random(20261123);
  std::uniform_real_distribution<double> share(0, 1);
  int checked = 0;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    const bool is_front = i % 2 == 0;
    const double lean = radians_of(3 + 84 * share(random));
    const double turn = 2 * std::numbers::pi * share(random);
    // down from an end face, beside the axis
    const Vector3d start(15 * share(random), 12 * share(random), is_front ? 0 : length);
    const Vector3d direction(std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn),
                             (is_front ? 1 : -1) * std::cos(lean));
    Json product = shaft();
    product["holes"] = Json::array({{{"start", triple(start)},
                                     {"direction", triple(direction)},
                                     {"diameter", 3},
                                     {"depth", 10},
                                     {"bottom", "flat"}}});
    const Json result = nc_of(product, "fanuc");
    ASSERT_EQ(result.at("status"), "ok") << result.at("error");
    int drilled = 0;
    Vector3d before = start;
    for (const Place& place : places_of(result)) {
      if (place.g == 83) {
        ++drilled;
        EXPECT_LT((place.at - (start + 10 * direction)).norm(), 2e-3);
        EXPECT_LT(
            (before - before.dot(direction) * direction - start + start.dot(direction) * direction)
                .norm(),
            2e-3);  // fed along the hole's axis
        EXPECT_LT((before - start).dot(direction), -1.9);
      } else {
        before = place.at;
      }
    }
    EXPECT_EQ(drilled, 1) << result.at("notes");
    checked += drilled;
  }
  EXPECT_EQ(checked, 40);
}

TEST(UnitsTilted, MillsFollowTheFace) {
  for (const double lean : {20.0, 45.0, 70.0}) {
    SCOPED_TRACE(lean);
    const Vector3d normal(std::sin(radians_of(lean)), 0, std::cos(radians_of(lean)));
    const Vector3d along(normal.z(), 0, -normal.x());
    const Vector3d point(14, 0, 54);
    const auto corner = [&](double x, double y) {
      return triple(point + x * along + y * Vector3d::UnitY());
    };
    Json outline = Json::array();
    const std::vector<std::array<double, 2>> corners{{-8, -8}, {8, -8}, {8, 8}, {-8, 8}};
    for (std::size_t i = 0; i < 4; ++i)
      outline.push_back({{"pattern", "line"},
                         {"start", corner(corners[i][0], corners[i][1])},
                         {"end", corner(corners[(i + 1) % 4][0], corners[(i + 1) % 4][1])}});
    Json product = shaft();
    product["faces"] = Json::array({{{"form", "pocket"},
                                     {"normal", triple(normal)},
                                     {"point", triple(point)},
                                     {"depth", 4},
                                     {"outline", Json::array({outline})},
                                     {"z", {40, 60}}}});
    const Json result = nc_of(product, "fanuc");
    ASSERT_EQ(result.at("status"), "ok") << result.at("error");
    double lowest = 1e9, greatest = 0;
    for (const Place& place : places_of(result)) {
      const double height = (place.at - point).dot(normal);
      EXPECT_GT(height, -2e-3);
      if (place.g != 1) continue;
      lowest = std::min(lowest, height);
      greatest = std::max(greatest, std::abs((place.at - point).y()));
      EXPECT_LT(std::abs((place.at - point).dot(along)), 20);
    }
    EXPECT_NEAR(lowest, 0, 2e-3);
    EXPECT_GT(greatest, 1);
  }
}

TEST(UnitsTilted, WhatCannotBeWrittenIsNamed) {
  Json product = shaft();
  product["holes"] = Json::array({{{"start", {10, 0, 0}},
                                   {"direction", {0, 0.6, 0.8}},
                                   {"diameter", 3},
                                   {"depth", 10},
                                   {"bottom", "flat"}}});
  const Json linuxcnc = nc_of(product, "linuxcnc");
  EXPECT_EQ(linuxcnc.at("status"), "ok");
  EXPECT_NE(linuxcnc.at("notes").dump().find("LinuxCNC does not have"), std::string::npos);
  Json program = run({{"job", "units"}, {"product", product}});
  for (Json& unit : program["units"])
    if (unit["kind"] == "hole") unit["process"] = 2;
  const Json turned = run({{"job", "units"}, {"operation", "nc"}, {"program", program}});
  EXPECT_EQ(turned.at("status"), "ok");
  EXPECT_NE(turned.at("notes").dump().find("towards the chuck"), std::string::npos)
      << turned.at("notes");
  EXPECT_TRUE(places_of(turned).empty());
}

}  // namespace
}  // namespace ridgeline::jobs
