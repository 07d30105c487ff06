#include "core/units/plan.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/units/edit.hpp"
#include "core/units/names.hpp"
#include "core/units/overlay.hpp"
#include "tests/core/units/products.hpp"

namespace ridgeline::units {
namespace {

/// Design 2.5: stock by equation (1), 4 mm on the diameter, 5 mm on each end.
PlanJob flanged_job() {
  return {
      .product = products::flanged_shaft(),
      .parameters = {.radial_allowance = 4, .end_allowance = 5, .stock_rule = StockRule::Document},
      .stock = {},
      .split = Split{40, 70, 5, 5}};
}

std::string listed(const Program& program) {
  std::string text;
  for (const Unit& unit : program.units)
    text += std::string(name(unit.kind)) + std::to_string(unit.process) + " ";
  return text;
}

TEST(Plan, FlangedShaftHasTheUnitsOfFigure27) {
  const Program program = plan(flanged_job());
  EXPECT_EQ(listed(program),
            "face_front1 bar_outer1 bar_inner1 hole1 hole1 hole1 hole1 "
            "face_back2 bar_outer2 bar_inner2 face_mill2 face_mill2 face_mill2 face_mill2 "
            "face_mill2 face_mill2 face_mill2 face_mill2 hole2 hole2 hole2 hole2 hole2 hole2 ");
  EXPECT_EQ(program.notes, std::vector<std::string>{});
}

// Design 2.5, by solid booleans.
TEST(Plan, FlangedShaftHasTheVolumesOfTheSolidModel) {
  const Volumes v = plan(flanged_job()).volumes;
  EXPECT_NEAR(v.stock - v.product, 2578676.468, 1e-3);
  EXPECT_NEAR(v.turned, 2565560.6546, 2e-4);
  EXPECT_NEAR(v.overlap_declared, 128409.8, 0.05);
  EXPECT_NEAR(v.overlap_undeclared, 0, 1e-6);
  EXPECT_NEAR(v.left, 0, 1e-6);
  EXPECT_NEAR(v.unexplained, 0, 1e-6);
  EXPECT_NEAR(v.units - v.overlap_declared, v.stock - v.product, 1e-3);
}

TEST(Plan, FiguresFollowTheProductSide) {
  const Program program = plan(flanged_job());
  const Unit& bore = program.units[2];
  ASSERT_EQ(bore.shape.size(), 3u);
  EXPECT_NEAR(bore.shape[0].start.r, 18, 1e-12);
  EXPECT_NEAR(bore.shape[2].end.r, 12, 1e-12);
  EXPECT_NEAR(bore.shape[2].end.z, 75, 1e-12);  // split 70 + overlap 5
  EXPECT_NEAR(bore.start.r, 0, 1e-12);
  EXPECT_NEAR(bore.start.z, 0, 1e-12);
  const Unit& outer = program.units[1];
  ASSERT_EQ(outer.shape.size(), 5u);  // chamfer, diameter 60, fillet, shoulder, diameter 120
  EXPECT_TRUE(outer.shape[2].arc.has_value());
  EXPECT_NEAR(outer.shape[4].end.z, 45, 1e-12);
  const Unit& back = program.units[7];
  EXPECT_NEAR(back.shape[0].end.r, 0, 1e-12);
  EXPECT_NEAR(back.shape[0].end.z, 120, 1e-12);
}

// Design 1.8-j: from the side where they begin no tool reaches them.
TEST(Plan, WhatLeansIsCutFromTheEndThatItLeansTo) {
  PlanJob job = flanged_job();
  const std::size_t holes = job.product.holes.size();
  const std::size_t faces = job.product.faces.size();
  for (const double z : {10.0, 110.0}) {
    for (const double lean : {0.3, 1e-3, -1e-3, -0.3}) {
      const Eigen::Vector3d way(-std::sqrt(1 - lean * lean), 0, lean);
      Hole hole = job.product.holes[0];
      hole.start = {30, 0, z};
      hole.direction = way;
      job.product.holes.push_back(hole);
      MilledFace face = job.product.faces[0];
      face.normal = -way;
      face.z0 = face.z1 = z;
      job.product.faces.push_back(face);
    }
  }
  int checked = 0;
  for (const Unit& unit : plan(job).units) {
    const bool is_hole = unit.kind == UnitKind::Hole && unit.feature >= holes;
    const bool is_face = unit.kind == UnitKind::FaceMill && unit.feature >= faces;
    if (!is_hole && !is_face) continue;
    const double way = is_hole ? unit.hole->direction.z() : -unit.face->normal.z();
    EXPECT_EQ(unit.process, way > 0 ? 1 : 2) << way;
    ++checked;
  }
  EXPECT_EQ(checked, 16);
}

// Document 004, figures 28 and 40.
TEST(Edit, LongerBoreOfProcess1ReproducesFigure40) {
  const Program program = plan(flanged_job());
  Unit bore = program.units[2];
  bore.shape[2].end.z = 125;
  const std::vector<Edit> edits{ChangeUnit{3, bore}};
  const Program result = edit(program, edits);
  ASSERT_EQ(result.units.size(), 24u);
  EXPECT_EQ(listed(result), listed(program));
  int kept = 0, frozen = 0, made = 0;
  for (const Unit& unit : result.units) {
    kept += unit.state == State::Kept;
    frozen += unit.state == State::Frozen;
    made += unit.state == State::Auto;
  }
  EXPECT_EQ(kept, 19);
  EXPECT_EQ(frozen, 2);
  EXPECT_EQ(made, 2);
  EXPECT_EQ(result.units[2].state, State::Edited);
  EXPECT_EQ(result.units[7].state, State::Auto);
  EXPECT_NEAR(result.units[7].shape[0].end.r, 12, 1e-9);  // face_back ends at X 12
  EXPECT_EQ(result.units[9].state, State::Auto);
  EXPECT_NEAR(result.units[9].shape.back().end.z, 91, 1e-9);  // bar_inner 2 from Z 91
  const Volumes& v = result.volumes;
  EXPECT_NEAR(v.overlap_undeclared, 0, 1e-6);
  EXPECT_NEAR(v.left, 0, 1e-6);
  // only bar_outer 1 x bar_outer 2 overlap: 10 mm of the ring from 60 to the stock
  const double R = std::hypot(120, 120) / 2 + 2;
  EXPECT_NEAR(v.overlap_declared, std::numbers::pi * (R * R - 3600) * 10, 1e-6);
}

// Found by random edits: a hole that was split in two and taken out half by half is left once.
TEST(Edit, AHoleTakenOutInTwoPartsIsLeftOnce) {
  Program program = plan(flanged_job());
  Unit hole = program.units[3];
  hole.hole->depth = 6;
  program = edit(program, std::vector<Edit>{ChangeUnit{4, hole}});
  ASSERT_EQ(program.units.size(), 25u);
  for (int part = 0; part < 2; ++part) {
    const auto found = std::find_if(program.units.begin(), program.units.end(), [](const Unit& u) {
      return u.kind == UnitKind::Hole && u.feature == 0u;
    });
    ASSERT_NE(found, program.units.end());
    program = edit(program, std::vector<Edit>{RemoveUnit{found->number}});
  }
  EXPECT_EQ(program.units.size(), 23u);
  EXPECT_NEAR(program.volumes.left, program.product.holes[0].volume, 1e-6);
}

TEST(Plan, StockThatDoesNotHoldTheProductIsRefused) {
  PlanJob job = flanged_job();
  job.stock = StockCylinder{119, 130};
  EXPECT_THROW(plan(job), Error);
  job.stock = StockCylinder{122, 119};
  EXPECT_THROW(plan(job), Error);
  job.stock = StockCylinder{122, 121};
  EXPECT_NEAR(plan(job).volumes.left, 0, 1e-6);
}

}  // namespace
}  // namespace ridgeline::units
