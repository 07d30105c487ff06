#include "part/mouths.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "part/step.hpp"
#include "tests/part/parts.hpp"

namespace ridgeline::part {
namespace {

std::vector<Mouth> mouths(const std::string& name) {
  return mouths_of(read_step(part_text(RIDGELINE_TESTS, name)).front().model());
}

using Counts = std::map<Mouth::Kind, int>;

Counts counts(const std::vector<Mouth>& all) {
  Counts found;
  for (const Mouth& mouth : all) ++found[mouth.kind];
  return found;
}

// Design units.md, section 4.
TEST(Mouths, OfTheCrossTubeAreAllEighteen) {
  const Counts expected{{Mouth::Kind::Round, 12},
                        {Mouth::Kind::Slot, 2},
                        {Mouth::Kind::RoundedRectangle, 2},
                        {Mouth::Kind::Countersunk, 1},
                        {Mouth::Kind::Mixed, 1}};
  EXPECT_EQ(counts(mouths("own_cross_tube.step")), expected);
}

TEST(Mouths, OfTheManifoldAreTheTwelveOfItsBores) {
  int round = 0, slots = 0, equal = 0;
  for (const Mouth& mouth : mouths("own_manifold.step")) {
    if (!mouth.is_bore) continue;
    round += mouth.kind == Mouth::Kind::Round && mouth.wall_radius > mouth.radius;
    slots += mouth.kind == Mouth::Kind::Slot;
    equal += mouth.kind == Mouth::Kind::EqualDiameters;
  }
  EXPECT_EQ(round, 9);
  EXPECT_EQ(slots, 2);
  EXPECT_EQ(equal, 1);
}

struct Drawn {
  const char* part;
  Mouth::Kind kind;
  double R1, r, angle, f, length, width;
};

class DrawnMouths : public testing::TestWithParam<Drawn> {};

// Sizes of the drawings, to 4 decimals.
TEST_P(DrawnMouths, HaveTheSizesOfTheDrawing) {
  constexpr double decimals = 5e-5;
  const Drawn& drawn = GetParam();
  int found = 0;
  for (const Mouth& mouth : mouths(drawn.part))
    found += mouth.kind == drawn.kind && std::abs(mouth.wall_radius - drawn.R1) < decimals &&
             std::abs(mouth.radius - drawn.r) < decimals &&
             std::abs(mouth.angle * 180 / std::numbers::pi - drawn.angle) < decimals &&
             std::abs(mouth.eccentricity - drawn.f) < decimals &&
             std::abs(mouth.length - drawn.length) < decimals &&
             std::abs(mouth.width - drawn.width) < decimals;
  EXPECT_GE(found, 1);
}

INSTANTIATE_TEST_SUITE_P(
    Parts, DrawnMouths,
    testing::Values(Drawn{"own_cross_tube.step", Mouth::Kind::Round, 25, 10, 90, 0, 0, 0},
                    Drawn{"own_cross_tube.step", Mouth::Kind::Round, 25, 6, 90, 12, 0, 0},
                    Drawn{"own_cross_tube.step", Mouth::Kind::Round, 40, 8, 90, 20, 0, 0},
                    Drawn{"own_cross_tube.step", Mouth::Kind::Round, 25, 4, 60, 0, 0, 0},
                    Drawn{"own_cross_tube.step", Mouth::Kind::Slot, 25, 5, 90, 0, 24, 10},
                    Drawn{"own_cross_tube.step", Mouth::Kind::RoundedRectangle, 25, 3, 90, 0, 18,
                          14},
                    Drawn{"own_manifold.step", Mouth::Kind::Round, 10, 4, 45, 0, 0, 0},
                    Drawn{"own_manifold.step", Mouth::Kind::Round, 10, 5, 90, 4, 0, 0},
                    Drawn{"own_manifold.step", Mouth::Kind::Slot, 10, 4, 90, 0, 26, 8},
                    Drawn{"own_manifold.step", Mouth::Kind::Round, 6, 4, 90, 0, 0, 0}));

}  // namespace
}  // namespace ridgeline::part
