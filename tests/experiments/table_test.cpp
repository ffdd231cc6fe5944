#include "host/experiments/table.h"

#include <gtest/gtest.h>

#include "kernels/error.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

const Table small{{{"seed", "7"}, {"options", "scenes 2; scale: half"}},
                  {"name", "value"},
                  {{"a", "1.5"}, {"b", ""}}};

TEST(Table, IsACsvFileUnderItsNotes) {
  EXPECT_EQ(to_csv(small), "# seed: 7\n# options: scenes 2; scale: half\nname,value\na,1.5\nb,\n");
}

TEST(Table, ComesBackFromItsText) {
  const Table read = table_from_csv(to_csv(small), "text");
  EXPECT_EQ(read.notes, small.notes);
  EXPECT_EQ(read.columns, small.columns);
  EXPECT_EQ(read.rows, small.rows);
  EXPECT_EQ(number_in(read, 0, "value"), 1.5);
}

TEST(Table, ReadsLinesOfBothKinds) {
  const Table read = table_from_csv("a,b\r\n1,2\r\n", "text");
  EXPECT_EQ(read.columns, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(text_in(read, 0, "b"), "2");
}

TEST(Table, NamesWhatIsWrongInAFile) {
  expect_input_error([] { table_from_csv("", "file.csv"); }, {"file.csv", "columns"});
  expect_input_error([] { table_from_csv("# seed: 1\n", "file.csv"); }, {"file.csv", "columns"});
  expect_input_error([] { table_from_csv("#seed 1\na\n", "file.csv"); },
                     {"file.csv", "note", "#seed 1"});
  expect_input_error([] { table_from_csv("# seed: 1\na,b\n1,2\n1\n", "file.csv"); },
                     {"file.csv", "line 4", "found 1 cells", "expected 2"});
  expect_input_error([] { number_in(small, 1, "value"); }, {"value", "a number"});
}

TEST(Table, RefusesCellsThatWouldBreakTheFile) {
  EXPECT_THROW(to_csv({{}, {"a"}, {{"1,2"}}}), LogicError);
  EXPECT_THROW(to_csv({{}, {"a"}, {{"1\n2"}}}), LogicError);
  EXPECT_THROW(to_csv({{}, {"a", "b"}, {{"1"}}}), LogicError);
  EXPECT_THROW(to_csv({{{"seed", "1\n2"}}, {"a"}, {}}), LogicError);
}

TEST(Table, JoinsRowsAndListsNotesThatDiffer) {
  const Table one{{{"seed", "1"}, {"commit", "abc"}}, {"a"}, {{"1"}}},
      two{{{"seed", "1"}, {"commit", "def"}}, {"a"}, {{"2"}}};
  const Table all = joined({one, two, one});
  EXPECT_EQ(all.rows, (std::vector<std::vector<std::string>>{{"1"}, {"2"}, {"1"}}));
  EXPECT_EQ(all.notes, (Notes{{"seed", "1"}, {"commit", "abc def"}}));
}

}  // namespace
}  // namespace edgescout::test
