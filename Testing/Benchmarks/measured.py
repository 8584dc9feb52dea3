#!/usr/bin/python3
"""Runs a command and writes what it took. usage: measured.py FIGURES.json COMMAND...

Writes wall-clock seconds, processor seconds of all threads together (which hardly depend on what else the machine
does), and peak memory in bytes. This is a process of its own because Linux includes the memory of the process that
starts a command in the command's peak memory. The command's exit status is passed on.
"""
import json
import os
import subprocess
import sys
import time


def main():
    figures, *command = sys.argv[1:]
    start = time.monotonic()
    process = subprocess.Popen(command)  # pylint: disable=consider-using-with  # waited for below
    _, status, usage = os.wait4(process.pid, 0)
    result = {"seconds": round(time.monotonic() - start, 3),
              "processorSeconds": round(usage.ru_utime + usage.ru_stime, 3), "peakMemory": usage.ru_maxrss * 1024}
    with open(figures, "w", encoding="utf-8") as file:
        json.dump(result, file)
    process.returncode = os.waitstatus_to_exitcode(status)
    sys.exit(process.returncode if process.returncode >= 0 else 128 - process.returncode)


if __name__ == "__main__":
    main()
