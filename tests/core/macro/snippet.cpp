#include "tests/core/macro/snippet.hpp"

namespace ridgeline::macro {

void expect_as_said(const Snippet& snippet) {
  Options options;
  options.profile = profile(snippet.control).value();
  options.profile.offset_memory = snippet.offset_memory;
  const Result result = run(snippet.text, options);
  ASSERT_EQ(result.alarm ? result.alarm->number : 0, snippet.alarm)
      << (result.alarm ? result.alarm->message : "");
  if (result.alarm) {
    EXPECT_EQ(result.alarm->line, snippet.line) << result.alarm->message;
  }
  for (const auto& [number, value] : snippet.variables) {
    SCOPED_TRACE(number);
    ASSERT_TRUE(result.variables.contains(number));
    EXPECT_FALSE(result.variables.at(number).vacant);
    EXPECT_NEAR(result.variables.at(number).number, value, 1e-12);
  }
}

}  // namespace ridgeline::macro
