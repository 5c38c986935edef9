#pragma once
#include "report/plot_runner.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flowslide {

struct Figure {
  std::string_view name;     ///< file name without ending
  std::string_view caption;  ///< one sentence for the report
};

inline constexpr std::array kFigures{
    Figure{"final_displacement",
           "Final geometry, coloured by displacement from the undeformed section."},
    Figure{"final_materials", "Final geometry by material."},
    Figure{"final_strength",
           "Softening of the liquefied material: strength at the end / at transfer."},
    Figure{"section_before", "Section before the flow: liquefied zone, strength and water table."},
    Figure{"zone_history", "How liquefaction developed, and the time of transfer."},
    Figure{"flow_history", "Runout, speed, energies and residuals of the balances."}};

struct DrawnFigures {
  std::vector<Figure> figures;  ///< in the order of kFigures; those without data are left out
  std::string problem;          ///< why there are none, and what to do; empty if drawn
};

/// Writes figures/<name>.svg and .png into a report folder that holds data/, runout.csv and
/// zone.csv (write_plot_data, tables.hpp). What is run are the scripts inside this program, never
/// those of a folder. `python` is the interpreter; if empty, the first of `python3` on the PATH and
/// /usr/bin/python3 that has matplotlib.
/// `only` names the figures to draw, all if empty. A missing or failing interpreter is a problem of
/// the result; FileError is thrown if disk or memory do not suffice, Interrupted on a request.
DrawnFigures draw_figures(const std::filesystem::path& folder,
                          const std::optional<std::string>& python, const FigureLimits& limits,
                          const std::vector<std::string>& only = {});

}  // namespace flowslide
