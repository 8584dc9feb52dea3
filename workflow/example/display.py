#!/usr/bin/python3
"""Runs a command with a display of its own, on machines with and without a screen. usage: display.py COMMAND...

Ends with the command's status, or with status 1 and one line on stderr if no display is available.
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
    """The reason why no display is available; its message is one line."""


def start(number):
    """Starts an X server without a screen as display `number`, and returns its process, or None if the number is taken.

    The server reports by -displayfd that it accepts clients. With -noreset it does not reset itself when its last
    client leaves; while it resets, it would refuse the next client."""
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
    """Starts a server and returns (server, number). The number is random, because the socket of a number that was in
    use until now may still be deleted by the server that is ending."""
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
    """Runs the command and returns its exit status. Without Xvfb, the command gets the existing display; if there is
    none either, raises DisplayError. The server is stopped only after the command has ended, because Xlib ends a
    process whose server disappears."""
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
