#include "jobs/text.hpp"

#include <gtest/gtest.h>

namespace ridgeline::jobs {
namespace {

// The forms that RFC 3629 names as invalid, each beside the nearest valid one.
TEST(Text, InvalidUtf8IsReplacedByteByByte) {
  const std::string valid =
      "a\x7F \xC2\x80 \xE0\xA0\x80 \xED\x9F\xBF \xF0\x90\x80\x80 \xF4\x8F\xBF\xBF";
  EXPECT_TRUE(is_valid_utf8(valid));
  EXPECT_EQ(valid_utf8(valid), valid);
  for (const std::string invalid :
       {"\x80", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80",
        "\xFF", "\xC3", "\xE2\x82"}) {
    EXPECT_FALSE(is_valid_utf8("x" + invalid));
    std::string expected = "x";
    for (std::size_t i = 0; i < invalid.size(); ++i) expected += "\xEF\xBF\xBD";
    EXPECT_EQ(valid_utf8("x" + invalid), expected);
  }
}

TEST(Text, ShorteningKeepsWholeCharacters) {
  EXPECT_EQ(shortened("abc", 3), "abc");
  EXPECT_EQ(shortened("a\xC3\xA4\xC3\xA4", 2), "a...");
  EXPECT_EQ(shortened("a\xC3\xA4\xC3\xA4", 3), "a\xC3\xA4...");
}

TEST(Text, NearestNamesComeFirst) {
  EXPECT_EQ(nearest("tube40", {"block", "TUBE-40", "tube-4", "tube-41"}, 2),
            (std::vector<std::string>{"TUBE-40", "tube-4"}));
}

TEST(Text, PointerTokensAreEscaped) {
  EXPECT_EQ(pointer_token("a/b~c"), "a~1b~0c");  // RFC 6901 section 3
}

}  // namespace
}  // namespace ridgeline::jobs
