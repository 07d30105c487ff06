#include "jobs/parse.hpp"

#include <string>

#include "tests/jobs/refusal_of.hpp"

namespace ridgeline::jobs {
namespace {

Error refused(const std::string& text) {
  return refusal_of([&] { parse(text); });
}

TEST(Parse, ReadsWhatTheLibraryReads) {
  const std::string text =
      R"( {"a": [1, -2.5e-3, true, null, "\u00e4/~", {}], "b": {"c": []}, "d": 18446744073709551615} )";
  EXPECT_EQ(parse(text), nlohmann::json::parse(text));
}

TEST(Parse, SyntaxErrorsNameLineColumnAndPlace) {
  const Error error = refused("{\n  \"width\": 0.5,\n  \"points\": [1, NaN]\n}");
  EXPECT_EQ(error.code(), ErrorCode::BadInput);
  EXPECT_EQ(error.details().field, "/points/1");
  EXPECT_NE(std::string(error.what()).find("line 3, column 17"), std::string::npos) << error.what();
}

TEST(Parse, EveryBrokenTextIsRefused) {
  for (const char* text : {"",
                           " ",
                           "{",
                           "[1,",
                           "{\"a\":}",
                           "{\"a\" 1}",
                           "{a: 1}",
                           "{\"a\": NaN}",
                           "{\"a\": Infinity}",
                           "{\"a\": -Infinity}",
                           "{\"a\": 01}",
                           "{\"a\": .5}",
                           "{\"a\": +1}",
                           "{\"a\": 0x10}",
                           "{\"a\": 1} x",
                           "// comment\n{}",
                           "{\"a\": \"\x80\"}",
                           "{\"a\": \"\xED\xA0\x80\"}",
                           "%PDF-1.4",
                           "{\"a\": \"\\ud800\"}",
                           "{\"a\": \"tab\there\"}"}) {
    SCOPED_TRACE(text);
    EXPECT_EQ(refused(text).code(), ErrorCode::BadInput);
  }
}

TEST(Parse, NumbersBeyondDoubleAreRefusedWithTheirPlace) {
  for (const char* number : {"1e999", "-1e999", "1e99999999999999999999"}) {
    const Error error = refused(std::string("{\"tool\": {\"radius\": ") + number + "}}");
    EXPECT_EQ(error.details().field, "/tool/radius");
    EXPECT_EQ(error.details().value, number);
  }
}

TEST(Parse, RepeatedKeysAreRefusedInTheirObjectOnly) {
  EXPECT_EQ(refused(R"({"a": {"w": 1, "x/y": 2, "x/y": 3}})").details().field, "/a/x~1y");
  EXPECT_EQ(parse(R"([{"w": 1}, {"w": 2}])").size(), 2);
}

std::string nested(std::size_t levels) {
  return std::string(levels, '[') + std::string(levels, ']');
}

TEST(Parse, DepthIsLimited) {
  EXPECT_NO_THROW(parse(nested(max_document_levels)));
  EXPECT_EQ(refused(nested(max_document_levels + 1)).code(), ErrorCode::BadInput);
  EXPECT_EQ(refused(std::string(3'000'000, '[')).code(), ErrorCode::BadInput);
  std::string objects;
  for (int i = 0; i < 100; ++i) objects += "{\"a\":";
  EXPECT_EQ(refused(objects).code(), ErrorCode::BadInput);
}

TEST(Parse, SizeIsLimited) {
  const std::string spaces(max_document_bytes - 2, ' ');
  EXPECT_NO_THROW(parse("[" + spaces + "]"));
  const Error error = refused("[ " + spaces + "]");
  EXPECT_EQ(error.details().value, "32000001 bytes");
}

}  // namespace
}  // namespace ridgeline::jobs
