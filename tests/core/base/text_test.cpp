#include "core/base/text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace ridgeline {
namespace {

TEST(Text, IsTheShortestThatReadsBackTheSame) {
  EXPECT_EQ(text(0.1), "0.1");
  EXPECT_EQ(text(20, "mm"), "20 mm");
  EXPECT_EQ(std::stod(text(1. / 3)), 1. / 3);
  EXPECT_EQ(text(std::numeric_limits<double>::quiet_NaN(), "mm"), "nan mm");
}

}  // namespace
}  // namespace ridgeline
