#!/usr/bin/python3
"""Runs a command with a display of its own, on machines with and without a screen. usage: display.py COMMAND...

Ends with the command's status, or with 1 and one line on stderr if there is no display to be had.
"""
import os
import select
import shutil
import signal
import subprocess
import sys

SECONDS = 30


class DisplayError(RuntimeError):
    """One line."""


def start():
    """An X server without a screen and its name. The server itself chooses a display that is free, and says so once it
    answers; several that begin together take different ones."""
    reading, writing = os.pipe()
    with os.fdopen(reading) as number:
        try:
            server = subprocess.Popen(
                ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"],
                pass_fds=[writing], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                start_new_session=True)
        finally:
            os.close(writing)
        name = number.readline().strip() if select.select([number], [], [], SECONDS)[0] else ""
    if name:
        return server, ":" + name
    stop(server)
    return None


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
    begun = start() or start() or start()
    if begun is None:
        raise DisplayError("Xvfb does not start")
    server, name = begun
    try:
        return subprocess.run(command, env={**os.environ, "DISPLAY": name}, check=False).returncode
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
