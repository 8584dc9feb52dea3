# SPDX-License-Identifier: Apache-2.0
"""Compares what TissueMapperCLI makes of a few random training points with the truth.

    classification.py draws TISSUEMAPPERCLI TRUTH COUNT[,FROM] [--OPTION]... IMAGE...
    classification.py constraints TISSUEMAPPERCLI TRUTH COUNT[,FROM] [--OPTION]... IMAGE...

Makes COUNT draws of twenty random voxels per class; FROM is the number of the first draw. `draws` prints for each draw
the share of the head's voxels that are right, Dice by class, time and memory. `constraints` compares runs with all
constraints (compartments, contiguity of every class of soft tissue, limits on small classes), without limits, without
limits and contiguity, without compartments, and with none. It prints the share of voxels that are right, the false
positives of CSF and muscle in compartments to which they do not belong, and true and false positives by class. TRUTH
has the grid of the images and the labels of simulate.py. Glial matter is not a class, because it has no brightness of
its own.
"""
import json
import os
import sys
import tempfile
import time

import nibabel
import numpy as np

from simulate import HEAD, is_brainweb

POINTS = 20  # per class

# Labels, compartment and limit (mm; 0 for none) of each class. Bone and marrow are one class.
BRAINWEB_CLASSES = {
    "CSF": ([1], "intracranial", 0), "grey matter": ([2], "intracranial", 0),
    "white matter": ([3], "intracranial", 0), "fat": ([4], "extracranial", 0),
    "muscle": ([5], "extracranial", 0), "skin": ([6], "extracranial", 0), "skull": ([7], "bone", 0),
    "connective tissue": ([9], "extracranial", 0)}
PLACES = {"CSF": ("intracranial", 0), "grey matter": ("intracranial", 0),
          "white matter": ("intracranial", 0), "other tissue": ("extracranial", 0),
          "eye muscle": ("intraorbital", 30), "skin": ("extracranial", 0), "skull": ("bone", 0),
          "eye": ("intraorbital", 15), "artery": ("any", 60), "vein": ("any", 30), "optic nerve": ("intraorbital", 10),
          "mucosa": ("extracranial", 30)}


def classes_of(labels):
    if is_brainweb(labels):
        return BRAINWEB_CLASSES
    members = {name: tissue[2] for name, tissue in HEAD.items()}
    members["skull"] = members["skull"] + members.pop("marrow")
    return {name: (members[name], *PLACES[name]) for name in members}


class Truth:
    def __init__(self, file):
        image = nibabel.as_closest_canonical(nibabel.load(file))
        labels = np.asarray(image.dataobj).squeeze().astype(int)
        self.affine = image.affine
        self.classes = classes_of(labels)
        self.number = np.zeros(labels.shape, np.uint8)  # number of each voxel's class, from 1; 0 for no class
        for number, (members, _, _) in enumerate(self.classes.values(), 1):
            self.number[np.isin(labels, members)] = number
        self.head = labels != 0

    def within(self, compartment):
        numbers = [n for n, tissue in enumerate(self.classes.values(), 1) if tissue[1] == compartment]
        return np.isin(self.number, numbers)

    def draw(self, seed, file):
        random = np.random.default_rng(seed)
        points = []
        for number, name in enumerate(self.classes, 1):
            voxels = np.argwhere(self.number == number)
            chosen = nibabel.affines.apply_affine(self.affine, voxels[random.choice(len(voxels), POINTS, replace=False)])
            points += [{"label": name, "position": [-x, -y, z]} for x, y, z in chosen.tolist()]
        markup = {"type": "Fiducial", "coordinateSystem": "LPS", "coordinateUnits": "mm", "controlPoints": points}
        with open(file, "w", encoding="utf-8") as stream:
            json.dump({"markups": [markup]}, stream)


def write_table(truth, file, contiguity, limits):
    with open(file, "w", encoding="utf-8") as stream:
        stream.write("label,name,compartment,contiguity,limit\n")
        for number, (name, (_, compartment, limit)) in enumerate(truth.classes.items(), 1):
            has = contiguity and compartment != "bone"
            stream.write(f"{number},{name},{compartment},{'yes' if has else 'no'},{limit if limits else 0}\n")


