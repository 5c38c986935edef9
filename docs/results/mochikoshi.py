"""Writes docs/results/mochikoshi.md and its figures: the study against the paper's claims.

    flowslide study run workflows/mochikoshi-study.yaml
    flowslide verify section --json > docs/results/mochikoshi/section.json
    python3 docs/results/mochikoshi.py runs/mochikoshi-study

keeps what it needs of the study in docs/results/mochikoshi/ and writes the page from that. Without
a folder it writes the page again; --out DIR puts everything elsewhere.
"""
import argparse
import json
import pathlib
import sys

sys.dont_write_bytecode = True
import claims
import figures
import study_rows
import tendencies
from causes import CAUSES
from study_rows import Study

HERE = pathlib.Path(__file__).resolve().parent
HEAD = """# The Mochikoshi study against its paper

Written by `docs/results/mochikoshi.py` from a study of `workflows/mochikoshi-study.yaml`; no number here is typed. The claims are those of B. Sordo, E. Rathje and K. Kumar, *Runout of liquefaction-induced tailings dam failure: influence of earthquake motions and residual strength*, Soil Dyn. Earthq. Eng. 194 (2025) 109371, [doi:10.1016/j.soildyn.2025.109371](https://doi.org/10.1016/j.soildyn.2025.109371), in our words. Its records may not be passed on: ours are synthetic motions of the same peak, duration, mean period and strong phase, so single runs can differ where its tendencies hold.
"""
RULE = """## How it is judged

- **reproduced**: our mean over the repeats lies in the paper's range, widened by what its text can be read to: 1 m of depth, 10 m of runout (5 m for the static model), 0.5 s. No runout is less than 0.5 m; "most" and "generally" are two thirds of the rows. What is said of an order or a tendency holds if our number has its sign.
- **not reproduced**: otherwise. The cause, as far as it is known, stands below the table.
- **not comparable**: the paper or the study does not give what would be compared. **not run**: rows are missing.
- A mark `*` says that the scatter could turn the verdict: the range's end lies within two standard errors of our mean, or zero in the 95 % interval, from resampling the rows.

*Scatter* is the standard deviation of one run under disturbances that mean nothing (motion by a millionth, grid within a cell), from its own repeats where there are three or more, else pooled over all repeated rows; for shares, means and ratios it is the 95 % interval. "Depth" is that of liquefaction under the pond, by nodes, in rows of elements of 2.5 m; c_soft stands for its ratio to the residual strength.
"""



def verdict(judged):
    if not judged.comparable:
        return "not comparable"
    if judged.holds is None:
        return "not run"
    return ("reproduced" if judged.holds else "not reproduced") + (" *" if judged.turns else "")


def judge_all(listed, study):
    return [(claim, judged, verdict(judged)) for claim in listed
            for judged in [claim.judge(study)]]


def table(found):
    lines = ["| | claim | paper | here | scatter | verdict |", "|---|---|---|---|---|---|"]
    for claim, judged, word in found:
        here = judged.here or judged.remark
        lines.append(f"| {claim.name} | {claim.words} | {claim.paper} | {here} | {judged.scatter} "
                     f"| {word} |")
    return "\n".join(lines)


def causes(found):
    lines = [f"- **{claim.name}**: {CAUSES.get(claim.name, 'not known.')}"
             for claim, _, word in found if word.startswith("not reproduced")]
    return "\n".join(["Not reproduced, and why as far as known:", "", *lines]) if lines else ""


def counted(found):
    words = [word.removesuffix(" *") for _, _, word in found]
    return ", ".join(f"{words.count(w)} {w}" for w in
                     ("reproduced", "not reproduced", "not comparable", "not run") if w in words)


def cost_text(cost, rows):
    failed = sum(r["state"] == "failed" for r in rows)
    done = sum(r["state"] == "done" for r in rows)
    text = f"{done} rows done, {failed} failed, {len(rows) - done - failed} not run."
    cells = sorted({(r[study_rows.CELL], r["variant"]) for r in rows if r[study_rows.CELL]})
    if cells:
        text += " Cells of the flow: " + ", ".join(f"{c} ({v})" for c, v in cells) + "."
    if not cost.get("sessions"):
        return text + " What the study cost is not recorded."
    return (f"{text} Begun {cost['began']}; {', '.join(cost['programs'])}; "
            f"{', '.join(cost['machines'])}, {', '.join(cost['threads'])} processors. "
            f"{cost['wall_seconds'] / 60:.0f} minutes on the wall, "
            f"{cost['processor_seconds'] / 60:.0f} minutes of processors, in {cost['sessions']} "
            f"session{'s' if cost['sessions'] > 1 else ''}.")


def write_page(out):
    data = out / "mochikoshi"
    rows = study_rows.read_rows(data / "rows.csv")
    study = Study(rows)
    study.section = study_rows.read_section(data / "section.json")
    cost = json.loads((data / "study.json").read_text(encoding="utf-8"))
    for name, (draw, _) in figures.FIGURES.items():
        (data / name).write_text(draw(study), encoding="utf-8")
    response, runout = judge_all(claims.RESPONSE, study), judge_all(claims.RUNOUT, study)
    parts = [HEAD, f"{cost_text(cost, rows)}\n",
             f"Response: {counted(response)}. Runout: {counted(runout)}.\n",
             tendencies.section(data / "tendencies.json"), RULE, "## Response of the section\n", table(response) + "\n", causes(response) + "\n",
             "## Runout\n", table(runout) + "\n", causes(runout) + "\n", "## Figures\n",
             "The rows are in [rows.csv](mochikoshi/rows.csv).\n"]
    parts += [f"![{words}](mochikoshi/{name})\n\n{words}\n"
              for name, (_, words) in figures.FIGURES.items()]
    page = "\n".join(part for part in parts if part.strip())
    (out / "mochikoshi.md").write_text(page, encoding="utf-8")
    print(f"{out / 'mochikoshi.md'}: response {counted(response)}; runout {counted(runout)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("study", nargs="?", type=pathlib.Path, help="folder of a study")
    parser.add_argument("--out", type=pathlib.Path, default=HERE, help="where the page goes")
    args = parser.parse_args()
    data = args.out / "mochikoshi"
    if args.study:
        data.mkdir(parents=True, exist_ok=True)
        study_rows.write_rows(data / "rows.csv", study_rows.gather(args.study))
        text = json.dumps(study_rows.cost(args.study), indent=1) + "\n"
        (data / "study.json").write_text(text, encoding="utf-8")
        kept = data / "tendencies.json"
        kept.unlink(missing_ok=True)
        if (args.study / "analysis.json").is_file():
            analysis = json.loads((args.study / "analysis.json").read_text(encoding="utf-8"))
            kept.write_text(json.dumps(tendencies.keep(analysis), indent=1) + "\n", encoding="utf-8")
    write_page(args.out)


if __name__ == "__main__":
    main()
