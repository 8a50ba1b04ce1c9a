/// Lines of a table as cells, and cells as numbers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pipelines {

constexpr char runs_of_blanks = ' ';  ///< as a delimiter

struct Cell {
  std::string text;  ///< without quotes and blanks around it
  int column = 1;    ///< column of its first byte, 1-based
};

/// A quoted cell may hold the delimiter, and a quote as two quotes.
/// @param delimiter  ';', ',', a tab, or runs_of_blanks
std::vector<Cell> cells_of(std::string_view line, char delimiter);

/// Titles between blanks: two and more stand between columns or, where that gives another number of them than
/// `n_wanted`, one; what is in brackets belongs to the title before it.
std::vector<Cell> titles_between_blanks(std::string_view line, std::size_t n_wanted);

struct CellNumber {
  enum class Kind {
    whole,  ///< neither point nor comma
    with_point,
    with_comma,
    /// A decimal comma, or one between thousands: one to three digits, not 0, stand before it and three
    /// behind.
    comma_in_doubt,
    empty,
    not_finite,
    thousands,    ///< separators of thousands
    other_comma,  ///< a comma where a decimal point is wanted
    other_point,  ///< a point where a decimal comma is wanted
    time_of_day,
    odd_character,
    no_number
  };
  Kind kind = Kind::no_number;
  double value = 0;
  bool is_number() const { return kind <= Kind::comma_in_doubt; }
};

/// @param decimal  '.', ',', or 0 for either
CellNumber number_of(const std::string& cell, char decimal);

}  // namespace pipelines
