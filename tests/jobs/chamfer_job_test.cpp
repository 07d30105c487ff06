#include "jobs/chamfer_job.hpp"

#include <cmath>
#include <numbers>

#include "tests/jobs/refusal_of.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;
constexpr double degree = std::numbers::pi / 180;

Json job() {
  return Json::parse(R"({"job": "chamfer",
    "workpiece": {"shape": "thick_walled_cylinder", "inner_radius": 20, "outer_radius": 30,
      "length": 100, "holes": [{"name": "H1", "shape": "circle", "radius": 5}]},
    "hole": "H1", "edge": "inner", "tool": {"shape": "ball", "radius": 3}, "width": 0.5})");
}

ChamferJob read(const Json& document) {
  return read_chamfer_job(Value(document), NoDefinitions());
}

// Each default as interfaces.md states it; angles in rad and feeds in mm/s inside the core.
TEST(ChamferJob, DefaultsAreThoseOfTheContract) {
  const ChamferJob read_job = read(job());
  const chamfer::Job& j = read_job.job;
  EXPECT_EQ(j.side, geometry::Side::Entry);
  EXPECT_EQ(j.tolerance, 0.005);
  EXPECT_TRUE(std::holds_alternative<chamfer::Bisector>(j.section_angle));
  EXPECT_EQ(j.method, chamfer::Method::Swept);
  EXPECT_FALSE(j.points);
  EXPECT_EQ(std::get<Eigen::Vector3d>(j.tool_axis), Eigen::Vector3d::UnitZ());
  EXPECT_EQ(j.direction, chamfer::Direction::Climb);
  EXPECT_EQ(j.start_angle, 0);
  EXPECT_DOUBLE_EQ(j.overlap, 5 * degree);
  EXPECT_TRUE(j.pass_widths.empty());
  EXPECT_EQ(j.feed, 5);
  EXPECT_EQ(j.feed_at, chamfer::FeedAt::Contact);
  EXPECT_EQ(j.clearance, 10);
  EXPECT_FALSE(j.end_position);
  EXPECT_FALSE(j.arcs);
  EXPECT_EQ(j.decimals, 4);
  EXPECT_EQ(j.control_point, chamfer::ControlPoint::Tip);
  EXPECT_EQ(read_job.program.spindle_speed, 8000);
  EXPECT_EQ(read_job.program.dialect, nc::Dialect::Fanuc);
  EXPECT_EQ(read_job.program.positioning, nc::Positioning::Absolute);
  EXPECT_EQ(read_job.program.work_offset, "G54");
  EXPECT_FALSE(read_job.workpiece_revision);
}

