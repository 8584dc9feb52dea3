"""What the Snakefile asks about a cohort: its patients, the files that a stage reads, and the command that it runs."""
import os
import re
import shlex
import sys

from snakemake.exceptions import WorkflowError

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "example"))
from options import PROGRAMS, OptionError, check_value, flag_named, flags_by_stage, is_taken  # noqa: E402

SETTINGS = {"folder", "threads", "options", "patients"}
PATIENT_NAME = re.compile(r"[A-Za-z0-9][\w.-]*")


def values_of(option):
    return option if isinstance(option, list) else [option]


class Cohort:
    """`config` has the members folder, threads, options (of all patients) and patients (name -> map and options of its
    own). Raises WorkflowError on anything else, and on options that no program has."""

    def __init__(self, config):
        try:
            self.flags = flags_by_stage()
        except OptionError as error:
            raise WorkflowError(str(error)) from None
        for name in config:
            if name not in SETTINGS:
                raise WorkflowError(f"configuration: unknown member {name}, expected {', '.join(sorted(SETTINGS))}")
        if not isinstance(config.get("patients"), dict) or not config["patients"]:
            raise WorkflowError("configuration: no patients, expected --configfile FILE with a mapping `patients`")
        self.folder = config.get("folder", "cohort")
        self.threads = config.get("threads", 2)
        common = config.get("options") or {}
        self.check("options", common)
        self.patients = {}
        for name, patient in config["patients"].items():
            if not PATIENT_NAME.fullmatch(str(name)):
                raise WorkflowError(f"configuration: patient {name!r}, expected a name of letters, digits, _ - and .")
            if not isinstance(patient, dict) or not isinstance(patient.get("map"), str):
                raise WorkflowError(f"configuration: patient {name} has no map")
            self.check(f"patient {name}", {key: patient[key] for key in patient if key != "map"})
            self.patients[str(name)] = {**common, **patient}

    def check(self, where, options):
        try:
            for name, option in options.items():
                if name == "threads":
                    raise OptionError("threads is the same for all, expected outside of options and patients")
                flag = flag_named(name, self.flags)
                for value in values_of(option):
                    check_value(name, flag, str(value))
        except OptionError as error:
            raise WorkflowError(f"configuration: {where}: {error}") from None

    def flags_for(self, stage, patient):
        """(name, Flag) of the options that the patient has and the stage takes."""
        options = self.patients[patient]
        return [(name, flag) for name, flag in self.flags[stage].items()
                if name in options and is_taken(stage, name, options)]

    def files(self, stage, patient):
        """Input files as they are; missing ones are left to the program, whose message goes into the table."""
        options = self.patients[patient]
        files = [str(value) for name, flag in self.flags_for(stage, patient) if flag.is_input
                 for value in values_of(options[name])]
        if stage != "mesh":
            files.append(options["map"])
        return [file for file in files if os.path.exists(file)]

    def options(self, stage, patient, folder):
        for name, flag in self.flags_for(stage, patient):
            for value in values_of(self.patients[patient][name]):
                if flag.kind == "boolean":
                    yield from ["--" + name] if value else []
                else:
                    yield from ["--" + name, os.path.join(folder, value) if flag.is_output else str(value)]

    def has_null_displacement(self, patient):
        return any(name in self.patients[patient] for name in ("nullDisplacementRadius", "nullDisplacementPathDistance"))

    def command(self, stage, patient, folder):
        """The stage's command but for --threads; it writes into `folder`, whose neighbours are the earlier stages'."""
        root = os.path.dirname(folder)
        scale, surface = os.path.join(root, "scale"), os.path.join(root, "surface")
        label_map = self.patients[patient]["map"]
        words = [PROGRAMS[stage], *self.options(stage, patient, folder), "--report", f"{folder}/report.json"]
        if stage == "scale":
            if self.has_null_displacement(patient):
                words += ["--outputLabelMap", f"{folder}/labels.nrrd"]
            words += [label_map, f"{folder}/scale.nrrd"]
        elif stage == "surface":
            if self.has_null_displacement(patient):
                label_map = f"{scale}/labels.nrrd"
            words += ["--scale", f"{scale}/scale.nrrd", "--preparedLabelMap", f"{folder}/prepared.nrrd",
                      "--ambient", f"{folder}/ambient.vtu", label_map, f"{folder}/surface.vtp"]
        else:
            words += ["--scale", f"{scale}/scale.nrrd", "--ambient", f"{surface}/ambient.vtu",
                      f"{surface}/surface.vtp", f"{folder}/mesh.vtu"]
        return shlex.join(words)
