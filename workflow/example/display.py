#!/usr/bin/python3
"""Runs a command with a display of its own, on machines with and without a screen. usage: display.py COMMAND...

Ends with the command's status, or with 1 and one line on stderr if there is no display to be had.
"""
import os
import random
import select
import shutil
import signal
import subprocess
import sys

SECONDS = 30
ATTEMPTS = 5
NUMBERS = (1000, 50000)


class DisplayError(RuntimeError):
    """One line."""


def start(number):
    """An X server without a screen as display `number`; None if that one is taken. It says so itself once it answers,
    and stays as it is when a client leaves: while it resets, it refuses the next one."""
    reading, writing = os.pipe()
    with os.fdopen(reading) as answer:
        try:
            server = subprocess.Popen(
                ["Xvfb", f":{number}", "-displayfd", str(writing), "-screen", "0", "1280x1024x24", "-nolisten", "tcp",
                 "-noreset"],
                pass_fds=[writing], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                start_new_session=True)
        finally:
            os.close(writing)
        if select.select([answer], [], [], SECONDS)[0] and answer.readline().strip() == str(number):
            return server
    stop(server)
    return None


def start_somewhere():
    """(server, number). Numbers are drawn: one just given back loses its socket to the server that leaves it."""
    for _ in range(ATTEMPTS):
        number = random.randrange(*NUMBERS)
        server = start(number)
        if server:
            return server, number
    raise DisplayError("Xvfb does not start")


def stop(server):
    server.terminate()
    try:
        server.wait(timeout=SECONDS)
    except subprocess.TimeoutExpired:
        server.kill()
        server.wait()


def run(command):
    """The command's exit status; where there is no Xvfb it gets the display that is there. Raises DisplayError without
    either. The server outlives the command: Xlib ends a process whose server goes."""
    if shutil.which("Xvfb") is None:
        if not os.environ.get("DISPLAY"):
            raise DisplayError("no display to draw on, expected Xvfb (Debian's package xvfb)")
        return subprocess.run(command, check=False).returncode
    server, number = start_somewhere()
    try:
        return subprocess.run(command, env={**os.environ, "DISPLAY": f":{number}"}, check=False).returncode
    finally:
        stop(server)


def main():
    signal.signal(signal.SIGTERM, lambda number, frame: sys.exit(128 + number))
    try:
        status = run(sys.argv[1:])
    except (DisplayError, OSError) as error:
        print(f"display: {error}", file=sys.stderr)
        sys.exit(1)
    except KeyboardInterrupt:
        sys.exit(130)
    sys.exit(status if status >= 0 else 128 - status)


if __name__ == "__main__":
    main()
