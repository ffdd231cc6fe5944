// Rows of results with what they were made with: a CSV file whose first lines are "# name: value".
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace edgescout {

// name and value, in the order they are written
using Notes = std::vector<std::pair<std::string, std::string>>;

struct Table {
  Notes notes;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // as many cells as columns

  std::size_t column(std::string_view name) const;  // LogicError where there is none of this name
};

// Columns and cells must hold no comma and no line break, notes no line break and their names no
// colon: LogicError otherwise.
std::string to_csv(const Table& table);
// InputError naming `source` and the line: no line of columns, a row of another length.
Table table_from_csv(std::string_view text, const std::string& source);
Table load_table(const std::filesystem::path& file);

// The rows of all tables, which have the same columns and notes; of a note that differs all values,
// joined by a blank.
Table joined(const std::vector<Table>& tables);

// As results are written: six significant digits.
std::string number_text(double value);
// InputError naming the column where the text is no number.
double number_in(const Table& table, std::size_t row, std::string_view column);
const std::string& text_in(const Table& table, std::size_t row, std::string_view column);

}  // namespace edgescout
