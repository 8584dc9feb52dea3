"""Reads a cohort's configuration as text. YAML would guess the types of values, and the name 010 would become 8."""
import csv
import glob
import os
import re

import yaml

MAP_ENDINGS = (".seg.nrrd", ".nii.gz", ".nii", ".nrrd", ".nhdr", ".mha", ".mhd")


class ConfigurationError(ValueError):
    """An error in the configuration; its message is one line."""


class TextLoader(yaml.BaseLoader):
    """Loads scalars as the text that the file holds, and refuses keys that occur twice."""

    def construct_mapping(self, node, deep=False):
        keys = [self.construct_object(key, deep=True) for key, _ in node.value]
        for key in keys:
            if not isinstance(key, str):
                raise ConfigurationError(f"line {node.start_mark.line + 1}: a name is not text")
            if keys.count(key) > 1:
                raise ConfigurationError(f"{key} is there twice")
        return super().construct_mapping(node, deep=True)


def read_file(file):
    """Returns the mapping in a YAML or JSON file; its values are texts, lists and mappings."""
    try:
        with open(file, encoding="utf-8") as stream:
            config = yaml.load(stream, TextLoader)  # safe: this loader makes no objects of other types
    except ConfigurationError as error:
        raise ConfigurationError(f"{file}: {error}") from None
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise ConfigurationError(f"{file}: " + " ".join(str(error).split())) from None
    if config in ("", None):
        return {}
    if not isinstance(config, dict):
        raise ConfigurationError(f"{file}: expected a mapping with folder, options and patients")
    return config


def merged(first, second):
    """Merges two mappings, also within each other's mappings; where both have a value, that of `second` is taken."""
    result = dict(first)
    for name, value in second.items():
        both = isinstance(value, dict) and isinstance(result.get(name), dict)
        result[name] = merged(result[name], value) if both else value
    return result


def as_text(value):
    if isinstance(value, dict):
        return {str(name): as_text(member) for name, member in value.items()}
    if isinstance(value, list):
        return [as_text(member) for member in value]
    return "" if value is None else str(value)


def read_configuration(files, given, loaded):
    """Returns the configuration as text; later files override earlier ones, and --config overrides all files.

    `given` is the configuration as Snakemake made it from the files and its option --config, and `loaded` is what
    Snakemake reads from the files alone. Members that differ between the two come from --config."""
    config = {}
    for file in files:
        config = merged(config, read_file(file))
    overridden = {name: as_text(value) for name, value in given.items() if name not in loaded or value != loaded[name]}
    return merged(config, overridden)


def stem_of(file):
    """Returns the name of the map's file without folder, extension and a final _dseg."""
    name = os.path.basename(file)
    ending = next((ending for ending in MAP_ENDINGS if name.lower().endswith(ending)), "")
    return re.sub(r"_dseg$", "", name[:len(name) - len(ending)])


def patient_of(file):
    """Returns a name for the patient whose map this is, the file's stem. Each run of characters that are not allowed in
    names becomes one _."""
    return re.sub(r"^\W+|[^\w.-]+", "_", stem_of(file), flags=re.ASCII)


def from_maps(where, files):
    patients = {}
    for file in sorted(files):
        name = patient_of(file)
        if name in patients:
            raise ConfigurationError(f"patients: {where}: {patients[name]['map']} and {file} are both called {name}")
        patients[name] = {"map": file}
    if not patients:
        raise ConfigurationError(f"patients: {where}: no label map found")
    return patients


def from_bids(folder):
    """Returns the patients whose discrete segmentations (sub-*_dseg.nii.gz) lie anywhere in a BIDS folder."""
    found = [os.path.join(top, name) for top, _, names in os.walk(folder) for name in names
             if re.fullmatch(r"sub-.*_dseg\.nii(\.gz)?", name)]
    return from_maps(f"{folder}, expected a BIDS folder with sub-*_dseg.nii.gz", found)


def from_table(file):
    """Reads the patients from a table with the columns patient and map and a column per option. Empty fields are
    options that are not given."""
    try:
        with open(file, encoding="utf-8-sig", newline="") as stream:
            rows = list(csv.reader(stream, delimiter="\t" if file.endswith(".tsv") else ","))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ConfigurationError(f"patients: {file}: {error}") from None
    header = [name.strip() for name in rows[0]] if rows else []
    if not {"patient", "map"} <= set(header) or len(set(header)) < len(header):
        raise ConfigurationError(f"patients: {file}:1: expected a header row with patient, map and options, each once")
    patients = {}
    for number, row in enumerate(rows[1:], 2):
        fields = dict(zip(header, (field.strip() for field in row)))
        if not any(fields.values()):
            continue
        if len(row) > len(header):
            raise ConfigurationError(f"patients: {file}:{number}: {len(row)} fields, expected {len(header)}")
        name = fields.pop("patient", "")
        if name in patients:
            raise ConfigurationError(f"patients: {file}:{number}: {name} is there twice")
        patients[name] = {option: value for option, value in fields.items() if value}
    return patients


def patients_of(wanted):
    """Returns a mapping from each patient's name to its map and options. `wanted` is such a mapping, a pattern of
    the names of label maps, a table, or a BIDS folder."""
    if isinstance(wanted, str) and wanted:
        if os.path.isdir(wanted):
            return from_bids(wanted)
        if wanted.lower().endswith((".csv", ".tsv")):
            return from_table(wanted)
        return from_maps(wanted, glob.glob(wanted, recursive=True))
    if not isinstance(wanted, dict) or not wanted:
        raise ConfigurationError("no patients, expected --configfile FILE with `patients`: a mapping, a pattern of "
                                 "label maps, a .csv file or a BIDS folder")
    return wanted


def with_placeholders(options, patient, map_file):
    """Returns the options with their placeholders replaced: {patient} by the patient's name, {folder} by the folder of
    its map, and {file} by the name of that map without folder and extension."""
    meanings = {"patient": patient, "folder": os.path.dirname(map_file) or ".", "file": stem_of(map_file)}

    def filled(value):
        if isinstance(value, list):
            return [filled(member) for member in value]
        if not isinstance(value, str):
            return value
        return re.sub("{(patient|folder|file)}", lambda name: meanings[name[1]], value)
    return {name: filled(value) for name, value in options.items()}
