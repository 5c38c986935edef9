#pragma once
#include "core/progress.hpp"
#include "model/ground_motion.hpp"
#include "model/history.hpp"
#include "model/mpm_history.hpp"
#include "model/particle_set.hpp"
#include "model/zone.hpp"
#include "report/config.hpp"
#include "report/facts.hpp"
#include "report/settings_text.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flowslide {

struct ReportInputs {
  const FemHistory& history;
  const LiquefactionZone& zone;
  const ParticleSet& particles;  ///< as transferred
  std::filesystem::path audit;   ///< JSON of the transfer
  const MpmHistory& flow;
  /// What identifies the run, as (name, text) rows: workflow, versions, hashes of the inputs.
  std::vector<std::pair<std::string, std::string>> provenance;
  std::vector<std::string> warnings = {};   ///< of the stages before, one sentence each
  std::vector<ToldStage> stages = {};       ///< that the report builds on, in their order
  std::optional<GroundMotion> motion = {};  ///< that shook the section, if there was one
  std::string date = {};                    ///< of the report, "2026-11-28"; empty: not said
};

/// Writes into the existing or new folder `out`: report.md, report.html, facts.json, runout.csv,
/// zone.csv, figures/, data/ (what the figures are drawn from), and flow.pvd and zone.pvd for
/// ParaView. Figures that cannot be drawn become a warning in the facts and in the report. Throws
/// InputError if the inputs do not belong together, FileError, Interrupted.
ReportFacts write_report(const ReportInputs& inputs, const ReportConfig& config,
                         const std::filesystem::path& out, const Progress& progress = {});

}  // namespace flowslide
