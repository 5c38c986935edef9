#pragma once
#include "section/layout.hpp"

namespace flowslide {

/// Grids of all blocks with common nodes on common sides; no tags yet. `divisions` are those of
/// divide(). Throws InputError for a block whose grid folds over.
QuadMesh block_grids(const Layout& layout, const SectionConfig& config,
                     const std::vector<int>& divisions);

}  // namespace flowslide
