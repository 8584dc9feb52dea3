#!/usr/bin/python3
"""Compiles the project's code for the host against the headers of another host, without building that host.

usage: compile_against.py --build BUILD --sources FOLDER... --include FOLDER... [--define NAME]... [FILE...]

--build    a build folder of the extension for any host, for the headers that uic made
--sources  sources of the other Slicer, its CTK, vtkAddon and SlicerExecutionModel; headers of all subfolders are found
--include  the include folders of its VTK (vtk-9.6), Qt (qt6) and ITK (ITK-5.4), and others that these need
--define   a macro, such as CTK_USE_QVTKOPENGLWIDGET
FILE       instead of all

Headers that the other host's build would generate get stand-ins: *Export.h with every macro empty, other ones the text
of their template. Nothing is linked or run. Exit status 1 if a file does not compile; warnings count.
"""
import argparse
import concurrent.futures
import glob
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
MODULES = ("SurgicalPathScale", "SimplexMesher", "FuchsTetrahedralizer", "TissueMapper", "TemplateHexMesher")
HEADER = re.compile(r"\.(h|hxx|txx|tpp)$")
EXPORT_MACRO = re.compile(r"\b[A-Za-z]\w*_(?:NO_)?EXPORT\b")
NOT_OURS_TO_REPLACE = re.compile(r"^(VTK(?!_SLICER|_MRML|_SURGICALMESHER|Addon)|Q_DECL)")


def folders_with(pattern, root):
    for folder, _, files in os.walk(root):
        if any(pattern.search(f) for f in files):
            yield folder


def own_sources():
    parts = ["Libs/SlicerSupport", "Testing/Slicer"]
    parts += [f"{m}/{part}" for m in MODULES for part in ("MRML", "Logic", "Testing/Slicer")]
    files = [os.path.join(folder, f) for part in parts
             for folder in folders_with(re.compile(r"\.cxx$"), os.path.join(ROOT, part))
             for f in os.listdir(folder) if f.endswith(".cxx")]
    files += [path for m in MODULES for path in glob.glob(os.path.join(ROOT, m, "*.cxx"))]
    return sorted(set(files))


def read(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        return file.read()


def write_stand_ins(folder, sources):
    """Generated headers of the host: export macros, and configured templates with everything unset."""
    macros, exports, present, templates = set(), set(), set(), {}
    for root in [*sources, ROOT]:
        for directory, _, files in os.walk(root):
            for name in files:
                path = os.path.join(directory, name)
                if name.endswith(".h.in"):
                    templates[name[:-3]] = path
                elif name.endswith(".h"):
                    present.add(name)
                    text = read(path)
                    macros.update(EXPORT_MACRO.findall(text))
                    exports.update(re.findall(r'#\s*include\s*[<"](?:[^>"]*/)?(\w+Export\.h)[>"]', text))
    with open(os.path.join(folder, "AllExportMacros.h"), "w", encoding="utf-8") as file:
        file.write("#pragma once\n")
        for macro in sorted(m for m in macros if not NOT_OURS_TO_REPLACE.search(m)):
            file.write(f"#ifndef {macro}\n#define {macro}\n#endif\n")
    for name in exports - present:
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write('#pragma once\n#include "AllExportMacros.h"\n')
    for name, path in templates.items():
        if name not in present:
            text = re.sub(r"#cmakedefine01\s+(\w+)", r"#define \1 0", read(path))
            text = re.sub(r"#cmakedefine\s+(\w+).*", r"/* #undef \1 */", text)
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(re.sub(r"@\w+@|\$\{\w+\}", "0", text))


def include_options(build, sources, includes, stand_ins):
    # Last, as a header there has the name of one of the host's.
    last = os.path.join(ROOT, "Libs", "CommandLine")
    own = [f for part in ("Libs", "Testing", *MODULES) for f in folders_with(HEADER, os.path.join(ROOT, part))]
    own.remove(last)
    system = [*folders_with(re.compile(r"^ui_.*\.h$"), build), stand_ins]
    system += [f for root in sources for f in folders_with(HEADER, root)]
    for folder in includes:
        system.append(folder)
        if os.path.isdir(os.path.join(folder, "QtCore")):
            system += [os.path.join(folder, module) for module in os.listdir(folder)]
    return [f"-I{f}" for f in own] + [f"-isystem{f}" for f in system] + [f"-idirafter{last}"]


def compiled(path, options):
    """What the compiler says of a file; empty if nothing."""
    command = ["g++", "-std=c++17", "-fPIC", "-fsyntax-only", "-Wall", "-Wextra", *options, path]
    return subprocess.run(command, capture_output=True, text=True, check=False).stderr


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1].split("\n")[0])
    parser.add_argument("--build", required=True)
    parser.add_argument("--sources", nargs="+", default=[])
    parser.add_argument("--include", nargs="+", default=[])
    parser.add_argument("--define", action="append", default=[])
    parser.add_argument("files", nargs="*", metavar="FILE")
    arguments = parser.parse_args()
    sources, includes = ([os.path.abspath(f) for f in folders] for folders in (arguments.sources, arguments.include))
    files = [os.path.abspath(f) for f in arguments.files] or own_sources()
    paths = ("SURGICALMESHER_HOST", "SURGICALMESHER_LOADABLE_MODULES", "SURGICALMESHER_CLI_MODULES",
             "SURGICALMESHER_SOURCES", "SURGICALMESHER_TEST_FOLDER")
    defines = [f'-D{p}=""' for p in paths] + [f"-D{d}" for d in arguments.define]
    failed = 0
    with tempfile.TemporaryDirectory() as stand_ins:
        write_stand_ins(stand_ins, sources)
        options = defines + include_options(arguments.build, sources, includes, stand_ins)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for path, messages in zip(files, pool.map(lambda f: compiled(f, options), files)):
                print(f"{'FAILED' if messages else 'ok'} {os.path.relpath(path, ROOT)}\n{messages}", end="", flush=True)
                failed += bool(messages)
    print(f"{len(files) - failed} of {len(files)} files compile")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
