"""A cluster of one node for as long as a test takes: munge and Slurm as the
user who runs the test, with all of their files in one folder."""
import os
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

PROGRAMS = "munged", "slurmctld", "slurmd", "sbatch", "sinfo"
PATIENCE = 60  # [s], for the node to be ready

CONFIGURATION = """\
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={first}
SlurmdPort={second}
AuthType=auth/munge
AuthInfo=socket={place}/munge.socket
CredType=cred/munge
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={place}/state
SlurmdSpoolDir={place}/spool
SlurmctldPidFile={place}/slurmctld.pid
SlurmdPidFile={place}/slurmd.pid
SlurmctldLogFile={place}/slurmctld.log
SlurmdLogFile={place}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_min_interval=100000,batch_sched_delay=0
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory=512
PartitionName=test Nodes=ALL Default=YES State=UP
"""


def program(name):
    """Its path; daemons are not on everyone's PATH."""
    return shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin")


def missing():
    return [name for name in PROGRAMS if program(name) is None]


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


class Cluster:
    """`with Cluster(folder) as cluster: cluster.submit(...)`"""

    def __init__(self, place):
        self.place = Path(place)
        self.environment = dict(os.environ,
                                SLURM_CONF=str(self.place / "slurm.conf"))

    def run(self, *command):
        """What a command writes; RuntimeError where it fails."""
        done = subprocess.run(
            [program(command[0]), *map(str, command[1:])], check=False,
            env=self.environment, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode != 0:
            raise RuntimeError(f"{command[0]}: code {done.returncode}: "
                               f"{done.stdout}{self.logs()}")
        return done.stdout

    def __enter__(self):
        try:
            self.start()
        except BaseException:
            self.stop()
            raise
        return self

    def __exit__(self, *_):
        self.stop()

    def start(self):
        for name in "state", "spool":
            (self.place / name).mkdir()
        key = self.place / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        self.run("munged", "--force", f"--key-file={key}",
                 f"--socket={self.place}/munge.socket",
                 f"--pid-file={self.place}/munged.pid",
                 f"--log-file={self.place}/munged.log",
                 f"--seed-file={self.place}/munge.seed")
        user = subprocess.run(["id", "-un"], check=True, text=True,
                              stdout=subprocess.PIPE).stdout.strip()
        (self.place / "slurm.conf").write_text(CONFIGURATION.format(
            place=self.place, user=user, first=free_port(),
            second=free_port(), cpus=os.cpu_count(),
            host=socket.gethostname().split(".")[0]))
        self.run("slurmctld")
        self.run("slurmd")
        until = time.monotonic() + PATIENCE
        while "idle" not in self.state():
            if time.monotonic() > until:
                raise RuntimeError("the node is not ready: " + self.logs())
            time.sleep(0.1)

    def state(self):
        try:
            return self.run("sinfo", "--noheader", "--format=%T")
        except RuntimeError:
            return "no answer"

    def logs(self):
        return "\n".join(path.read_text(errors="replace")[-2000:]
                         for pattern in ("slurm*.log", "task.*")
                         for path in self.place.glob(pattern))

    def submit(self, *words):
        """Waits for the job; its tasks write PLACE/task.I."""
        return self.run("sbatch", "--wait",
                        f"--output={self.place}/task.%a", *words)

    def stop(self):
        for name in "slurmd", "slurmctld", "munged":
            path = self.place / f"{name}.pid"
            if path.exists() and path.read_text().strip():
                pid = int(path.read_text())
                os.kill(pid, signal.SIGTERM)
                while os.path.exists(f"/proc/{pid}"):
                    time.sleep(0.05)
