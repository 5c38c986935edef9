#pragma once
#include "model/history.hpp"

namespace flowslide {

/// A FemHistory of a run that may be killed and continued. While it is written, `path`.partial is a
/// folder with the frames in a file that only grows; a resumed run compares with their checksums
/// those that its checkpoint knows of and drops the others. finish() makes the HDF5 file in one
/// pass, so that its bytes do not depend on interruptions. Throws FileError, and NumericsError for
/// frames that are not finite.
class ResumableHistoryWriter {
 public:
  /// @param frames already there and kept; 0 starts anew
  ResumableHistoryWriter(const std::filesystem::path& path, const QuadMesh& mesh,
                         const std::vector<HistoryMaterial>& materials, const HistoryOrigin& origin,
                         const FemFrame& gravity, std::size_t frames);
  ~ResumableHistoryWriter();
  ResumableHistoryWriter(const ResumableHistoryWriter&) = delete;
  ResumableHistoryWriter& operator=(const ResumableHistoryWriter&) = delete;

  void append(const FemFrame& frame);
  /// A frame that has been appended, in this run or before it was interrupted.
  [[nodiscard]] FemFrame frame(std::size_t index);
  /// Frames reach the disk; before a checkpoint that counts them.
  void flush();
  void finish();
  /// Removes the folder, after finish() and when the checkpoint is gone: a kill between the two
  /// leaves a run that can be continued.
  void remove_parts();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace flowslide
