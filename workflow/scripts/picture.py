#!/usr/bin/python3
"""Draws a patient's mesh, mesh.png, and scale, scale.png. usage: picture.py FOLDER LOG

FOLDER is made beside the folders of the stages. It stays empty if a stage refused the patient or if nothing can be
drawn; LOG gives the reason. A patient without pictures is still complete, so the exit status is then 0 as well.
"""
import json
import os
import subprocess
import sys

EXAMPLE = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "example")
SECONDS = 1200


def draw(folder):
    sys.path.insert(0, EXAMPLE)
    from pictures import case_of, draw_scale, draw_tetrahedra, drawn
    root = os.path.dirname(os.path.abspath(folder))
    files = {name: os.path.join(root, *path) for name, path in {
        "scale": ("scale", "scale.nrrd"), "scaleReport": ("scale", "report.json"),
        "prepared": ("surface", "prepared.nrrd"), "surface": ("surface", "surface.vtp"),
        "mesh": ("mesh", "mesh.vtu")}.items()}
    for name, function in (("mesh.png", draw_tetrahedra), ("scale.png", draw_scale)):
        drawn(name, lambda file: function(case_of(files), file), os.path.join(folder, name))


def refusal(folder):
    """Returns the reason why there is no mesh, or None if there is one."""
    with open(os.path.join(os.path.dirname(os.path.abspath(folder)), "mesh", "run.json"), encoding="utf-8") as file:
        run = json.load(file)
    return f"no mesh: {run['error']}" if run["status"] else None


def begin(folder, log):
    """Draws in a separate process, because drawing may hang or crash."""
    why = refusal(folder)
    if why:
        log.write(why + "\n")
        return
    python = "/usr/bin/python3"
    command = [python, os.path.join(EXAMPLE, "display.py"), python, os.path.abspath(__file__), "--draw", folder]
    log.flush()
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log) as process:
        try:
            process.wait(SECONDS)
        except subprocess.TimeoutExpired:
            process.terminate()  # display.py then also ends its server and the process that draws; killed, it could not
            raise


def main():
    if sys.argv[1] == "--draw":
        draw(sys.argv[2])
        return
    folder, log_file = sys.argv[1:]
    os.makedirs(folder, exist_ok=True)
    with open(log_file, "w", encoding="utf-8") as log:
        try:
            begin(folder, log)
        except (OSError, ValueError, KeyError, TypeError, subprocess.TimeoutExpired) as error:
            log.write(f"no picture: {error}\n")


if __name__ == "__main__":
    main()
