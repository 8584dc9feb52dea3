#!/usr/bin/python3
"""Distributes options to the modules that have them. usage: options.py [--FLAG [VALUE]]...

Prints a line STAGE<TAB>FLAG<TAB>VALUE for each option and each module that has its flag; names of input files become
absolute. The flags come from the modules' own descriptions (--xml). Ends with status 2 and one line on stderr if an
option is wrong or is one that the scripts set themselves to connect the stages.
"""
import math
import os
import subprocess
import sys
import xml.etree.ElementTree as xml

PROGRAMS = {"scale": "SurgicalPathScaleCLI", "surface": "SimplexMesherCLI", "mesh": "FuchsTetrahedralizerCLI"}
# Options that are set by the script that runs the stages.
RESERVED = {"scale", "edgeLength", "ambient", "preparedLabelMap", "outputLabelMap", "report"}

FOCUS = {"targets", "path", "targetPoint", "pathPoint"}
TRUTHS = {"true": True, "yes": True, "on": True, "1": True, "false": False, "no": False, "off": False, "0": False}


class OptionError(ValueError):
    """An error in an option; its message is one line."""


def number_of(text):
    try:
        value = float(text) if "_" not in text else math.nan
    except ValueError:
        return None
    return value if math.isfinite(value) else None


class Flag:
    """What a long flag accepts, and whether its values name input files or an output file."""

    def __init__(self, parameter):
        self.kind = parameter.tag
        self.is_input = parameter.findtext("channel") == "input"
        self.is_output = parameter.findtext("channel") == "output"
        self.is_list = parameter.get("multiple") == "true"
        self.choices = [element.text for element in parameter.iterfind("element")]
        self.low, self.high = (number_of(parameter.findtext("constraints/" + bound) or "")
                               for bound in ("minimum", "maximum"))

    def expected(self):
        """Describes the accepted values in words."""
        if self.choices:
            return "one of " + ", ".join(self.choices)
        if self.kind == "boolean":
            return "true or false"
        if self.kind == "point":
            return "three numbers x,y,z"
        bounds = [f"{word} {bound:g}" for word, bound in (("from", self.low), ("to", self.high)) if bound is not None]
        return " ".join([{"integer": "a whole number"}.get(self.kind, "a number"), *bounds])

    def accepts(self, text):
        if self.choices:
            return text in self.choices
        if self.kind == "boolean":
            return text.lower() in TRUTHS
        if self.kind == "point":
            numbers = [number_of(part) for part in text.split(",")]
            return len(numbers) == 3 and None not in numbers
        if self.kind not in ("integer", "float", "double"):
            return True
        number = number_of(text)
        return (number is not None and (self.kind != "integer" or text.lstrip("+-").isdigit())
                and (self.low is None or number >= self.low) and (self.high is None or number <= self.high))


def flags_by_stage():
    """Returns, for each stage, a mapping from the names of its long flags to their Flags."""
    stages = {}
    for stage, program in PROGRAMS.items():
        try:
            description = subprocess.run([program, "--xml"], check=True, stdout=subprocess.PIPE).stdout
        except OSError:
            raise OptionError(f"{program}: not found; expected in SURGICALMESHER_BIN, build/bin or on the path") from None
        except subprocess.CalledProcessError as error:
            raise OptionError(f"{program} --xml ended with {error.returncode}, expected its description") from None
        stages[stage] = {parameter.findtext("longflag"): Flag(parameter)
                         for parameter in xml.fromstring(description).iterfind("parameters/*")
                         if parameter.find("longflag") is not None}
    return stages


def flag_named(name, stages):
    """Returns the Flag with this name. Raises OptionError if no module has it, or if users may not set it."""
    if name in RESERVED:
        raise OptionError(f"{name} is given by the stages themselves, expected options beside it")
    for flags in stages.values():
        if name in flags:
            return flags[name]
    raise OptionError(f"no module has an option {name}")


def is_taken(stage, name, given):
    """Returns whether a stage that has an option should be given it, if the options named in `given` are set.

    The last stage does not need the null displacement options, because the first stage has marked far tissue in the
    map, and it needs targets and paths only to measure the nonlinear distance from them."""
    if stage != "mesh":
        return True
    return not name.startswith("nullDisplacement") and (name not in FOCUS or "nonlinearDistance" in given)


def check_value(name, flag, value):
    """Raises OptionError if a module would refuse the value, or if the value names an output in another folder."""
    if not value:
        raise OptionError(f"{name} has no value")
    if not flag.accepts(value):
        raise OptionError(f"{name} {value}: expected {flag.expected()}")
    if not value.isprintable():
        raise OptionError(f"{name} {value!r}: expected printable characters")
    if flag.is_output and (os.path.basename(value) != value or value in (".", "..")):
        raise OptionError(f"{name} {value}: expected the name of a file, without a folder")


def parsed(words, stages):
    """Yields (name, value) for each option on a command line; the value of a flag that is set is None."""
    words = list(words)
    while words:
        word = words.pop(0)
        if not word.startswith("--"):
            raise OptionError(f"{word}: expected an option")
        name, equals, value = word[2:].partition("=")
        flag = flag_named(name, stages)
        if flag.kind == "boolean" and not equals:
            value = "true"
        elif not equals:
            if not words:
                raise OptionError(f"--{name}: expected a value")
            value = words.pop(0)
        check_value(name, flag, value)
        if flag.kind != "boolean":
            yield name, value
        elif TRUTHS[value.lower()]:
            yield name, None


def values_of_list(flag, value):
    """Returns the files or texts that a value consists of: a flag that can be repeated also takes several, separated by
    commas."""
    return value.split(",") if flag.is_list and flag.kind != "point" else [value]


def values_passed_on(flag, value):
    """Returns the values that a module gets, one for each use of the flag. Names of input files become absolute."""
    if value is None:
        return [""]
    if not flag.is_input:
        return [value]
    return [os.path.abspath(file) for file in values_of_list(flag, value)]


def main():
    try:
        stages = flags_by_stage()
        options = list(parsed(sys.argv[1:], stages))
        given = {name for name, _ in options}
        for name, value in options:
            for stage, flags in stages.items():
                if name in flags and is_taken(stage, name, given):
                    for text in values_passed_on(flags[name], value):
                        print(stage, "--" + name, text, sep="\t")
    except OptionError as error:
        print(f"options: {error}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
