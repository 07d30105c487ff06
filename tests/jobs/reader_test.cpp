#include "jobs/reader.hpp"

#include "tests/jobs/refusal_of.hpp"

namespace ridgeline::jobs {
namespace {

using Json = nlohmann::json;

TEST(Range, EndsAreInOrOutAsDeclared) {
  struct Case {
    Range range;
    bool min, max;
  };
  for (const Case& c : {Case{between(1, 2, "mm"), true, true}, Case{above(1, 2, "mm"), false, true},
                        Case{inside(1, 2, "mm"), false, false}}) {
    EXPECT_EQ(contains(c.range, 1), c.min);
    EXPECT_EQ(contains(c.range, 2), c.max);
    EXPECT_TRUE(contains(c.range, 1.5));
    EXPECT_FALSE(contains(c.range, 0.999));
    EXPECT_FALSE(contains(c.range, 2.001));
    EXPECT_FALSE(contains(c.range, std::numeric_limits<double>::quiet_NaN()));
  }
  EXPECT_EQ(text(above(0, 1000, "mm")), "greater than 0 and at most 1000 mm");
}

TEST(Reader, RefusalNamesFieldValueAndLimit) {
  const Json document = {{"tool", {{"radius", -1}}}};
  Object tool = Object(Value(document)).required("tool").object();
  const Error error = refusal_of([&] { tool.number("radius", above(0, 1000, "mm")); });
  EXPECT_EQ(error.code(), ErrorCode::BadInput);
  EXPECT_EQ(error.details().field, "/tool/radius");
  EXPECT_EQ(error.details().value, "-1");
  EXPECT_EQ(error.details().limit, "greater than 0 and at most 1000 mm");
  EXPECT_STREQ(error.what(), "/tool/radius must be greater than 0 and at most 1000 mm, is -1");
}

// Every reading function meets every type of value; it takes those of its row only.
TEST(Reader, WrongTypesAreRefused) {
  enum class E { A };
  static constexpr Choices<E, 1> names{{{"a", E::A}}};
  const std::vector<Json> values = {
      nullptr, true, 1, 1.5, "a", "2", Json::array(), Json::array({1, 2, 3}), Json::object(), ""};
  struct Row {
    const char* name;
    void (*read)(const Value&);
    std::vector<int> taken;  // indices into values
  };
  const std::vector<Row> rows = {
      {"number", [](const Value& v) { v.number(); }, {2, 3}},
      {"number_or_text", [](const Value& v) { v.number_or_text(); }, {2, 3, 5}},
      {"integer", [](const Value& v) { v.integer(0, 9); }, {2}},
      {"boolean", [](const Value& v) { v.boolean(); }, {1}},
      {"string", [](const Value& v) { v.string(); }, {4, 5, 9}},
      {"name", [](const Value& v) { v.name(); }, {4, 5}},
      {"choice", [](const Value& v) { v.choice(names); }, {4}},
      {"vector3", [](const Value& v) { v.vector3(); }, {7}},
      {"direction", [](const Value& v) { v.direction(); }, {7}},
      {"numbers", [](const Value& v) { v.numbers(); }, {6, 7}},
      {"array", [](const Value& v) { v.array(); }, {6, 7}},
      {"object", [](const Value& v) { v.object(); }, {8}},
  };
  int refused = 0;
  for (const Row& row : rows) {
    for (int i = 0; i < static_cast<int>(values.size()); ++i) {
      SCOPED_TRACE(std::string(row.name) + " of " + values[static_cast<std::size_t>(i)].dump());
      const Value value(values[static_cast<std::size_t>(i)], "/x");
      if (std::ranges::find(row.taken, i) != row.taken.end()) {
        EXPECT_NO_THROW(row.read(value));
        continue;
      }
      const Error error = refusal_of([&] { row.read(value); });
      EXPECT_EQ(error.code(), ErrorCode::BadInput);
      EXPECT_EQ(error.details().field, "/x");
      ++refused;
    }
  }
  EXPECT_EQ(refused, 12 * 10 - 20);
}

TEST(Reader, ElementsAreNamedByTheirIndex) {
  const Json document = {{"p", {1, 2, "z"}}};
  const Value p = Object(Value(document)).required("p");
  EXPECT_EQ(refusal_of([&] { p.vector3(); }).details().field, "/p/2");
  EXPECT_EQ(refusal_of([&] { p.numbers(); }).details().field, "/p/2");
}

TEST(Reader, WholeNumbersMayBeWrittenAsDecimals) {
  const Json whole = 8000.0;
  const Json broken = 8000.5;
  const Json huge = 1e300;
  EXPECT_EQ(Value(whole).integer(0, 9000), 8000);
  EXPECT_THROW(Value(broken).integer(0, 9000), Error);
  EXPECT_THROW(Value(huge).integer(0, 9000), Error);
}

TEST(Reader, NumericTextHoldsOneNumberOnly) {
  for (const char* text : {"1.25", "+1.25", "125e-2"}) {
    const Json json = text;
    EXPECT_EQ(Value(json).number_or_text(), 1.25);
  }
  for (const char* text : {"", " 1", "1 ", "1,5", "1mm", "nan", "inf", "1e999", "0x10", "--1"}) {
    SCOPED_TRACE(text);
    const Json json = text;
    EXPECT_THROW(Value(json).number_or_text(), Error);
  }
}

TEST(Reader, NamesHaveNoControlCharacters) {
  for (const std::string& name :
       {std::string("a\nb"), std::string("a\0b", 3), std::string(65, 'a')}) {
    const Json json = name;
    EXPECT_THROW(Value(json).name(), Error);
  }
  const Json umlaut = "B\xC3\xBCgel 4 (links)";
  EXPECT_EQ(Value(umlaut).name(), "B\xC3\xBCgel 4 (links)");
}

TEST(Reader, UnknownKeysAreRefusedWithTheNearestKnown) {
  const Json document = {{"width", 1}, {"tolerence", 0.1}};
  Object object{Value(document, "/job")};
  object.number("width", any_number);
  object.optional("tolerance");
  const Error error = refusal_of([&] { object.finish(); });
  EXPECT_EQ(error.details().field, "/job/tolerence");
  EXPECT_NE(std::string(error.what()).find("nearest known: tolerance"), std::string::npos);
}

TEST(Reader, MissingKeysAreNamed) {
  const Json document = Json::object();
  Object object{Value(document)};
  const Error error = refusal_of([&] { object.required("a/b"); });
  EXPECT_EQ(error.details().field, "/a~1b");
  EXPECT_EQ(error.details().value, "missing");
}

TEST(Reader, ExclusiveKeysAreRefusedTogetherOnly) {
  const Json both = {{"axis", 1}, {"angle", 2}};
  const Json one = {{"angle", 2}};
  Object first{Value(both)}, second{Value(one)};
  EXPECT_EQ(refusal_of([&] { first.exclude("axis", "angle"); }).details().field, "/angle");
  EXPECT_NO_THROW(second.exclude("axis", "angle"));
}

}  // namespace
}  // namespace ridgeline::jobs
