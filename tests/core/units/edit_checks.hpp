#pragma once

#include <gtest/gtest.h>

#include <cstdlib>

#include "core/units/edit.hpp"
#include "core/units/figure.hpp"
#include "core/units/names.hpp"
#include "core/units/overlay.hpp"
#include "tests/core/units/random_edits.hpp"

/// Random edits of programs, and what has to hold after each.
namespace ridgeline::units::random_edits {

/// Edits per test: a share by default, as many as RIDGELINE_UNITS_EDITS says.
inline int edits_wanted(int usual) {
  const char* wanted = std::getenv("RIDGELINE_UNITS_EDITS");
  return wanted != nullptr ? std::atoi(wanted) : usual;
}

/// What every program must keep, whatever was edited.
inline void check_program(const Program& program) {
  const Volumes& v = program.volumes;
  const double rounding = 1e-8 * v.stock + 2e-3;
  EXPECT_NEAR(v.overlap_undeclared, 0, rounding);
  if (program.removed.empty()) {
    EXPECT_NEAR(v.left, 0, rounding);
  }
  EXPECT_NEAR(v.units - v.overlap_declared - v.overlap_undeclared + v.left + v.unexplained,
              v.stock - v.product, 1e-6 * v.product + rounding);
  const Region T = difference_of(program.stock, program.product.shadow);
  for (const Unit& unit : program.units) {
    if (!is_turned(unit)) continue;
    SCOPED_TRACE(std::string(name(unit.kind)) + " " + std::to_string(unit.number) + " " +
                 std::string(name(unit.state)));
    EXPECT_LT(volume(difference_of(unit.region, T)), rounding);
    if (unit.state == State::Edited || is_empty(unit.region)) continue;
    const Region figure = figure_region(unit);
    EXPECT_LT(volume(intersection_of(figure, program.product.shadow)), rounding);
    EXPECT_LT(volume(difference_of(unit.region, figure)), rounding);
  }
}

/// No extension of another unit enters an edited unit that has none itself.
inline void check_edited_cores(const Program& program) {
  for (const Unit& edited : program.units) {
    if (edited.state != State::Edited || !is_turned(edited)) continue;
    if (symmetric_difference(edited.region, edited.core) > 1e-3) continue;
    for (const Unit& unit : program.units) {
      if (unit.state != State::Auto || !is_turned(unit)) continue;
      EXPECT_LT(volume(intersection_of(edited.core, unit.region)),
                1e-8 * program.volumes.stock + 2e-3)
          << unit.number << " in " << edited.number;
    }
  }
}

/// Which products the programs are of: given ones alone, or every second one made at random.
enum class Mix { GivenOnly, WithRandom };

/// Programs of several edits in a row, `wanted` edits in all.
inline void run(const std::vector<Product>& parts, std::uint64_t seed, int wanted, Mix mix) {
  shapes::Random random(seed);
  int done = 0;
  double kept = 0;
  for (int k = 0; done < wanted; ++k) {
    SCOPED_TRACE("program " + std::to_string(k));
    PlanJob job;
    const int turn = mix == Mix::GivenOnly ? k : k / 2;
    if (mix == Mix::GivenOnly || k % 2 == 0)
      job.product = parts[static_cast<std::size_t>(turn) % parts.size()];
    else
      job.product = product(random, k % 4 == 1 ? 0.5 : 0);
    const Box s = box(job.product.shadow);
    const auto along = [&] { return shapes::between(random, -0.1, 1.1) * s.z1; };
    job.split = Split{along(), along(), shapes::between(random, 0, 0.2) * s.z1,
                      shapes::between(random, 0, 0.2) * s.z1};
    Program program = plan(job);
    check_program(program);
    const int rounds = shapes::pick(random, 1, 4);
    for (int i = 0; i < rounds && done < wanted; ++i) {
      SCOPED_TRACE("edit " + std::to_string(i));
      const std::vector<Edit> edits = any(random, program);
      program = edit(program, edits);
      check_program(program);
      check_edited_cores(program);
      for (const Unit& unit : program.units) kept += unit.state == State::Kept;
      ++done;
      if (::testing::Test::HasFailure()) return;
    }
  }
  EXPECT_EQ(done, wanted);
  EXPECT_GT(kept, 0.3 * wanted);
}

}  // namespace ridgeline::units::random_edits
