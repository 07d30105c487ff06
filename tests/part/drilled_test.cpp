// From which end holes are drilled: one that no drill reaches is not chosen, what widens behind a
// narrow stretch is drilled from its own end.

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <cmath>
#include <gp_Ax2.hxx>
#include <numbers>

#include "core/units/plan.hpp"
#include "part/product.hpp"
#include "tests/part/written.hpp"

namespace ridgeline::part {
namespace {

const gp_Dir up(0, 0, 1);

TopoDS_Shape cylinder(const gp_Pnt& from, double r, double l, const gp_Dir& way = up) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(from, way), r, l).Shape();
}

TopoDS_Shape cut(const TopoDS_Shape& from, const TopoDS_Shape& what) {
  return BRepAlgoAPI_Cut(from, what).Shape();
}

units::Product read(const TopoDS_Shape& shape) {
  return read_product(step_of({shape})).product;
}

void expect_closed(const units::Product& product) {
  const units::Volumes v = units::plan({product, {}, {}, {}}).volumes;
  EXPECT_NEAR(v.units - v.overlap_declared - v.overlap_undeclared + v.left + v.unexplained,
              v.stock - v.product, 1e-6 * v.stock);
  EXPECT_NEAR(v.unexplained, 0, 1e-6 * v.stock);
}

void expect_way(const units::Hole& hole, double x, double y, double z) {
  EXPECT_LT((hole.direction - Eigen::Vector3d(x, y, z)).norm(), 1e-9) << hole.direction.transpose();
}

TEST(Drilled, FromTheFrontWhereBothEndsAreOpen) {
  const units::Product product =
      read(cut(cylinder({0, 0, 0}, 40, 20), cylinder({25, 0, -1}, 4, 30)));
  ASSERT_EQ(product.holes.size(), 1u);
  expect_way(product.holes[0], 0, 0, 1);
}

TEST(Drilled, FromTheSideOfTheCounterbore) {
  const TopoDS_Shape drilled = cut(cylinder({0, 0, 0}, 40, 20), cylinder({25, 0, -1}, 4, 30));
  const units::Product product = read(cut(drilled, cylinder({25, 0, 14}, 7, 10)));
  ASSERT_EQ(product.holes.size(), 1u);
  const units::Hole& hole = product.holes[0];
  expect_way(hole, 0, 0, -1);
  EXPECT_NEAR(hole.start.z(), 20, 1e-6);
  ASSERT_EQ(hole.steps.size(), 2u);
  EXPECT_NEAR(hole.steps[0].diameter, 14, 1e-6);
  EXPECT_NEAR(hole.steps[0].length, 6, 1e-6);
  EXPECT_NEAR(hole.steps[1].diameter, 8, 1e-6);
  expect_closed(product);
}

TEST(Drilled, FromBothEndsWhereBothWiden) {
  const gp_Dir across(1, 0, 0);
  TopoDS_Shape shaft = cylinder({0, 0, 0}, 20, 80);
  shaft = cut(shaft, cylinder({-30, 0, 40}, 3, 60, across));
  shaft = cut(shaft, cylinder({-30, 0, 40}, 6, 15, across));
  shaft = cut(shaft, cylinder({16, 0, 40}, 5, 15, across));
  const units::Product product = read(shaft);
  ASSERT_EQ(product.holes.size(), 2u);
  EXPECT_LT(product.holes[0].direction.dot(product.holes[1].direction), -0.999);
  for (const units::Hole& hole : product.holes) {
    for (std::size_t i = 0; i + 1 < hole.steps.size(); ++i)
      EXPECT_LT(hole.steps[i + 1].diameter, hole.steps[i].diameter);
    const bool is_whole = hole.steps.size() == 2;
    EXPECT_NEAR(hole.diameter, is_whole ? 6 : hole.direction.x() > 0 ? 12 : 10, 1e-6);
    EXPECT_EQ(hole.bottom, is_whole ? units::HoleBottom::Through : units::HoleBottom::Flat);
  }
  EXPECT_EQ(product.holes[0].steps.size() + product.holes[1].steps.size(), 3u);
  expect_closed(product);
}

TEST(Drilled, NotThroughAnotherFlange) {
  TopoDS_Shape part = cylinder({0, 0, 0}, 15, 60);
  part = BRepAlgoAPI_Fuse(part, cylinder({0, 0, 0}, 40, 10)).Shape();
  part = BRepAlgoAPI_Fuse(part, cylinder({0, 0, 40}, 40, 10)).Shape();
  const units::Product behind = read(cut(part, cylinder({30, 0, 35}, 4, 20)));
  ASSERT_EQ(behind.holes.size(), 1u);
  expect_way(behind.holes[0], 0, 0, -1);
  const units::Program program = units::plan({behind, {}, {}, {}});
  for (const units::Unit& unit : program.units) {
    if (unit.kind == units::UnitKind::Hole) {
      EXPECT_EQ(unit.process, 2);
    }
  }
  const units::Product before = read(cut(part, cylinder({30, 0, -5}, 4, 20)));
  ASSERT_EQ(before.holes.size(), 1u);
  expect_way(before.holes[0], 0, 0, 1);
}

// A head like a screw's: a flat dome, r = sqrt(55^2 - (z + 13)^2) - 8, with a slot across it.
TEST(Drilled, ADomeWithASlotLeavesNoStairs) {
  const gp_Pnt low(0, 0, 0), rim(10, 0, 0), mid(10, 0, 30);
  const double R = 55, zc = 30 - std::sqrt(R * R - 18 * 18);
  const gp_Pnt top(0, 0, zc + std::sqrt(R * R - 64));
  const double xm = 5, zm = zc + std::sqrt(R * R - (xm + 8) * (xm + 8));
  BRepBuilderAPI_MakeWire wire;
  wire.Add(BRepBuilderAPI_MakeEdge(low, rim).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(rim, mid).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(mid, gp_Pnt(xm, 0, zm), top).Value()).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(top, low).Edge());
  const TopoDS_Face half = BRepBuilderAPI_MakeFace(wire.Wire()).Face();
  const TopoDS_Shape head = BRepPrimAPI_MakeRevol(half, gp_Ax1(low, up)).Shape();
  const TopoDS_Shape slot = BRepPrimAPI_MakeBox(gp_Pnt(-20, -1.25, 28), 40, 2.5, 10).Shape();
  const units::Product product = read(cut(head, slot));
  EXPECT_EQ(product.faces.size(), 1u);
  EXPECT_TRUE(product.remainders.empty());
  EXPECT_LT(product.shadow.cells.size(), 8u);
  const double ztop = zc + std::sqrt(R * R - 9.25 * 9.25);
  EXPECT_NEAR(units::box(product.shadow).z1, ztop, 1e-6);
  expect_closed(product);
}

// The mouth of what the slanted cut removes goes all round the axis.
TEST(Drilled, ASlantedEndIsExplainedWhole) {
  const gp_Ax2 slanted(gp_Pnt(-50, -50, 70), gp_Dir(std::sin(0.4), 0, std::cos(0.4)),
                       gp_Dir(std::cos(0.4), 0, -std::sin(0.4)));
  const TopoDS_Shape above = BRepPrimAPI_MakeBox(slanted, 150, 150, 90).Shape();
  const units::Product product = read(cut(cylinder({0, 0, 0}, 20, 100), above));
  EXPECT_EQ(product.faces.size(), 1u);
  expect_closed(product);
}

}  // namespace
}  // namespace ridgeline::part
