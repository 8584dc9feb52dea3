"""Prints a page of all options of all programs, made from the descriptions that --help and the manual pages come from.

usage: options.py ROOT > Options.md
"""
import glob
import os
import sys
import xml.etree.ElementTree as xml


def accepted(parameter):
    """Describes the values that a parameter accepts: choices, a range, or file extensions."""
    choices = [element.text for element in parameter.findall("element")]
    limits = [parameter.findtext(f"constraints/{name}") for name in ("minimum", "maximum")]
    if choices:
        return "one of " + ", ".join(choices)
    if any(limits):
        return f"{limits[0] or 'any'} to {limits[1] or 'any'}"
    return parameter.get("fileExtensions", "").replace(",", ", ")


def cell(text):
    return " ".join(text.split()).replace("|", "\\|").replace("<", "&lt;")


def rows(group):
    for parameter in group:
        flag, name = parameter.findtext("longflag"), parameter.findtext("name")
        if name and (flag or parameter.findtext("index")):
            several = ", any number" if parameter.get("multiple") == "true" else ""
            kind = "flag" if parameter.tag == "boolean" else parameter.tag + several
            yield (f"`--{flag}`" if flag else f"`{name}`", kind, parameter.findtext("default") or "", accepted(parameter),
                   parameter.findtext("description"))


def section(file):
    root = xml.parse(file).getroot()
    program = os.path.splitext(os.path.basename(file))[0]
    if not program.endswith("CLI"):
        program = "surgicalmesher " + program
    lines = [f"## {program}", "", cell(root.findtext("description")), ""]
    for group in root.findall("parameters"):
        table = list(rows(group))
        if table:
            lines += [f"**{group.findtext('label')}**", "", "| option | type | default | accepted | what |",
                      "|---|---|---|---|---|", *("| " + " | ".join(map(cell, row)) + " |" for row in table), ""]
    return "\n".join(lines)


def main(root):
    programs = sorted(glob.glob(os.path.join(root, "*", "CLI", "*.xml")), key=os.path.basename)
    commands = [os.path.join(root, "Program", f"{name}.xml") for name in ("mesh", "estimate", "quality", "convert", "view")]
    print("# All options\n\nGenerated from the programs' descriptions, as `--help`, manual pages and completion are. "
          "`surgicalmesher mesh` takes the options of its stages as well.\n")
    print("\n".join(section(file) for file in commands + programs))


if __name__ == "__main__":
    main(sys.argv[1])
