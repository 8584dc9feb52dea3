"""Draws the records of benchmark.py and writes them into Docs/Benchmarks.md."""
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGE = os.path.join(ROOT, "Docs", "Benchmarks.md")
PICTURE = os.path.join(ROOT, "Docs", "images", "benchmarks.png")
BEGIN, END = "<!-- begin of what benchmark.py writes -->\n", "<!-- end of what benchmark.py writes -->\n"
COLORS = {"SurgicalMesher": "#4c78a8", "CGAL": "#d1495b", "TetGen": "#8a8f98"}
MARKERS = {"jhu189": "o", "shapes": "s"}


def slope(x, y):
    """Returns the exponent of the power law through points, by least squares of logarithms, or None for fewer than two
    points."""
    return None if len(x) < 2 else float(np.polyfit(np.log(x), np.log(y), 1)[0])


def curves(records, quantity):
    """Maps (program, threads, series) to arrays of interface faces, in ascending order, and of values of `quantity`."""
    groups = {}
    for record in records:
        groups.setdefault((record["program"], record["threads"], record["series"]), []).append(
            (record["input"]["interfaceFaces"], record[quantity]))
    return {key: np.array(sorted(points), float).T for key, points in groups.items()}


def draw_panel(axes, records, quantity, unit, title):
    for (program, threads, series), (x, y) in sorted(curves(records, quantity).items()):
        exponent = slope(x, y)
        label = f"{program}, {series}" + ("" if exponent is None else f": slope {exponent:.2f}")
        color = next(color for name, color in COLORS.items() if program.startswith(name))
        if threads == 1:
            axes.plot(x, y / unit, color=color, marker=MARKERS.get(series, "^"), label=label, markersize=6,
                      linestyle="-" if series == "jhu189" else "--")
    axes.set(xscale="log", yscale="log", xlabel="voxel faces between tissues")
    axes.set_title(title, fontsize=13)
    axes.grid(which="major", color="#e3e5e8")
    axes.legend(fontsize=8.5, frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.13), ncol=2)
    axes.spines[["top", "right"]].set_visible(False)


def draw(records):
    figure, (time, memory) = plt.subplots(1, 2, figsize=(13, 6.4), dpi=100)
    draw_panel(time, records, "processorSeconds", 1, "processor time (s), one thread")
    draw_panel(memory, records, "peakMemory", 2 ** 20, "peak memory (MB), one thread")
    figure.tight_layout()
    figure.canvas.draw()
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3])
    image.quantize(256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(PICTURE, optimize=True)
    plt.close(figure)


def table(header, rows):
    lines = [header, ["---"] + ["---:"] * (len(header) - 1), *rows]
    return "".join("| " + " | ".join(str(cell) for cell in line) + " |\n" for line in lines)


def run_rows(records):
    for r in records:
        quality = r["quality"]
        yield [r["case"], r["program"], r["threads"], f"{r['input']['interfaceFaces']:,}", f"{r['seconds']:.1f}",
               f"{r['processorSeconds']:.1f}", f"{r['peakMemory'] / 2 ** 20:,.0f}", f"{quality['tetrahedra']:,}",
               f"{quality['minimumDihedral']:.1f} .. {quality['maximumDihedral']:.1f}",
               f"{quality['below20Degrees']:,}", f"{quality['edgesNearTarget']:.3f}",
               f"{quality['wrongTissues']} of {r['input']['tissues']}"]


def stage_rows(records):
    for r in records:
        if r["program"] == "SurgicalMesher":
            yield [r["case"], r["threads"]] + [f"{r['stages'][stage][key] / unit:,.1f}" for stage in
                                               ("scale", "surface", "mesh")
                                               for key, unit in (("seconds", 1), ("processorSeconds", 1),
                                                                 ("peakMemory", 2 ** 20))]


def slope_rows(records):
    time, memory = curves(records, "processorSeconds"), curves(records, "peakMemory")
    for program, threads, series in sorted(time):
        key = (program, threads, series)
        values = [slope(*curve[key]) for curve in (time, memory)]
        if None not in values:
            yield [f"{program}, {series}", threads] + [f"{value:.2f}" for value in values]


def machine_text(machine):
    return (f"{machine['processors']} processors ({machine['processor']}), {machine['memory'] / 2 ** 30:.0f} GB, "
            f"{machine['system']}")


def write(records):
    """Draws the records and writes their tables between the two marks of the page."""
    draw(records)
    commits = sorted({record["commit"] for record in records})
    machines = sorted({machine_text(record["machine"]) for record in records})
    text = (f"On {' and '.join(machines)}; commit {', '.join(commits)}.\n\n"
            "![Processor time and memory over the size of the interface](images/benchmarks.png)\n\n"
            "Exponents of the power laws through the points, over the number of voxel faces between tissues:\n\n"
            + table(["program and input", "threads", "processor time", "memory"], slope_rows(records))
            + "\nEvery run:\n\n"
            + table(["input", "program", "threads", "faces", "s", "processor s", "MB", "tetrahedra", "dihedral angles",
                     "under 20 degrees", "edges near target", "wrong tissues"], run_rows(records))
            + "\nOurs, by stage (seconds, processor seconds, MB):\n\n"
            + table(["input", "threads"] + [f"{stage} {unit}" for stage in ("scale", "surface", "mesh")
                                            for unit in ("s", "processor s", "MB")], stage_rows(records)))
    with open(PAGE, encoding="utf-8") as file:
        page = file.read()
    begin, end = page.index(BEGIN) + len(BEGIN), page.index(END)
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(page[:begin] + "\n" + text + "\n" + page[end:])
