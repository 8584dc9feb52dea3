#!/usr/bin/python3
"""Writes the tables of a cohort. usage: summary.py FOLDER PATIENT...

Reads the results of the stages in FOLDER/PATIENT and writes to FOLDER: summary.csv and summary.md with a row per
patient, and volumes.csv with a row per patient and tissue. The summary has a row even for patients without results.
"""
import csv
import json
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "workflow", "example"))
from report import wrong_tissues  # noqa: E402
from stage import printable, shortened  # noqa: E402

STAGES = ("scale", "surface", "mesh")
COLUMNS = ("patient", "state", "error", "warnings", "tissues", "islandsRemoved", "mapVolumeMm3", "meshVolumeMm3",
           "triangles", "tetrahedra", "minimumDihedralDegrees", "maximumDihedralDegrees", "meanMinimumDihedralDegrees",
           "edgesNearTargetPercent", "wrongTissues", "scaleSeconds", "surfaceSeconds", "meshSeconds", "peakMemoryMB",
           "log", "picture")
VOLUME_COLUMNS = ("patient", "label", "tissue", "mapVolumeMm3", "meshVolumeMm3", "meshOverMapPercent")


def read_json(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return json.load(file)


def legible(value):
    """Returns the value as one line of text without characters that would disturb a terminal or a table."""
    return printable(str(value).encode("utf-8", "backslashreplace").decode())


def last_line(file):
    if not os.path.exists(file):
        return "not begun"
    with open(file, encoding="utf-8", errors="backslashreplace") as log:
        lines = log.read().split("\n")
    return shortened(next((line for line in reversed(lines) if line.strip()), "interrupted"))


def voxel_volume(file):
    """Returns the volume of a voxel of an NRRD file in mm^3, from the file's header."""
    with open(file, "rb") as stream:
        header = stream.read(65536).partition(b"\n\n")[0].decode("latin1")
    line = next(line for line in header.split("\n") if line.startswith("space directions:"))
    a, b, c = ([float(x) for x in vector.strip("()").split(",")] for vector in line.split(":", 1)[1].split())
    return abs(a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
               + a[2] * (b[0] * c[1] - b[1] * c[0]))


def volumes(folder, report):
    """Yields a row for each tissue, with its volumes in the prepared map and in the mesh."""
    voxel = voxel_volume(os.path.join(folder, "surface", "prepared.nrrd"))
    in_map = {}
    for structure in report["surface"]["structures"]:
        in_map[structure["label"]] = in_map.get(structure["label"], 0) + structure["voxels"] * voxel
    in_mesh = {tissue["label"]: tissue for tissue in report["mesh"]["quality"]["tissues"]}
    for label in sorted(in_map.keys() | in_mesh.keys()):
        wanted, found = in_map.get(label, 0), in_mesh.get(label, {}).get("volume", 0)
        yield {"label": label, "tissue": in_mesh.get(label, {}).get("name", ""), "mapVolumeMm3": round(wanted, 1),
               "meshVolumeMm3": round(found, 1), "meshOverMapPercent": round(100 * found / wanted, 1) if wanted else ""}


def figures(report, tissues):
    surface, mesh = report["surface"], report["mesh"]["quality"]["whole"]
    return {"tissues": len(surface["topology"]),
            "islandsRemoved": sum(tissue["islandsRemoved"] for tissue in surface["preparation"]["changes"]),
            "mapVolumeMm3": round(sum(tissue["mapVolumeMm3"] for tissue in tissues), 1),
            "meshVolumeMm3": round(sum(tissue["meshVolumeMm3"] for tissue in tissues), 1),
            "triangles": surface["triangles"], "tetrahedra": mesh["tetrahedra"],
            "minimumDihedralDegrees": round(mesh["dihedral"]["minimum"], 1),
            "maximumDihedralDegrees": round(mesh["dihedral"]["maximum"], 1),
            "meanMinimumDihedralDegrees": round(mesh["minimumDihedral"]["mean"], 1),
            "edgesNearTargetPercent": round(100 * mesh["edgesNearTarget"], 1),
            "wrongTissues": len(wrong_tissues(report)),
            "warnings": "; ".join(text for stage in STAGES for text in report[stage].get("warnings", []))}


def row_of(folder, patient):
    """Returns the patient's row and the rows of its tissues. The state is "meshed"; "refused by" a stage, which is
    final; or "lost at" a stage, which the next run tries again."""
    row = {"patient": patient, "state": "meshed"}
    memory = 0
    for stage in STAGES:
        row["log"] = f"{patient}/{stage}.log"
        if not os.path.exists(os.path.join(folder, stage, "run.json")):
            return {**row, "state": f"lost at {stage}", "error": last_line(os.path.join(folder, stage + ".log"))}, []
        run = read_json(folder, stage, "run.json")
        if run["status"]:
            row["log"] = f"{patient}/{run['stage']}.log"
            return {**row, "state": f"refused by {run['stage']}", "error": run["error"]}, []
        row[stage + "Seconds"] = run["seconds"]
        memory = max(memory, run["peakMemory"])
    report = {stage: read_json(folder, stage, "report.json") for stage in STAGES}
    tissues = list(volumes(folder, report))
    picture = f"{patient}/picture/mesh.png"
    if os.path.exists(os.path.join(folder, "picture", "mesh.png")):
        row["picture"] = picture
    return ({**row, **figures(report, tissues), "peakMemoryMB": round(memory / 2 ** 20)},
            [{"patient": patient, **tissue} for tissue in tissues])


def safe_row_of(folder, patient):
    """Returns the same as `row_of`, but for results that cannot be read a row with the state "unreadable", so that the
    other patients' rows are still written."""
    try:
        return row_of(folder, patient)
    except Exception as error:  # pylint: disable=broad-except
        return {"patient": patient, "state": "unreadable",
                "error": f"{type(error).__name__}: {error}; delete {folder} to mesh the patient anew"}, []


def write_csv(file, columns, rows):
    with open(file, "w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, columns, restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows({name: legible(value) for name, value in row.items()} for row in rows)


def markdown(name, row):
    cell = legible(row.get(name, "")).replace("\\", "\\\\").replace("|", "\\|").replace("<", "&lt;")
    if cell and name in ("picture", "log"):
        return f"[![]({cell})]({cell})" if name == "picture" else f"[log]({cell})"
    return cell


def write_markdown(file, rows):
    with open(file, "w", encoding="utf-8") as stream:
        for cells in (COLUMNS, ("---",) * len(COLUMNS), *([markdown(name, row) for name in COLUMNS] for row in rows)):
            stream.write("| " + " | ".join(cells) + " |\n")


def main():
    folder, *patients = sys.argv[1:]
    found = [safe_row_of(os.path.join(folder, patient), patient) for patient in patients]
    rows = [row for row, _ in found]
    os.makedirs(folder, exist_ok=True)
    write_csv(os.path.join(folder, "summary.csv"), COLUMNS, rows)
    write_csv(os.path.join(folder, "volumes.csv"), VOLUME_COLUMNS, [row for _, tissues in found for row in tissues])
    write_markdown(os.path.join(folder, "summary.md"), rows)
    failed = [row for row in rows if row["state"] != "meshed"]
    print(f"{len(rows) - len(failed)} of {len(rows)} patients meshed, see {os.path.join(folder, 'summary.md')}")
    for row in failed:
        print(legible(f"{row['patient']}: {row['state']}: {row['error']}"))


if __name__ == "__main__":
    main()
