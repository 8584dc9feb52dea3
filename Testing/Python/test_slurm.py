"""A small cohort by Snakemake's Slurm profile on a cluster of this machine alone. usage: test_slurm.py BIN OUTDIR

The cluster's daemons (munged, slurmctld, slurmd) are those of Debian, run by this test on ports, sockets and folders of
its own and end with it. Where they are not installed or do not come up, the test is skipped (status 77).
"""
import getpass
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import cohorts

BIN, OUTDIR = sys.argv[1:3]
SKIPPED = 77
CONFIGURATION = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={processors} RealMemory=8000
PartitionName=all Nodes=ALL Default=YES State=UP
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """One node. `environment` is what its commands need; `problem` says why it did not come up, else None."""

    def __init__(self, folder):
        self.folder, self.daemons, self.problem = folder, [], None
        self.environment = {"SLURM_CONF": os.path.join(folder, "slurm.conf")}
        for name in ("state", "spool"):
            os.makedirs(os.path.join(folder, name))
        processors = subprocess.run(["nproc"], stdout=subprocess.PIPE, text=True, check=True).stdout.strip()
        with open(self.environment["SLURM_CONF"], "w", encoding="utf-8") as file:
            file.write(CONFIGURATION.format(host=socket.gethostname().split(".")[0], ports=free_ports(2), folder=folder,
                                            user=getpass.getuser(), processors=processors))
        with open(os.open(os.path.join(folder, "munge.key"), os.O_CREAT | os.O_WRONLY, 0o600), "wb") as file:
            file.write(os.urandom(1024))
        self.start("munged", "--foreground", "--force", *(f"--{option}={folder}/munge.{ending}" for option, ending in (
            ("key-file", "key"), ("socket", "socket"), ("pid-file", "pid"), ("seed-file", "seed"), ("log-file", "log"))))
        self.wait_until(lambda: os.path.exists(os.path.join(folder, "munge.socket")), "munged")
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D")
        self.wait_until(lambda: "idle" in self.output_of("sinfo", "--noheader", "--format=%T"), "slurmd")

    def start(self, program, *arguments):
        if self.problem:
            return
        path = shutil.which(program, path=os.environ.get("PATH", "") + ":/usr/sbin")
        if path is None:
            self.problem = f"{program} is not installed"
            return
        with open(os.path.join(self.folder, program + ".out"), "w", encoding="utf-8") as log:
            self.daemons.append(subprocess.Popen([path, *arguments], env={**os.environ, **self.environment},
                                                 stdin=subprocess.DEVNULL, stdout=log, stderr=log))

    def output_of(self, *command):
        return subprocess.run(command, env={**os.environ, **self.environment}, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False).stdout

    def wait_until(self, condition, program, seconds=60):
        end = time.monotonic() + seconds
        while not self.problem and not condition():
            if time.monotonic() > end:
                with open(os.path.join(self.folder, program + ".out"), encoding="utf-8") as log:
                    self.problem = f"{program} does not come up: {log.read()[-500:]}"
            time.sleep(0.2)

    def stop(self):
        for daemon in reversed(self.daemons):
            daemon.terminate()
            daemon.wait()


class SlurmTest(unittest.TestCase):
    def test_two_meshes_and_one_reported_failure(self):
        root = os.path.abspath("a source folder")
        shutil.copytree(os.path.join(cohorts.ROOT, "workflow"), os.path.join(root, "workflow"))
        cohorts.write_cohort(3, damaged=1)
        process = cohorts.run_snakemake("slurm", BIN, CLUSTER.environment, root)
        self.assertEqual(process.returncode, 0, process.stdout)
        cohorts.assert_one_refused(self, "p1")
        jobs = CLUSTER.output_of("scontrol", "--oneliner", "show", "jobs")
        for stage in ("scale", "surface", "mesh"):
            for patient in ("p0", "p1", "p2"):
                self.assertRegex(jobs, rf"JobName={stage}-patient={patient} .*JobState=COMPLETED")
        before = cohorts.all_files()
        process = cohorts.run_snakemake("slurm", BIN, CLUSTER.environment, root)
        self.assertIn("Nothing to be done", process.stdout)
        self.assertEqual(cohorts.all_files(), before)


if __name__ == "__main__":
    shutil.rmtree(OUTDIR, ignore_errors=True)
    os.makedirs(OUTDIR)
    os.chdir(OUTDIR)
    with tempfile.TemporaryDirectory() as short_path:  # munge's socket allows no long one
        CLUSTER = Cluster(short_path)
        try:
            if CLUSTER.problem:
                print("skipped:", CLUSTER.problem)
                sys.exit(SKIPPED)
            unittest.main(argv=sys.argv[:1])
        finally:
            CLUSTER.stop()
