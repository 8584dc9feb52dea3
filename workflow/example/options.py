#!/usr/bin/python3
"""Deals options out to the modules that have them. usage: options.py [--FLAG [VALUE]]...

Prints a line STAGE<TAB>FLAG<TAB>VALUE for every module that has a flag; files to read become absolute. The modules are
asked by --xml. Exit status 2, with one line on stderr, if an option is wrong or joins the stages anyway.
"""
import os
import subprocess
import sys
import xml.etree.ElementTree as xml

PROGRAMS = {"scale": "SurgicalPathScaleCLI", "surface": "SimplexMesherCLI", "mesh": "FuchsTetrahedralizerCLI"}
# Said by whoever runs the stages, one after the other.
RESERVED = {"scale", "edgeLength", "ambient", "preparedLabelMap", "outputLabelMap", "report"}

FOCUS = {"targets", "path", "targetPoint", "pathPoint"}


class OptionError(ValueError):
    """One line."""


class Flag:
    """A long flag: the kind of its parameter; whether it names a file to read, or one to write."""

    def __init__(self, parameter):
        self.kind = parameter.tag
        self.is_input = parameter.findtext("channel") == "input"
        self.is_output = parameter.findtext("channel") == "output"


def flags_by_stage():
    """Stage -> long flag -> Flag."""
    stages = {}
    for stage, program in PROGRAMS.items():
        try:
            description = subprocess.run([program, "--xml"], check=True, stdout=subprocess.PIPE).stdout
        except OSError:
            raise OptionError(f"{program}: not found; expected in SURGICALMESHER_BIN, build/bin or on the path") from None
        stages[stage] = {parameter.findtext("longflag"): Flag(parameter)
                         for parameter in xml.fromstring(description).iterfind("parameters/*")
                         if parameter.find("longflag") is not None}
    return stages


def flag_named(name, stages):
    """The Flag. Raises OptionError if no module has it, or if it is not the user's to give."""
    if name in RESERVED:
        raise OptionError(f"{name} is given by the stages themselves, expected options beside it")
    for flags in stages.values():
        if name in flags:
            return flags[name]
    raise OptionError(f"no module has an option {name}")


def is_taken(stage, name, given):
    """Whether a stage that knows an option takes it, when those of the names `given` are there. Far tissue is marked in
    the map by the first stage; the last one takes targets and paths only to measure the nonlinear distance from them."""
    if stage != "mesh":
        return True
    return not name.startswith("nullDisplacement") and (name not in FOCUS or "nonlinearDistance" in given)


def check_value(name, flag, value):
    if flag.is_output and os.path.basename(value) != value:
        raise OptionError(f"{name} {value}: expected the name of a file, without a folder")


def parsed(words, stages):
    """(name, value) of each option on a command line; value is None for those that take none."""
    words = list(words)
    while words:
        word = words.pop(0)
        if not word.startswith("--"):
            raise OptionError(f"{word}: expected an option")
        name, equals, value = word[2:].partition("=")
        flag = flag_named(name, stages)
        if flag.kind == "boolean":
            value = None
        elif not equals:
            if not words:
                raise OptionError(f"--{name}: expected a value")
            value = words.pop(0)
        if value is not None:
            check_value(name, flag, value)
        yield name, value


def main():
    try:
        stages = flags_by_stage()
        options = list(parsed(sys.argv[1:], stages))
        given = {name for name, _ in options}
        for name, value in options:
            for stage, flags in stages.items():
                if name in flags and is_taken(stage, name, given):
                    text = "" if value is None else os.path.abspath(value) if flags[name].is_input else value
                    print(stage, "--" + name, text, sep="\t")
    except OptionError as error:
        print(f"options: {error}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
