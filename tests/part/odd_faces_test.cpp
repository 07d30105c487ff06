// Faces as some systems write them, and half sections that faces beside them close.

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Circ.hxx>
#include <gp_Cone.hxx>
#include <gp_Pln.hxx>
#include <numbers>

#include "part/product.hpp"
#include "tests/part/written.hpp"

namespace ridgeline::part {
namespace {

constexpr double pi = std::numbers::pi;

TopoDS_Face disc(double z, double r) {
  const gp_Ax2 place(gp_Pnt(0, 0, z), gp_Dir(0, 0, 1));
  const TopoDS_Wire rim = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(place, r)));
  return BRepBuilderAPI_MakeFace(gp_Pln(gp_Ax3(place)), rim);
}

/// Radius 10 at z = -12, 5 at z = -7: the cone of radius 2 at z = 0 has its apex at z = -2.
TopoDS_Solid frustum_beyond_the_apex() {
  const gp_Cone cone(gp_Ax3(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), pi / 4, 2);
  BRepBuilderAPI_Sewing sewing(1e-6);
  sewing.Add(BRepBuilderAPI_MakeFace(cone, 0, 2 * pi, -12 * std::numbers::sqrt2,
                                     -7 * std::numbers::sqrt2));
  sewing.Add(disc(-12, 10));
  sewing.Add(disc(-7, 5));
  sewing.Perform();
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(sewing.SewedShape()));
  BRepLib::OrientClosedSolid(solid);
  return solid;
}

TEST(OddFaces, AConesOtherNappeIsTurnedToo) {
  const units::Product product = read_product(step_of({frustum_beyond_the_apex()})).product;
  const double volume = pi / 3 * 5 * (100 + 50 + 25);
  EXPECT_NEAR(product.volume, volume, 1e-6 * volume);
  EXPECT_NEAR(units::volume(product.shadow), volume, 1e-6 * volume);
  const units::Box box = units::box(product.shadow);
  EXPECT_NEAR(box.r1, 10, 1e-6);
  EXPECT_NEAR(box.z0, 0, 1e-6);
  EXPECT_NEAR(box.z1, 5, 1e-6);
  EXPECT_TRUE(product.remainders.empty());
}

// The turning axis pierces the face where it has neither a pole nor an edge.
TEST(OddFaces, ASphereIsWholeAboutEveryAxis) {
  const gp_Ax2 lying(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 0));
  const std::string step = step_of({BRepPrimAPI_MakeSphere(lying, 20).Shape()});
  const double volume = 4.0 / 3 * pi * 8000;
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.6, 0, 0.8), Eigen::Vector3d(1, 0, 0)}) {
    SCOPED_TRACE(axis.transpose());
    const units::Product product =
        read_product(step, GivenAxis{Eigen::Vector3d(0, 0, 0), axis}).product;
    EXPECT_NEAR(units::volume(product.shadow), volume, 1e-6 * volume);
    EXPECT_NEAR(units::box(product.shadow).z1, 40, 1e-6);
    EXPECT_NEAR(units::box(product.shadow).r1, 20, 1e-6);
  }
}

// A ring inside a cylinder that one narrow channel opens: turning does not reach it.
TEST(OddFaces, AVoidThatOnlyAChannelOpensIsNamed) {
  const auto cylinder = [](double r, double z, double l) {
    return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, z), gp_Dir(0, 0, 1)), r, l).Shape();
  };
  const TopoDS_Shape ring = BRepAlgoAPI_Cut(cylinder(15, 10, 30), cylinder(10, 10, 30)).Shape();
  const TopoDS_Shape channel = BRepPrimAPI_MakeBox(gp_Pnt(12, -1, 20), 20, 2, 2).Shape();
  const TopoDS_Shape hollow = BRepAlgoAPI_Cut(cylinder(20, 0, 50), ring).Shape();
  const units::Product product =
      read_product(step_of({BRepAlgoAPI_Cut(hollow, channel).Shape()})).product;
  EXPECT_NEAR(units::volume(product.shadow), pi * 400 * 50, 1e-3);
  const double volume = pi * (225 - 100) * 30;
  const auto is_ring = [&](const units::Remainder& rest) {
    return std::abs(rest.volume - volume) < 1e-6 * volume && std::abs(rest.z0 - 10) < 1e-6;
  };
  EXPECT_EQ(std::count_if(product.remainders.begin(), product.remainders.end(), is_ring), 1);
  // Without the channel it is a cavity, which planning refuses.
  EXPECT_NEAR(units::volume(read_product(step_of({hollow})).product.shadow), pi * 400 * 50 - volume,
              1e-3);
}

}  // namespace
}  // namespace ridgeline::part
