#include "core/base/error.hpp"

#include <gtest/gtest.h>

namespace ridgeline {
namespace {

// The numbers and names are the wire contract: this table is written by hand from chamfer.md
// section 8.
TEST(Error, NamesOfTheContractKeepTheirNumbers) {
  EXPECT_EQ(name(ErrorCode{1}), "bad_input");
  EXPECT_EQ(name(ErrorCode{5}), "inconsistent_eccentricity");
  EXPECT_EQ(name(ErrorCode{13}), "tolerance_too_small");
}

TEST(Error, EveryCodeIsFoundByItsName) {
  int codes = 0;
  for (int i = 1; i <= 29; ++i, ++codes) EXPECT_EQ(error_code(name(ErrorCode{i})), ErrorCode{i});
  EXPECT_EQ(codes, 29);
  EXPECT_EQ(error_code("no_such_code"), std::nullopt);
}

}  // namespace
}  // namespace ridgeline
