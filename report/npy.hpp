#pragma once
#include <filesystem>
#include <vector>

namespace flowslide {

/// A table of doubles, row by row.
struct Table {
  std::size_t columns = 0;
  std::vector<double> values;
  void add(std::initializer_list<double> row) { values.insert(values.end(), row); }
  [[nodiscard]] std::size_t rows() const { return columns ? values.size() / columns : 0; }
};

/// Writes a table in NumPy's format, version 1.0, readable by numpy.load. Throws FileError.
void write_npy(const std::filesystem::path& path, const Table& table);

}  // namespace flowslide