def classified(program, truth, seed, folder, options, contiguity=False, limits=False):
    """Runs the program on one draw. Returns the numbers of the classes found on the truth's grid, wall-clock and
    processor seconds, and peak memory (MB)."""
    training, table, output = (os.path.join(folder, name) for name in ("t.mrk.json", "c.csv", "map.nii.gz"))
    truth.draw(seed, training)
    write_table(truth, table, contiguity, limits)
    arguments = [program, "--training", training, "--classes", table]
    images = [option for option in options if not option.startswith("--")]
    arguments += [option for option in options if option.startswith("--")]
    for channel in images[1:]:
        arguments += ["--channel", channel]
    begin = time.monotonic()
    child = os.posix_spawn(program, [*arguments, images[0], output], os.environ,
                           file_actions=[(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0)])
    _, status, usage = os.wait4(child, 0)
    if status:
        raise SystemExit(f"{program} ended with {os.waitstatus_to_exitcode(status)}")
    seconds = time.monotonic() - begin
    found = nibabel.as_closest_canonical(nibabel.load(output))
    return (np.asarray(found.dataobj).squeeze().astype(np.uint8), seconds, usage.ru_utime + usage.ru_stime,
            usage.ru_maxrss / 1000)


def counts(truth, found):
    """Returns for each class the numbers of its true positives, false positives, and voxels in the truth."""
    return {name: (np.sum((found == n) & (truth.number == n)), np.sum((found == n) & (truth.number != n)),
                   np.sum(truth.number == n)) for n, name in enumerate(truth.classes, 1)}


def right_share(truth, found):
    return np.mean((truth.number == found)[truth.head])


def seeds_of(count):
    number, first = (*map(int, count.split(",")), 1)[:2]
    return range(first, first + number)


def draws(program, truth, count, *options):
    truth = Truth(truth)
    print("Dice of " + ", ".join(truth.classes))
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for seed in seeds_of(count):
            found, seconds, work, memory = classified(program, truth, seed, folder, options)
            dice = [2 * hit / (hit + false + true) for hit, false, true in counts(truth, found).values()]
            rows.append([right_share(truth, found), np.mean(dice), *dice])
            print(f"draw {seed:2d}  right {rows[-1][0]:.3f}  mean Dice {rows[-1][1]:.3f}  ("
                  + " ".join(f"{value:.3f}" for value in dice)
                  + f")  {seconds:.0f} s, {work:.0f} s of processor, {memory:.0f} MB", flush=True)
    mean, spread = np.mean(rows, 0), np.std(rows, 0)
    print(f"all {len(rows):2d}   right {mean[0]:.3f} +- {spread[0]:.3f}  mean Dice {mean[1]:.3f} +- {spread[1]:.3f}  ("
          + " ".join(f"{value:.3f}" for value in mean[2:]) + ")")


def constraints(program, truth, count, *options):
    truth = Truth(truth)
    rows = {"all constraints": ([], True, True), "without limits": ([], True, False),
            "nor contiguity": ([], False, False), "without compartments": (["--noCompartments"], True, True),
            "none": (["--noCompartments"], False, False)}
    if not any(limit for _, _, limit in truth.classes.values()):
        del rows["without limits"]
    muscle = next(name for name in truth.classes if "muscle" in name)
    other = {"CSF": truth.within("extracranial") | truth.within("intraorbital"), muscle: truth.within("intracranial")}
    seeds = seeds_of(count)
    with tempfile.TemporaryDirectory() as folder:
        for row, (more, contiguity, limits) in rows.items():
            sums, right, strays = {}, 0, dict.fromkeys(other, 0)
            for seed in seeds:
                found = classified(program, truth, seed, folder, (*options, *more), contiguity, limits)[0]
                right += right_share(truth, found) / len(seeds)
                for name, place in other.items():
                    number = list(truth.classes).index(name) + 1
                    strays[name] += np.sum((found == number) & place) / len(seeds)
                for name, values in counts(truth, found).items():
                    sums[name] = np.add(sums.get(name, 0), np.array(values) / len(seeds))
            print(f"{row:20s}  right {right:.3f}  in the other compartment "
                  + ", ".join(f"{name} {stray:.0f}" for name, stray in strays.items()))
            for name, (hit, false, true) in sums.items():
                print(f"    {name:18s} true positives {hit:8.0f} ({hit / true:.3f})  false {false:8.0f}  Dice "
                      f"{2 * hit / (hit + false + true):.3f}", flush=True)


if __name__ == "__main__":
    commands = {"draws": draws, "constraints": constraints}
    if len(sys.argv) < 5 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    commands[sys.argv[1]](*sys.argv[2:])
