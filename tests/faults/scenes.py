"""Short runs of every stage and of the commands that write files, on a dam of a few elements."""

import gzip
import math
import os
from dataclasses import dataclass, field

STAGES = {
    "motion": """
  motion:
    uses: motion.prepare
    with: {record: shaking.txt.gz, unit: g, dt: 0.05 s, baseline: {degree: 1}}
""",
    "mesh": """
  mesh:
    uses: mesh.section
    with:
      size: 16 m
      materials: {embankment: {tag: 167}, tailings: {tag: 168}, foundation: {tag: 170}}
      blocks:
        foundation:
          outline: [[-64 m, -8 m], [80 m, -8 m], [80 m, 0 m], [-64 m, 0 m]]
          material: foundation
        tailings:
          outline: [[-64 m, 0 m], [0 m, 0 m], [0 m, 16 m], [-64 m, 16 m]]
          material: tailings
        dam:
          outline: [[0 m, 0 m], [48 m, 0 m], [16 m, 16 m], [0 m, 16 m]]
          material: embankment
      sets: {toe_drain: {line: [[40 m, 0 m], [48 m, 0 m]]}}
""",
    "shake": """
  shake:
    uses: fem.run
    in: {mesh: mesh.mesh, motion: motion.motion}
    with:
      end: 0.4 s
      output_interval: 0.1 s
      opensees_recorders: true
      materials:
        tailings:
          density: 1870 kg/m3
          void_ratio: 0.99
          permeability: [7.1e-6 m/s, 7.1e-9 m/s]
          pm4sand: {Dr: 0.35, G0: 476, hpo: 2.70}
        embankment:
          density: 1690 kg/m3
          void_ratio: 1.20
          permeability: [1.0e-6 m/s, 1.0e-6 m/s]
          linear_elastic: {youngs_modulus: 50 MPa, poisson_ratio: 0.3}
        foundation:
          density: 1900 kg/m3
          void_ratio: 0.80
          permeability: [1.0e-5 m/s, 1.0e-5 m/s]
          linear_elastic: {youngs_modulus: 80 MPa, poisson_ratio: 0.3}
      water: {table: [[-64 m, 16 m], [0 m, 16 m], [48 m, 0 m], [80 m, 0 m]]}
      base: {motion: within}
""",
    "zone": """
  zone:
    uses: transfer.zone
    in: {history: shake.history}
    with:
      when: gravity
      zone: all
      liquefiable: [tailings]
      pond_surface: 16 m
      windows: {pond: {from: -40 m, to: -20 m}}
      strength: {table: [[25 kPa, 3 kPa], [100 kPa, 6 kPa]]}
""",
    "map": """
  map:
    uses: transfer.map
    in: {history: shake.history, zone: zone.zone}
    with:
      cell: 4 m
      box: {left: -64 m, right: 80 m, bottom: -8 m, top: 40 m}
      c_soft_ratio: 0.5
      audit: {enforce: false}
      materials:
        embankment:
          mohr_coulomb: {youngs_modulus: 20 MPa, poisson_ratio: 0.3, cohesion: 5 kPa, friction_angle: 35 deg}
        tailings:
          mohr_coulomb: {youngs_modulus: 20 MPa, poisson_ratio: 0.3, cohesion: 1 kPa, friction_angle: 30 deg}
          liquefied: {youngs_modulus: 20 MPa, poisson_ratio: 0.45, residual_strain: 1.0}
        foundation:
          linear_elastic: {youngs_modulus: 20 MPa, poisson_ratio: 0.3}
          counts_for_runout: false
""",
    "flow": """
  flow:
    uses: mpm.run
    in: {particles: map.particles}
    with:
      cell: 4 m
      end: 3 s
      frame_interval: 1 s
      left_roller: -64 m
      ground: {surface: [[-64 m, -8 m], [80 m, -8 m], [80 m, 0 m]], friction: 0.3}
      softening: {reference_length: 1.25 m}
""",
    "report": """
  report:
    uses: report.runout
    in: {history: shake.history, zone: zone.zone, particles: map.particles, audit: map.audit, flow: flow.history}
    with: {figures: false}
""",
    "shake_again": """
  shake_again:
    uses: import.opensees
    with:
      mesh: {nodes: recorders/nodeinfo.dat, elements: recorders/elementinfo.dat}
      materials:
        embankment: {tag: 167, density: 1690 kg/m3}
        tailings: {tag: 168, density: 1870 kg/m3}
        foundation: {tag: 170, density: 1900 kg/m3}
      units: {length: m, time: s, stress: kPa}
      gravity: {stress: recorders/Gstress.out, strain: recorders/Gstrain.out, pore_pressure: recorders/GporePressure.out}
      shaking:
        displacement: recorders/displacement.out
        velocity: recorders/velocity.out
        pore_pressure: recorders/porePressure.out
        stress: recorders/stress.out
        strain: recorders/strain.out
""",
    "mesh_again": """
  mesh_again:
    uses: import.mesh
    with: {gmsh: square.msh}
""",
}
BEFORE = {"motion": [], "mesh": [], "shake": ["motion", "mesh"]}
CHAIN = ["motion", "mesh", "shake", "zone", "map", "flow", "report"]

