// Files that Open CASCADE writes here: units, several solids, free-form surfaces.

#include <gtest/gtest.h>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>
#include <gp_Ax2.hxx>
#include <numbers>

#include "core/base/error.hpp"
#include "part/product.hpp"
#include "part/step.hpp"
#include "tests/part/parts.hpp"
#include "tests/part/written.hpp"

namespace ridgeline::part {
namespace {

TopoDS_Shape cylinder(double r, double l, double x = 0) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, 0, 0), gp_Dir(0, 0, 1)), r, l).Shape();
}

ErrorCode code_of(const std::string& step) {
  try {
    read_product(step);
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "nothing was refused";
  return ErrorCode::Internal;
}

TEST(MadeParts, InchesAreMillimetresInside) {
  const units::Product product = read_product(step_of({cylinder(20, 50)}, "INCH")).product;
  const units::Box box = units::box(product.shadow);
  EXPECT_NEAR(box.r1, 20, 1e-6);
  EXPECT_NEAR(box.z1, 50, 1e-6);
  EXPECT_NEAR(product.volume, std::numbers::pi * 400 * 50, 1e-3);
}

TEST(MadeParts, OfSeveralSolidsTheOnlyTurnedOneIsTaken) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(gp_Pnt(100, 0, 0), 10, 20, 30).Shape();
  const units::Product product = read_product(step_of({cylinder(20, 50), box})).product;
  EXPECT_NEAR(units::box(product.shadow).r1, 20, 1e-6);
  EXPECT_EQ(product.notes.size(), 1u);
}

TEST(MadeParts, TwoTurnedSolidsAreTooMany) {
  EXPECT_EQ(code_of(step_of({cylinder(20, 50), cylinder(10, 30, 100)})), ErrorCode::SeveralSolids);
}

TEST(MadeParts, ABoxIsNotTurned) {
  EXPECT_EQ(code_of(step_of({BRepPrimAPI_MakeBox(10, 20, 30).Shape()})), ErrorCode::NotTurned);
}

TEST(MadeParts, SizesThatNoMachineTakesAreRefused) {
  EXPECT_EQ(code_of(step_of({cylinder(3e4, 5e4)})), ErrorCode::AbsurdSize);
  EXPECT_EQ(code_of(step_of({cylinder(0.01, 0.02)})), ErrorCode::AbsurdSize);
}

// No face of it tells an axis: any through its middle turns it.
TEST(MadeParts, ABallIsTurnedAboutItsMiddle) {
  const units::Product product =
      read_product(step_of({BRepPrimAPI_MakeSphere(20).Shape()})).product;
  const double volume = std::numbers::pi * 8000 * 4 / 3;
  EXPECT_NEAR(product.volume, volume, 1e-6 * volume);
  EXPECT_NEAR(units::volume(product.shadow), volume, 1e-6 * volume);
}

struct FreeForm {
  const char* name;
  TopoDS_Shape shape;
  double volume;
};
void PrintTo(const FreeForm& part, std::ostream* out) {
  *out << part.name;
}
class FreeFormParts : public testing::TestWithParam<FreeForm> {};

// The same solid with every surface a B-spline has the same half section.
TEST_P(FreeFormParts, AreRecognisedAsWhatTheyAre) {
  const TopoDS_Shape spline = BRepBuilderAPI_NurbsConvert(GetParam().shape).Shape();
  const units::Product product = read_product(step_of({spline})).product;
  EXPECT_NEAR(product.volume, GetParam().volume, 1e-6 * GetParam().volume);
  EXPECT_NEAR(units::volume(product.shadow), GetParam().volume, 1e-6 * GetParam().volume);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, FreeFormParts,
    testing::Values(FreeForm{"cylinder", cylinder(20, 50), std::numbers::pi * 400 * 50},
                    FreeForm{"cone", BRepPrimAPI_MakeCone(20, 10, 50).Shape(),
                             std::numbers::pi * 50 * (400 + 200 + 100) / 3},
                    FreeForm{"sphere", BRepPrimAPI_MakeSphere(20).Shape(),
                             std::numbers::pi * 8000 * 4 / 3},
                    FreeForm{"torus", BRepPrimAPI_MakeTorus(30, 8).Shape(),
                             2 * std::numbers::pi* std::numbers::pi * 30 * 64}));

// r = 20 + 3 sin(z / 4) turned, through 61 points: a B-spline of many spans. Its volume by
// Simpson's rule on the same curve.
TEST(MadeParts, AMeridianOfManySpansClosesWithoutARemainder) {
  constexpr int n = 60;
  TColgp_Array1OfPnt points(1, n + 1);
  for (int i = 0; i <= n; ++i) {
    const double z = 1.5 * i;
    points(i + 1) = gp_Pnt(20 + 3 * std::sin(z / 4), 0, z);
  }
  const Handle(Geom_BSplineCurve) curve = GeomAPI_PointsToBSpline(points, 3, 8, GeomAbs_C2, 1e-6);
  const gp_Pnt low = curve->StartPoint(), high = curve->EndPoint();
  const gp_Pnt low_axis(0, 0, low.Z()), high_axis(0, 0, high.Z());
  BRepBuilderAPI_MakeWire wire;
  wire.Add(BRepBuilderAPI_MakeEdge(low_axis, low).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(curve).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(high, high_axis).Edge());
  wire.Add(BRepBuilderAPI_MakeEdge(high_axis, low_axis).Edge());
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(wire.Wire()).Face();
  const gp_Ax1 axis(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
  const TopoDS_Shape solid = BRepPrimAPI_MakeRevol(face, axis).Shape();
  double volume = 0;
  constexpr int steps = 20'000;
  const double t0 = curve->FirstParameter();
  const double h = (curve->LastParameter() - t0) / steps;
  for (int i = 0; i <= steps; ++i) {
    gp_Pnt p;
    gp_Vec d;
    curve->D1(t0 + i * h, p, d);
    const double weight = i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2;
    volume += weight * h / 3 * std::numbers::pi * p.X() * p.X() * d.Z();
  }
  const units::Product product = read_product(step_of({solid})).product;
  EXPECT_NEAR(product.volume, volume, 1e-7 * volume);
  EXPECT_NEAR(units::volume(product.shadow), volume, 1e-6 * volume);
  EXPECT_TRUE(product.remainders.empty());
  // A slot that cuts the seam short leaves the half section as it was.
  const TopoDS_Shape slot = BRepPrimAPI_MakeBox(gp_Pnt(-60, -2, 70), 120, 4, 60).Shape();
  const units::Product slotted =
      read_product(step_of({BRepAlgoAPI_Cut(solid, slot).Shape()})).product;
  EXPECT_NEAR(units::volume(slotted.shadow), volume, 1e-6 * volume);
  EXPECT_EQ(slotted.faces.size(), 1u);
  EXPECT_TRUE(slotted.remainders.empty());
}

}  // namespace
}  // namespace ridgeline::part
