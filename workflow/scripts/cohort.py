"""Answers the Snakefile's questions about a cohort: its patients, the files that a stage reads, and its command."""
import os
import re
import shlex
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "example"))
from configuration import ConfigurationError, patients_of, with_placeholders  # noqa: E402
from options import (PROGRAMS, TRUTHS, OptionError, check_value, flag_named, flags_by_stage, is_taken,  # noqa: E402
                     values_of_list)

SETTINGS = {"folder", "threads", "pictures", "options", "patients"}
PATIENT_NAME = re.compile(r"\w[\w.-]*", re.ASCII)
NO_WILDCARDS = re.compile(r"[^{}]*")  # Snakemake takes braces as wildcards
TABLES = ("summary.csv", "summary.md", "volumes.csv")


def values_of(option):
    return option if isinstance(option, list) else [option]


def threads_of(text):
    if not re.fullmatch("[1-9][0-9]{0,3}", text, re.ASCII):
        raise ConfigurationError(f"threads: {text}, expected a whole number from 1 on")
    return int(text)


def truth_of(name, text):
    if not isinstance(text, str) or text.lower() not in TRUTHS:
        raise ConfigurationError(f"{name}: {text}, expected true or false")
    return TRUTHS[text.lower()]


class Cohort:
    """The patients of a configuration, with their checked options.

    `config` consists of texts, lists and mappings. Its members are folder, threads, pictures (whether they are drawn),
    options (those of all patients) and patients (see `patients_of`). Raises ConfigurationError for other members or
    values, and for options that no program takes."""

    def __init__(self, config):
        try:
            self.flags = flags_by_stage()
        except OptionError as error:
            raise ConfigurationError(str(error)) from None
        for name in config:
            if name not in SETTINGS:
                raise ConfigurationError(f"unknown member {name}, expected {', '.join(sorted(SETTINGS))}")
        self.folder = config.get("folder", "cohort")
        if not isinstance(self.folder, str) or not self.folder.strip() or not NO_WILDCARDS.fullmatch(self.folder):
            raise ConfigurationError("folder: expected the name of a folder for the results, without { and }")
        self.threads = threads_of(config.get("threads", "2"))
        self.has_pictures = truth_of("pictures", config.get("pictures", "true"))
        common = config.get("options") or {}
        if not isinstance(common, dict):
            raise ConfigurationError("options: expected a mapping of options")
        self.patients = {name: self.patient(name, patient, common)
                         for name, patient in patients_of(config.get("patients")).items()}

    def patient(self, name, patient, common):
        """Returns the patient's map and options after checking them. Its own options override those in `common`."""
        if not PATIENT_NAME.fullmatch(name) or name in TABLES:
            raise ConfigurationError(f"patient {name!r}, expected a name of letters, digits, _ - and .")
        if not isinstance(patient, dict) or not isinstance(patient.get("map"), str) or not patient["map"]:
            raise ConfigurationError(f"patient {name} has no map")
        own = {option: value for option, value in patient.items() if option != "map"}
        self.check("options", with_placeholders(common, name, patient["map"]))
        self.check(f"patient {name}", with_placeholders(own, name, patient["map"]))
        options = {**with_placeholders({**common, **own}, name, patient["map"]), "map": patient["map"]}
        for file in (text for option in options.values() for text in values_of(option) if isinstance(text, str)):
            if os.path.exists(file) and not NO_WILDCARDS.fullmatch(file):
                raise ConfigurationError(f"patient {name}: {file}, expected a path without {{ and }}, which are "
                                         "Snakemake's")
        return options

    def check(self, where, options):
        try:
            for name, option in options.items():
                if name == "threads":
                    raise OptionError("threads is the same for all, expected outside of options and patients")
                flag = flag_named(name, self.flags)
                for value in values_of(option):
                    if not isinstance(value, str):
                        raise OptionError(f"{name}: expected a value or a list of values")
                    check_value(name, flag, value)
        except OptionError as error:
            raise ConfigurationError(f"{where}: {error}") from None

    def flags_for(self, stage, patient):
        """Returns (name, Flag) for each option that the patient has and the stage takes."""
        options = self.patients[patient]
        return [(name, flag) for name, flag in self.flags[stage].items()
                if name in options and is_taken(stage, name, options)]

    def files(self, stage, patient):
        """Returns the input files of a stage that exist. Missing files are left out here, so that the program reports
        them and its message appears in the table."""
        options = self.patients[patient]
        files = [file for name, flag in self.flags_for(stage, patient) if flag.is_input
                 for value in values_of(options[name]) for file in values_of_list(flag, value)]
        if stage != "mesh":
            files.append(options["map"])
        return [file for file in files if os.path.exists(file)]

    def options(self, stage, patient, folder):
        for name, flag in self.flags_for(stage, patient):
            for value in values_of(self.patients[patient][name]):
                if flag.kind == "boolean":
                    yield from ["--" + name] if TRUTHS[value.lower()] else []
                else:
                    yield from ["--" + name, os.path.join(folder, value) if flag.is_output else value]

    def has_null_displacement(self, patient):
        return any(name in self.patients[patient]
                   for name in ("nullDisplacementRadius", "nullDisplacementPathDistance"))

    def command(self, stage, patient, folder):
        """Returns the stage's command without --threads. It writes to `folder`, which lies beside the folders of the
        earlier stages."""
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
