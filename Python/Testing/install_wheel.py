"""The wheel, made of a finished build, installed into a fresh virtual environment with the system's packages.

usage: install_wheel.py SOURCE BUILD OUTDIR
"""
import glob
import os
import shutil
import subprocess
import sys

SOURCE, BUILD, OUTDIR = sys.argv[1:4]


def run(*command, **environment):
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, env={**os.environ, **environment}, check=False)
    assert done.returncode == 0, done.stdout


if __name__ == "__main__":
    shutil.rmtree(OUTDIR, ignore_errors=True)
    environment = os.path.join(OUTDIR, "env")
    wheels = os.path.join(OUTDIR, "wheels")
    run(sys.executable, "-m", "pip", "wheel", "--no-index", "--no-deps", "--no-build-isolation", "--wheel-dir", wheels,
        SOURCE, SURGICALMESHER_BUILD=BUILD)
    run(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", environment)
    python = os.path.join(environment, "bin", "python")
    run(python, "-m", "pip", "install", "--no-index", "--no-deps", *glob.glob(os.path.join(wheels, "*.whl")))
