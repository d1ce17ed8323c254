#include "demos/cli/numbers.h"

#include <gtest/gtest.h>

#include "core/model/errors.h"
#include "demos/cli/text_table.h"

namespace limber::demos {
namespace {

TEST(ParseNumber, TakesDecimalsAndFractions) {
  EXPECT_EQ(parse_number("1/60", "x"), 1.0 / 60.0);
  EXPECT_EQ(parse_number("0.25", "x"), 0.25);
  EXPECT_EQ(parse_number("-1e-3", "x"), -1e-3);
  EXPECT_EQ(parse_number("+2", "x"), 2.0);
  EXPECT_EQ(parse_number("1.5/3", "x"), 0.5);
}

TEST(ParseNumber, RefusesEverythingElse) {
  for (const char* text : {"", " 1", "1 ", "1/0", "0/0", "1/", "/60", "1/2/3", "nan", "inf", "-inf",
                           "1e999", "1,5", "0x10", "1s", "++1", "1/nan"}) {
    EXPECT_THROW(parse_number(text, "--tick"), InputError) << text;
  }
}

TEST(ParseNumber, NamesTheOption) {
  try {
    parse_number("abc", "--tick");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostic.text(),
              "--tick: 'abc' is not a finite number; write it like 0.25, 1e-3 or 1/60");
  }
}

TEST(ParseWhole, KeepsToTheRange) {
  EXPECT_EQ(parse_whole("2", 2, 50, "--noise"), 2);
  EXPECT_EQ(parse_whole("50", 2, 50, "--noise"), 50);
  for (const char* text : {"1", "51", "2.5", "", "five", "99999999999"}) {
    EXPECT_THROW(parse_whole(text, 2, 50, "--noise"), InputError) << text;
  }
}

TEST(ParseAssignment, SplitsAtTheFirstEqualsSign) {
  const auto [name, value] = parse_assignment("height=3/2");
  EXPECT_EQ(name, "height");
  EXPECT_EQ(value, 1.5);
  for (const char* text : {"height", "=1", "height=", "height=tall", "a=b=1"}) {
    EXPECT_THROW(parse_assignment(text), InputError) << text;
  }
}

TEST(Grouped, SetsACommaBeforeEveryThreeDigits) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(1234567), "1,234,567");
}

TEST(TextTable, AlignsItsColumns) {
  TextTable table;
  table.add_row({"name", "n"});
  table.add_row({"a", "100"});
  table.add_row({"longer"});
  EXPECT_EQ(table.text(1), " name      n\n a       100\n longer\n");
}

}  // namespace
}  // namespace limber::demos
