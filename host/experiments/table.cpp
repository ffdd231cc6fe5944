#include "host/experiments/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "host/io/files.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

void append_line(std::string& text, const std::vector<std::string>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    check(cells[i].find_first_of(",\n\r") == std::string::npos,
          "a table's cell holds no comma or line break");
    text += (i > 0 ? "," : "") + cells[i];
  }
  text += '\n';
}

std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.emplace_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  return cells;
}

std::pair<std::string, std::string> note_of(std::string_view line, const std::string& source) {
  const std::size_t colon = line.find(": ");
  if (!line.starts_with("# ") || colon == std::string_view::npos)
    throw InputError(source, "note", std::string(line), "\"# name: value\"");
  return {std::string(line.substr(2, colon - 2)), std::string(line.substr(colon + 2))};
}

}  // namespace

std::size_t Table::column(std::string_view name) const {
  const auto found = std::ranges::find(columns, name);
  if (found == columns.end()) throw LogicError("a table has no column " + std::string(name));
  return static_cast<std::size_t>(found - columns.begin());
}

std::string to_csv(const Table& table) {
  std::string text;
  for (const auto& [name, value] : table.notes) {
    check(name.find_first_of(":\n\r") == std::string::npos,
          "a note's name holds no colon or line break");
    check(value.find_first_of("\n\r") == std::string::npos, "a note is one line");
    text += "# " + name + ": " + value + "\n";
  }
  append_line(text, table.columns);
  for (const std::vector<std::string>& row : table.rows) {
    check(row.size() == table.columns.size(), "a row has as many cells as the table has columns");
    append_line(text, row);
  }
  return text;
}

Table table_from_csv(std::string_view text, const std::string& source) {
  Table table;
  for (std::size_t begin = 0, line_number = 1; begin < text.size(); ++line_number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (table.columns.empty() && line.starts_with('#')) {
      table.notes.push_back(note_of(line, source));
    } else if (table.columns.empty()) {
      table.columns = cells_of(line);
    } else if (table.rows.emplace_back(cells_of(line));
               table.rows.back().size() != table.columns.size()) {
      throw InputError(source, "line " + std::to_string(line_number),
                       std::to_string(table.rows.back().size()) + " cells",
                       std::to_string(table.columns.size()) + " as there are columns");
    }
  }
  if (table.columns.empty()) throw InputError(source, "columns", "none", "a line with their names");
  return table;
}

Table load_table(const std::filesystem::path& file) {
  return table_from_csv(read_file(file), file.string());
}

Table joined(const std::vector<Table>& tables) {
  check(!tables.empty(), "at least one table to join");
  Table all{tables[0].notes, tables[0].columns, {}};
  for (const Table& table : tables) {
    check(table.columns == all.columns && table.notes.size() == all.notes.size(),
          "tables of one kind are joined");
    for (std::size_t i = 0; i < all.notes.size(); ++i) {
      check(table.notes[i].first == all.notes[i].first, "tables of one kind are joined");
      std::string& value = all.notes[i].second;
      if ((" " + value + " ").find(" " + table.notes[i].second + " ") == std::string::npos)
        value += " " + table.notes[i].second;
    }
    all.rows.insert(all.rows.end(), table.rows.begin(), table.rows.end());
  }
  return all;
}

std::string number_text(double value) { return fmt::format("{:.6g}", value); }

const std::string& text_in(const Table& table, std::size_t row, std::string_view column) {
  return table.rows[row][table.column(column)];
}

double number_in(const Table& table, std::size_t row, std::string_view column) {
  const std::string& text = text_in(table, row, column);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw InputError("results", std::string(column), text, "a number");
  return value;
}

}  // namespace edgescout
