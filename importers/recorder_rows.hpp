#pragma once
#include "importers/opensees.hpp"
#include "importers/recorder_columns.hpp"
#include "importers/recorder_text.hpp"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace flowslide {

/// One recorder: where it is, what its columns mean and what the first pass found.
struct Recorder {
  std::filesystem::path path;
  ColumnLayout layout;
  RecorderScan scan;
};

/// Reads chosen rows of a recorder in ascending order. The recorder must outlive the cursor.
class RowCursor {
 public:
  explicit RowCursor(const Recorder& recorder) : recorder_(&recorder), reader_(recorder.path) {}

  /// Columns of a row, counted from 0, valid until the next call. Throws FileError if the row is
  /// not the one that the first pass saw.
  const std::vector<double>& seek(std::size_t row);

 private:
  const Recorder* recorder_;
  RecorderReader reader_;
  std::vector<double> values_;
};

/// The four readers below fill arrays that already have one entry per node or element; `factor`
/// converts the file unit to SI.
void read_pressure(const ColumnLayout& layout, const std::vector<double>& row, double factor,
                   std::vector<double>& out);
void read_vectors(const ColumnLayout& layout, const std::vector<double>& row, double factor,
                  std::vector<Vec2>& out);
void read_stress(const ColumnLayout& layout, const std::vector<double>& row, double factor,
                 const SigmaZz& rule, std::vector<Stress<2>>& out);
void read_strain(const ColumnLayout& layout, const std::vector<double>& row,
                 std::vector<StrainIncrement<2>>& out);

}  // namespace flowslide
