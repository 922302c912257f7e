# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies on a cluster: a Slurm controller and a node of our own carry out the job scripts of examples/cluster."""

import sys

sys.dont_write_bytecode = True

import getpass
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time
import unittest

from program import PROGRAM, SOURCE_DIR, ProgramTest, environment, small_study, strict_json, timeless

EXAMPLES = SOURCE_DIR / "examples" / "cluster"
SBIN = ("/usr/sbin", "/sbin", *os.environ["PATH"].split(":"))

STUDY = small_study(
    name="cluster",
    cases=["conduction/slab-dirichlet", "conduction/manufactured"],
    formulations=["conduction/brookshaw", "conduction/campbell-flux"],
    discretisation={"layout": ["lattice", {"id": "jittered", "amplitude": 0.2, "seeds": [1, 2]}]},
    resolution=[50, 100, 150, 200],
    measure=["error", "conservation", "cost"],
)
SECONDS = 240  # for a job, however busy the machine


def found(name):
    return next((path for path in (pathlib.Path(folder) / name for folder in SBIN) if path.is_file()), None)


def free_ports(count):
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster(ProgramTest):
    """Controller, node and keys in a folder that is removed; ports of their own."""

    @classmethod
    def setUpClass(cls):
        missing = [name for name in ("munged", "slurmctld", "slurmd", "sbatch", "srun") if not found(name)]
        if missing or os.geteuid() != 0:
            # Munge and slurmd want to be root; CI runs as root, and so does tools/check where it may.
            raise unittest.SkipTest(f"no cluster here: {', '.join(missing) or 'slurmd wants to be root'}")
        cls.base = pathlib.Path("/tmp") / f"sphverify-slurm-{os.getpid()}"
        cls.base.mkdir(mode=0o755)
        cls.servers = []
        cls.addClassCleanup(cls.stop_all)
        try:
            cls.start_munge()
            cls.start_slurm()
        except AssertionError as failure:
            # A container may forbid what these servers need; what fails after they are up is ours.
            raise unittest.SkipTest(f"the cluster does not start here: {failure}") from failure

    @classmethod
    def stop_all(cls):
        for server in reversed(cls.servers):
            server.terminate()
        for server in cls.servers:
            try:
                server.wait(timeout=10)
            except subprocess.TimeoutExpired:
                server.kill()
                server.wait()
        shutil.rmtree(cls.base, ignore_errors=True)

    @classmethod
    def serve(cls, name, *arguments):
        log = open(cls.base / f"{name}.log", "wb")
        cls.addClassCleanup(log.close)
        cls.servers.append(subprocess.Popen([found(name), *map(str, arguments)], stdout=log, stderr=log, env=cls.variables()))

    @classmethod
    def variables(cls, **changes):
        path = f"{cls.base}:{os.environ['PATH']}"
        return environment(SLURM_CONF=str(cls.base / "slurm.conf"), PATH=path, **changes)

    @classmethod
    def start_munge(cls):
        folder = cls.base / "munge"
        folder.mkdir(mode=0o755)
        key = folder / "key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        cls.socket = folder / "socket"
        cls.serve("munged", "--foreground", "--force", "--num-threads=2", f"--key-file={key}", f"--socket={cls.socket}",
                  f"--pid-file={folder / 'pid'}", f"--seed-file={folder / 'seed'}", f"--log-file={folder / 'log'}")  # fmt: skip
        cls.wait_until(cls.socket.exists, "munge does not start", 60)

    @classmethod
    def start_slurm(cls):
        (cls.base / "state").mkdir()
        (cls.base / "spool").mkdir()
        (cls.base / "sphverify").symlink_to(PROGRAM)
        host = socket.gethostname().split(".")[0]
        controller, node = free_ports(2)
        (cls.base / "slurm.conf").write_text(f"""
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser={getpass.getuser()}
SlurmctldPort={controller}
SlurmdPort={node}
AuthType=auth/munge
AuthInfo=socket={cls.socket}
CryptoType=crypto/munge
StateSaveLocation={cls.base}/state
SlurmdSpoolDir={cls.base}/spool
SlurmctldPidFile={cls.base}/slurmctld.pid
SlurmdPidFile={cls.base}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=1
JobRequeue=1
MpiDefault=none
ReturnToService=2
SlurmdParameters=config_overrides
KillWait=10
InactiveLimit=0
MessageTimeout=30
SlurmctldDebug=info
SlurmdDebug=info
NodeName={host} NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP OverSubscribe=FORCE:4
""")
        cls.serve("slurmctld", "-D", "-i")
        cls.serve("slurmd", "-D", "-N", host)
        cls.wait_until(lambda: "idle" in cls.said("sinfo", "-h", "-o", "%T"), "no node comes up", 60)

    @classmethod
    def said(cls, *command):
        return subprocess.run([*map(str, command)], capture_output=True, text=True, env=cls.variables(), timeout=60).stdout

    @classmethod
    def wait_until(cls, holds, complaint, seconds=SECONDS):
        deadline = time.monotonic() + seconds
        while not holds():
            if time.monotonic() > deadline:
                logs = "".join(path.read_text(errors="replace")[-2000:] for path in cls.base.glob("*.log"))
                raise AssertionError(f"{complaint}\n{cls.said('scontrol', 'show', 'job')}\n{logs}")
            time.sleep(0.2)

    def submit(self, *words):
        result = subprocess.run(["sbatch", "--parsable", "-D", self.folder, *map(str, words)], capture_output=True, text=True,
                                env=self.variables(), timeout=60)  # fmt: skip
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout.strip()

    def wait_for(self, job):
        self.wait_until(lambda: self.has_ended(job), f"job {job} does not end")

    def has_ended(self, job):
        """A controller that is too busy to answer says nothing of it."""
        asked = subprocess.run(["squeue", "-h", "-j", job], capture_output=True, text=True, env=self.variables(), timeout=60)
        return not asked.stdout.strip() and (asked.returncode == 0 or "Invalid job id" in asked.stderr)

    def logs(self):
        return "\n".join(path.read_text(errors="replace") for path in sorted(self.folder.glob("slurm-*.out")))

    def test_an_array_of_parts_of_which_one_is_killed_and_requeued(self):
        # Some seconds for each part.
        study = small_study(
            cases=["hydro/piston-velocity", "hydro/riemann"],
            formulations=["momentum/p-rho2", "momentum/sqrt-p"],
            discretisation={"smoothing": "adaptive", "density": "normalised", "closure": ["interpolated", "one-sided"]},
            resolution=[50, 100, 200, 300],
            measure=["error", "conservation"],
        )
        whole = self.study(study)
        document = self.write("study.json", study)
        parts = self.folder / "parts"
        parts.mkdir()
        journal = parts / "part-2.json.journal"
        job = self.submit(EXAMPLES / "array.sh", document, parts)
        killed = False
        deadline = time.monotonic() + SECONDS
        while not killed and not (parts / "part-2.json").exists() and time.monotonic() < deadline:
            if journal.exists() and journal.read_bytes().count(b"\n") > 1:
                subprocess.run(["scontrol", "requeue", f"{job}_2"], env=self.variables(), capture_output=True, timeout=60)
                killed = True
            time.sleep(0.005)
        self.assertTrue(killed, "the task ended before it could be requeued\n" + self.logs())
        # Slurm waits two minutes before it starts again what was requeued. It is asked not to, but not before the node has put
        # the old one away: a task that is started on top of it fails.
        asked = [time.monotonic()]

        def is_complete():
            if time.monotonic() > asked[0] + 5:
                words = self.said("scontrol", "--oneliner", "show", "job", f"{job}_2").split()
                number = next((word.removeprefix("JobId=") for word in words if word.startswith("JobId=")), "")
                subprocess.run(["scontrol", "update", f"JobId={number}", "StartTime=now"], env=self.variables(), capture_output=True, timeout=60)
                asked[0] = time.monotonic()
            return len(list(parts.glob("part-?.json"))) == 4

        self.wait_until(is_complete, "the task that was requeued does not end")
        self.wait_for(job)
        paths = sorted(parts.glob("part-?.json"))
        self.assertEqual(len(paths), 4, self.logs())
        self.assertIn("done before", self.logs())
        self.succeed("merge", *paths, "-o", self.folder / "merged.json")
        self.assertEqual(timeless(strict_json((self.folder / "merged.json").read_text())), timeless(whole))
        self.assertEqual(list(parts.glob("*.journal")), [])

    def test_ranks_of_one_job_stopped_in_an_orderly_way_and_started_again(self):
        study = STUDY | {"resolution": [100, 150, 200, 300]}
        whole = self.study(study)
        document = self.write("study.json", study)
        shared = self.folder / "shared.json"
        journal = self.folder / "shared.json.journal"
        job = self.submit(EXAMPLES / "ranks.sh", document, shared)
        self.wait_until(lambda: shared.exists() or (journal.exists() and journal.read_bytes().count(b"\n") > 3), "no run ends")
        self.assertFalse(shared.exists(), "the job ended before it could be stopped")
        subprocess.run(["scancel", "--signal=TERM", job], env=self.variables(), check=True, timeout=60)
        self.wait_for(job)
        text = journal.read_text()
        self.assertTrue(text.endswith("\n"), "the journal is whole")
        before = text.count("\n") - 1
        self.assertIn("interrupted", self.logs())
        self.wait_for(self.submit(EXAMPLES / "ranks.sh", document, shared))
        self.assertTrue(shared.exists(), self.logs())
        self.assertIn(f"{before} of them done before", self.logs())
        self.assertEqual(timeless(strict_json(shared.read_text())), timeless(whole))
        self.assertEqual(sorted(path.name for path in self.folder.glob("shared.json*")), ["shared.json"])

    def test_a_job_without_its_files_says_so_in_one_line(self):
        for script, words in (("array.sh", "part-1.json"), ("ranks.sh", "shared.json")):
            for path in self.folder.glob("slurm-*.out"):
                path.unlink()
            output = self.folder / ("nowhere" if script == "array.sh" else "shared.json")
            self.wait_for(self.submit(EXAMPLES / script, self.folder / "missing.json", output))
            lines = [line for line in self.logs().splitlines() if line.startswith("sphverify: ")]
            self.assertEqual(len(lines), 4 if script == "array.sh" else 1, self.logs())
            for line in lines:
                self.assertRegex(line, "missing.json|nowhere")


if __name__ == "__main__":
    unittest.main(verbosity=2)