GMSH = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
6
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
$EndNodes
$Elements
2
1 3 2 5 1 1 2 5 4
2 3 2 5 1 2 3 6 5
$EndElements
"""

# Rows of gravity alone: four stages.
STUDY = """schema: 1
name: faults
study:
  workflow: zone.yaml
  set: {stages.shake.with.opensees_recorders: false}
  vary: {pond: {setting: stages.zone.with.pond_surface, values: [VALUES]}}
"""

# Draws what `plot` asks for without Matplotlib.
PYTHON = """#!/bin/sh
for last; do :; done
echo "<svg/>" > "$last"
"""

POINT = """material:
  pm4sand: {Dr: 0.35, G0: 476, hpo: 2.70}
stress: {vertical: 100 kPa, k0: 0.5}
simple_shear: {csr: 0.15, stop_strain: 0.02}
"""


@dataclass
class Scene:
    """A command to disturb. ROOT stands for the folder of the worker."""

    name: str
    command: list
    before: list = field(default_factory=list)  # commands that make the state it starts from
    clock: float = 0.0  # so that some checkpoints are written
    continued: bool = False  # starts from the checkpoint of a run that was stopped
    kills_only: bool = False  # 100 kills at random calls and 20 at and after renames
    damage: str = ""  # a file of a finished run that loses a byte, by the end of its path
    codes: tuple = ()  # exit codes that a failed call may also end with
    stage: str = ""  # of a finished study: the command is the job that makes it again


CONTROL = Scene("careless", ["ROOT/made"])


def run_command(stages, folder="out"):
    return ["run", f"ROOT/in/{stages}.yaml", "--out", f"ROOT/{folder}", "--threads", "1"]


def scenes():
    result = []
    for i, stage in enumerate(CHAIN):
        before = [run_command(s) for s in BEFORE.get(stage, [CHAIN[i - 1]])]
        clock = {"shake": 0.4, "flow": 0.13}.get(stage, 0.0)
        name = STAGES[stage].split("uses: ")[1].split("\n")[0]
        result.append(Scene(name, run_command(stage), before, clock))
        if clock:
            result.append(Scene(name + " continued", run_command(stage), before, clock, True))
    result.append(Scene("all stages", run_command("report"), clock=0.2, kills_only=True))
    result.append(Scene("import.opensees", run_command("shake_again")))
    result.append(Scene("import.mesh", run_command("mesh_again")))
    whole = [run_command("report")]
    result.append(Scene("nothing to do", run_command("report"), whole))
    result.append(Scene("damaged zone", run_command("report"), whole, damage="zone.h5"))
    result.append(Scene("report again", ["report", "ROOT/out"], whole))
    for file, target in [("particles.h5", "points.csv"), ("particles.h5", "points.vtp"),
                         ("mpm.h5", "flow.pvd"), ("mpm.h5", "flow.vtp"),
                         ("shake/*/history.h5", "shaking.pvd"), ("shake/*/history.h5", "texts"),
                         ("mesh.h5", "mesh.vtu"), ("mesh.h5", "tables"),
                         ("motion.h5", "motion.csv"), ("in/square.msh", "square.h5"),
                         ("in/shaking.csv", "shaking.h5")]:
        source = f"ROOT/{file}" if file.startswith("in/") else f"FIND/{file}"
        result.append(Scene(f"convert to {target}", ["convert", source, f"ROOT/made/{target}", "--unit", "m/s2"],
                            whole))
    study = ["study", "run", "ROOT/in/study.yaml", "--out", "ROOT/out", "--jobs", "1", "--quiet"]
    # What cannot be read back of a stage is a row that failed.
    result.append(Scene("study", study, codes=(1,)))
    result.append(Scene("study, all done", study, [study], codes=(1,)))
    result.append(Scene("study report", ["study", "report", "ROOT/out", "--whole"], [study]))
    result.append(Scene("stage of a study", [], [study], stage="zone"))
    sent = ["study", "run", "ROOT/in/study.yaml", "--out", "ROOT/out", "--quiet", "--executor", "slurm"]
    result.append(Scene("task of a study", ["study", "part", "ROOT/out/slurm/1/rows.json", "0"], [sent],
                        codes=(1,)))
    result.append(Scene("study clean", ["study", "clean", "ROOT/out"],
                        [[w.replace("study.yaml", "more.yaml") for w in study], study]))
    result.append(Scene("plot", ["plot", "ROOT/in/shake.yaml", "--out", "ROOT/made/section.svg",
                                 "--python", "ROOT/in/python"]))
    result.append(Scene("point", ["point", "ROOT/in/point.yaml", "--csv", "ROOT/made/point.csv"]))
    result.append(Scene("docs", ["docs", "ROOT/made/docs"]))
    return result


# In place of the first texts: sixteen times as many elements and points, and larger files.
FINE = {"size: 16 m": "size: 4 m", "cell: 4 m": "cell: 2 m", "end: 3 s": "end: 1 s",
        "frame_interval: 1 s": "frame_interval: 0.25 s"}


def write_inputs(folder, fine=False):
    """Inputs of all scenes; texts of recorders are added once fem.run has made them."""
    os.makedirs(folder, exist_ok=True)
    for i, stage in enumerate(CHAIN):
        chain = [stage] if stage in ("motion", "mesh") else CHAIN[: i + 1]
        write_workflow(folder, stage, chain, fine)
    for stage in ("shake_again", "mesh_again"):
        write_workflow(folder, stage, [stage])
    shaking = [0.2 * math.sin(2.5 * 2 * math.pi * 0.05 * i) for i in range(41)]
    with open(f"{folder}/shaking.txt.gz", "wb") as file:
        file.write(gzip.compress("".join(f"{a:.6f}\n" for a in shaking).encode(), mtime=0))
    with open(f"{folder}/shaking.csv", "w") as file:
        file.write("time [s],acceleration [m/s2]\n")
        file.writelines(f"{0.05 * i:.2f},{9.81 * a:.6f}\n" for i, a in enumerate(shaking))
    for name, text in (("square.msh", GMSH), ("point.yaml", POINT), ("python", PYTHON),
                       ("study.yaml", STUDY.replace("VALUES", "16 m")),
                       ("more.yaml", STUDY.replace("VALUES", "16 m, 15 m"))):
        with open(f"{folder}/{name}", "w") as file:
            file.write(text)
    os.chmod(f"{folder}/python", 0o755)


def write_workflow(folder, name, chain, fine=False):
    text = "schema: 1\nname: faults\nstages:" + "".join(STAGES[s] for s in chain)
    for coarse, other in FINE.items() if fine else ():
        text = text.replace(coarse, other)
    with open(f"{folder}/{name}.yaml", "w") as file:
        file.write(text)
