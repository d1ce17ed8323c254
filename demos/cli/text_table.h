#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace limber::demos {

// Columns of plain text: the first flush left, the others flush right, two blanks between them.
class TextTable {
 public:
  void add_row(std::vector<std::string> cells);
  std::string text(int indent = 2) const;

 private:
  std::vector<std::size_t> widths() const;

  std::vector<std::vector<std::string>> rows_;
};

std::string grouped(std::uint64_t number);  // 1,234,567 in every locale
std::string significant(double number);     // four digits

}  // namespace limber::demos
