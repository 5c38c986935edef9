#pragma once
#include "model/section_mesh.hpp"
#include "report/workflow_plot.hpp"
#include "workflows/engine/graph.hpp"

#include <memory>

namespace flowslide {

/// The section of a workflow with what its stages will do there.
struct SectionView {
  std::shared_ptr<const SectionMesh> section;  ///< null if only a run can tell
  WorkflowPlot plot;
};

SectionView view_section(const Workflow& workflow);

}  // namespace flowslide
