#pragma once
#include <array>
#include <string_view>

/// What reads bytes of other people, one function each: they return for every input, whether it is
/// read or refused with an Error, and anything else is a finding. libFuzzer calls them
/// (tests/fuzz/entry.cpp), and the unit suite calls them with the kept corpora (replay.cpp).
namespace flowslide::fuzz {

using Input = std::string_view;

void workflow(Input);      ///< a workflow file: YAML, graph, settings of every stage
void overrides(Input);     ///< --set options, one a line
void recorder(Input);      ///< a text recorder, its scan and its summary
void opensees(Input);      ///< switches, tables of a mesh and eight recorders
void gmsh(Input);          ///< a mesh of gmsh
void mesh_tables(Input);   ///< switches and tables of nodes and elements
void motion(Input);        ///< switches and an earthquake record
void terrain(Input);       ///< an ESRI ASCII grid
void store(Input);         ///< changes of a good file of every kind
void run_lock(Input);      ///< run.lock
void stage_record(Input);  ///< stage.json, facts.json, audit.json
void study(Input);         ///< a study file and a table that it names
void study_plan(Input);    ///< study.json
void job_array(Input);     ///< what a job array is to compute, and what squeue says
void run_page(Input);      ///< the page of a run, whose player gets fewer states
void checkpoint(Input);    ///< changes of good checkpoints, with the checksum made anew

struct Target {
  std::string_view name;
  void (*run)(Input);
};
inline constexpr std::array kTargets{Target{"workflow", workflow},
                                     Target{"overrides", overrides},
                                     Target{"recorder", recorder},
                                     Target{"opensees", opensees},
                                     Target{"gmsh", gmsh},
                                     Target{"mesh_tables", mesh_tables},
                                     Target{"motion", motion},
                                     Target{"terrain", terrain},
                                     Target{"store", store},
                                     Target{"run_lock", run_lock},
                                     Target{"stage_record", stage_record},
                                     Target{"run_page", run_page},
                                     Target{"checkpoint", checkpoint},
                                     Target{"study", study},
                                     Target{"study_plan", study_plan},
                                     Target{"job_array", job_array}};

}  // namespace flowslide::fuzz
