#!/usr/bin/python3
"""Runs one stage for one patient. usage: stage.py STAGE FOLDER LOG [--after FOLDER] -- COMMAND...

Writes run.json to FOLDER: stage, exit status, error line, seconds and peak memory (bytes). A program that refuses its
input (exit status 1) or its options (2), or whose engine fails on them (3), would fail again in every run, so its
failure is recorded as a result, and this script ends with status 0. If the stage whose FOLDER is given by --after
failed in this way, its run.json is passed on and nothing runs. After failures that may not recur, this script ends with
status 1: signals, and errors about space for outputs, about memory that this machine has, or about processes and
threads.
"""
import argparse
import json
import os
import re
import resource
import subprocess
import sys
import time

DONE, BAD_INPUT, BAD_OPTION, FAILURE = range(4)
# Error messages of the programs for which neither the input nor the engine is to blame.
WANTING = re.compile(r": (can't|cannot) (be (opened for writing|replaced|written(?! as an image))|create a file)"
                     r"|: disk full|, a writable (file|folder) expected|: output was not written$"
                     r"|: not all that was printed could be written"
                     r"|(:| gave up with) out of memory$|: no memory for the exported mesh$"
                     r"|: no process of its own can be started|: Resource temporarily unavailable$")
ESTIMATE = re.compile(r" ([0-9][0-9.e+]*) GB of memory, found .* available")
LONGEST = 500  # characters of an error line that are kept for the table


def read_arguments():
    parser = argparse.ArgumentParser(description="Runs one stage for one patient.")
    parser.add_argument("stage")
    parser.add_argument("folder")
    parser.add_argument("log")
    parser.add_argument("--after")
    parser.add_argument("command", nargs="+")
    return parser.parse_args()


def failure_of(folder):
    """Returns the content of run.json if the stage failed, else None."""
    if folder is None:
        return None
    with open(os.path.join(folder, "run.json"), encoding="utf-8") as file:
        run = json.load(file)
    return run if run["status"] else None


def printable(text):
    """Returns the text with control characters, which would disturb a terminal or a table, replaced by escapes."""
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)


def last_line(text):
    """Returns the last line of a program's stderr, which gives the reason why it ended."""
    lines = [line for line in text.split("\n") if line.strip()]
    return printable(lines[-1]) if lines else "no message"


def shortened(line):
    return line if len(line) <= LONGEST else line[:LONGEST] + " ..."


def memory_of_machine():
    """Returns the size of the machine's memory in bytes, whether free or not."""
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")


def is_result(status, error):
    """Returns whether a run of the same files and options on this machine would always end in this way."""
    if status in (DONE, BAD_OPTION):
        return True
    estimate = ESTIMATE.search(error)
    if estimate and float(estimate[1]) * 1e9 <= memory_of_machine():
        return False
    return status in (BAD_INPUT, FAILURE) and not WANTING.search(error)


def run(arguments):
    start = time.monotonic()
    with open(arguments.log, "w", encoding="utf-8") as log:
        process = subprocess.run(arguments.command, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.PIPE,
                                 check=False)
        said = process.stderr.decode("utf-8", "backslashreplace")
        log.write("\n".join(printable(line) for line in said.split("\n")))
        error = last_line(said)
        if not is_result(process.returncode, error):
            if process.returncode not in (BAD_INPUT, FAILURE):  # the program itself gave no reason
                end = f"signal {-process.returncode}" if process.returncode < 0 else f"status {process.returncode}"
                log.write(f"{arguments.command[0]} ended by {end}\n")
            sys.exit(1)
    return {"stage": arguments.stage, "status": process.returncode,
            "error": shortened(error) if process.returncode else "",
            "seconds": round(time.monotonic() - start, 2),
            "peakMemory": resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024}


def main():
    arguments = read_arguments()
    os.makedirs(arguments.folder, exist_ok=True)
    result = failure_of(arguments.after) or run(arguments)
    with open(os.path.join(arguments.folder, "run.json"), "w", encoding="utf-8") as file:
        json.dump(result, file, indent=2)


if __name__ == "__main__":
    main()