TEST(ChamferJob, EveryFieldArrives) {
  Json document = job();
  document.update(Json::parse(R"({"edge": "outer", "side": "exit", "tolerance": 0.002,
    "section_angle": [[0, 45], [90, 50]], "method": "section", "points": 90, "tool_axis": "bore",
    "direction": "conventional", "start_angle": 30, "overlap": 0, "passes": [0.25, 0.5],
    "spring_pass": true, "feed": 120, "lead_in_feed": 60, "feed_at": "centre",
    "spindle_speed": 5000, "clearance": 2, "lead_radius": 1, "end_position": [1, 2, 3],
    "output": {"program": 9101, "dialect": "linuxcnc", "positioning": "incremental",
      "arcs": true, "decimals": 3, "work_offset": "G59.1", "control_point": "centre",
      "type": "sub", "block_numbers": true}})"));
  const ChamferJob read_job = read(document);
  const chamfer::Job& j = read_job.job;
  EXPECT_EQ(j.edge, geometry::EdgeKind::Outer);
  EXPECT_EQ(j.side, geometry::Side::Exit);
  EXPECT_EQ(j.tolerance, 0.002);
  const auto& table = std::get<chamfer::AngleTable>(j.section_angle).entries;
  ASSERT_EQ(table.size(), 2);
  EXPECT_DOUBLE_EQ(table[1].phi, 90 * degree);
  EXPECT_DOUBLE_EQ(table[1].delta, 50 * degree);
  EXPECT_EQ(j.method, chamfer::Method::Section);
  EXPECT_EQ(j.points, 90);
  EXPECT_EQ(std::get<chamfer::Access>(j.tool_axis), chamfer::Access::Bore);
  EXPECT_EQ(j.direction, chamfer::Direction::Conventional);
  EXPECT_DOUBLE_EQ(j.start_angle, 30 * degree);
  EXPECT_EQ(j.overlap, 0);
  EXPECT_EQ(j.pass_widths, (std::vector<double>{0.25, 0.5}));
  EXPECT_TRUE(j.spring_pass);
  EXPECT_EQ(j.feed, 2);
  EXPECT_EQ(j.lead_in_feed, 1);
  EXPECT_EQ(j.feed_at, chamfer::FeedAt::Centre);
  EXPECT_EQ(j.clearance, 2);
  EXPECT_EQ(j.lead_radius, 1);
  EXPECT_EQ(j.end_position, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(j.arcs);
  EXPECT_EQ(j.decimals, 3);
  EXPECT_EQ(j.control_point, chamfer::ControlPoint::Centre);
  const nc::Program& p = read_job.program;
  EXPECT_EQ(p.number, 9101);
  EXPECT_EQ(p.dialect, nc::Dialect::LinuxCnc);
  EXPECT_EQ(p.positioning, nc::Positioning::Incremental);
  EXPECT_EQ(p.kind, nc::ProgramKind::Subprogram);
  EXPECT_EQ(p.decimals, 3);
  EXPECT_EQ(p.work_offset, "G59.1");
  EXPECT_EQ(p.block_number_step, 10);
  EXPECT_EQ(p.spindle_speed, 5000);
}

// [E 1]: W = sqrt(2) Q.
TEST(ChamferJob, CuttingAmountGivesTheWidth) {
  Json document = job();
  document.erase("width");
  document["cutting_amount"] = 0.3;
  EXPECT_NEAR(read(document).job.width, 0.42426406871192851, 1e-16);
}

// Chips of equal area: areas of chamfers are as the squares of their widths.
TEST(ChamferJob, NumberedPassesCutEqualAreas) {
  Json document = job();
  document["passes"] = 4;
  const std::vector<double> widths = read(document).job.pass_widths;
  ASSERT_EQ(widths.size(), 4);
  EXPECT_EQ(widths.back(), 0.5);
  double before = 0;
  for (const double width : widths) {
    EXPECT_NEAR(width * width - before * before, 0.0625, 1e-15);
    before = width;
  }
}

TEST(ChamferJob, ListedPassesMayEndWithTheRoundedWidthOfACuttingAmount) {
  Json document = job();
  document.erase("width");
  document["cutting_amount"] = 0.3;
  document["passes"] = {0.2, 0.4242641};
  EXPECT_EQ(read(document).job.pass_widths.back(), read(document).job.width);
}

TEST(ChamferJob, InlineHolesJoinTheWorkpiece) {
  Json document = job();
  document["hole"] = Json::parse(R"({"shape": "elongated", "radius": 3, "straight_along": 10})");
  const ChamferJob unnamed = read(document);
  EXPECT_EQ(unnamed.job.workpiece.holes.size(), 2);
  EXPECT_EQ(unnamed.job.workpiece.holes[1].name, unnamed.job.hole);
  document["hole"]["name"] = "H1";
  const ChamferJob same = read(document);
  ASSERT_EQ(same.job.workpiece.holes.size(), 1);
  EXPECT_EQ(same.job.workpiece.holes[0].profile.straight_along, 10);
}

TEST(ChamferJob, CommentsNameTheRevisionsAndTheControlPoint) {
  std::string all;
  for (const std::string& line : read(job()).program.comments) all += line + "\n";
  for (const char* part : {"hole H1", "inner edge, entry side", "width 0.5", "tolerance 0.005",
                           "(inline)", "tool tip", "feed 300 mm/min"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " in\n" << all;
}

TEST(ChamferJob, ToolWithoutNumberIsToldOf) {
  Json document = job();
  EXPECT_EQ(read(document).warnings.size(), 1);
  document["tool"]["number"] = 3;
  EXPECT_TRUE(read(document).warnings.empty());
  EXPECT_EQ(read(document).program.tool_number, 3);
}

}  // namespace
}  // namespace ridgeline::jobs
