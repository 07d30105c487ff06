#include "core/units/edit.hpp"

#include "tests/core/units/edit_checks.hpp"
#include "tests/core/units/products.hpp"

namespace ridgeline::units {
namespace {

TEST(EditProperty, NothingIsLeftOverlapsOrRunsIntoTheProduct) {
  random_edits::run({products::flanged_shaft()}, 2010, random_edits::edits_wanted(1500),
                    random_edits::Mix::WithRandom);
}

}  // namespace
}  // namespace ridgeline::units
