// A table of results with notes, as a CSV file. The first lines are the notes, "# name: value".
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace edgescout {

// Name and value, in the order of the file.
using Notes = std::vector<std::pair<std::string, std::string>>;

struct Table {
  Notes notes;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // as many cells as columns

  std::size_t column(std::string_view name) const;  // LogicError: no column of this name
};

// LogicError: a column or cell with a comma or line break, a note with a line break, the name of a
// note with a colon.
std::string to_csv(const Table& table);
// InputError naming `source` and the line: there is no line of columns, or a row has another
// length.
Table table_from_csv(std::string_view text, const std::string& source);
Table load_table(const std::filesystem::path& file);

// Returns the rows of all tables, which must have the same columns and notes. If a note differs,
// all its values are joined by a blank.
Table joined(const std::vector<Table>& tables);

// Six significant digits, as in all results.
std::string number_text(double value);
// InputError naming the column: the text is no number.
double number_in(const Table& table, std::size_t row, std::string_view column);
const std::string& text_in(const Table& table, std::size_t row, std::string_view column);

}  // namespace edgescout
