#!/usr/bin/python3
"""The table of a cohort. usage: summary.py FOLDER PATIENT...

Writes summary.csv and summary.md into FOLDER, a row per patient, from what the stages left in FOLDER/PATIENT.
"""
import csv
import json
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "workflow", "example"))
from report import wrong_tissues  # noqa: E402

STAGES = ("scale", "surface", "mesh")
COLUMNS = ("patient", "state", "error", "tissues", "islandsRemoved", "triangles", "tetrahedra", "minimumDihedral",
           "maximumDihedral", "edgesNearTarget", "wrongTissues", "scaleSeconds", "surfaceSeconds", "meshSeconds",
           "peakMemoryMB")


def read_json(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return json.load(file)


def last_line(file):
    if not os.path.exists(file):
        return "not begun"
    with open(file, encoding="utf-8", errors="replace") as log:
        lines = log.read().split("\n")
    return next((line for line in reversed(lines) if line.strip()), "interrupted")


def figures(folder):
    report = {stage: read_json(folder, stage, "report.json") for stage in STAGES}
    surface, mesh = report["surface"], report["mesh"]["quality"]["whole"]
    return {"tissues": len(surface["topology"]),
            "islandsRemoved": sum(tissue["islandsRemoved"] for tissue in surface["preparation"]["changes"]),
            "triangles": surface["triangles"], "tetrahedra": mesh["tetrahedra"],
            "minimumDihedral": round(mesh["dihedral"]["minimum"], 1),
            "maximumDihedral": round(mesh["dihedral"]["maximum"], 1),
            "edgesNearTarget": round(mesh["edgesNearTarget"], 3), "wrongTissues": len(wrong_tissues(report))}


def row_of(folder, patient):
    """State: meshed; refused by a stage, which is a result; or lost at a stage, which the next run tries again."""
    row = {"patient": patient, "state": "meshed"}
    memory = 0
    for stage in STAGES:
        if not os.path.exists(os.path.join(folder, stage, "run.json")):
            return {**row, "state": f"lost at {stage}", "error": last_line(os.path.join(folder, stage + ".log"))}
        run = read_json(folder, stage, "run.json")
        if run["status"]:
            return {**row, "state": f"refused by {run['stage']}", "error": run["error"]}
        row[stage + "Seconds"] = run["seconds"]
        memory = max(memory, run["peakMemory"])
    return {**row, **figures(folder), "peakMemoryMB": round(memory / 2 ** 20)}


def write_csv(file, rows):
    with open(file, "w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, COLUMNS, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def write_markdown(file, rows):
    with open(file, "w", encoding="utf-8") as stream:
        for cells in (COLUMNS, ("---",) * len(COLUMNS), *([row.get(name, "") for name in COLUMNS] for row in rows)):
            stream.write("| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |\n")


def main():
    folder, *patients = sys.argv[1:]
    rows = [row_of(os.path.join(folder, patient), patient) for patient in patients]
    os.makedirs(folder, exist_ok=True)
    write_csv(os.path.join(folder, "summary.csv"), rows)
    write_markdown(os.path.join(folder, "summary.md"), rows)
    failed = [row for row in rows if row["state"] != "meshed"]
    print(f"{len(rows) - len(failed)} of {len(rows)} patients meshed, see {os.path.join(folder, 'summary.md')}")
    for row in failed:
        print(f"{row['patient']}: {row['state']}: {row['error']}")


if __name__ == "__main__":
    main()
