"""A Slurm of one node, this machine, for tests: its daemons, started in a folder of their own."""
import contextlib
import os
import pathlib
import shutil
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "sinfo", "squeue")

CONFIGURATION = """\
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=10:00 State=UP
"""


def missing():
    """Why there can be no Slurm here; empty when there can."""
    absent = [name for name in PROGRAMS if path_of(name) is None]
    if absent:
        return f"needs {', '.join(absent)} (Debian's slurmctld slurmd slurm-client munge)"
    return "" if os.geteuid() == 0 else "needs root, to start slurmd"


def path_of(name):
    return shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")


@contextlib.contextmanager
def one_node(folder):
    """Yields the environment in which sbatch and the others talk to this Slurm. RuntimeError with
    the daemons' logs when it does not come up."""
    folder = pathlib.Path(folder)
    folder.chmod(0o755)
    for name in ("state", "spool"):
        (folder / name).mkdir()
    key = folder / "munge.key"
    key.write_bytes(os.urandom(128))
    key.chmod(0o600)
    with socket.create_server(("127.0.0.1", 0)) as one, socket.create_server(("127.0.0.1", 0)) as other:
        ports = [free.getsockname()[1] for free in (one, other)]
    (folder / "slurm.conf").write_text(CONFIGURATION.format(
        host=socket.gethostname().split(".")[0], ports=ports, folder=folder, cpus=os.cpu_count()))
    (folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\nCgroupAutomount=no\n")
    environment = dict(os.environ, SLURM_CONF=str(folder / "slurm.conf"))
    daemons = []

    def start(*command):
        with open(folder / (command[0] + ".out"), "wb") as log:
            daemons.append(subprocess.Popen([path_of(command[0]), *command[1:]], env=environment, stdout=log,
                                            stderr=subprocess.STDOUT))

    try:
        start("munged", "--foreground", "--force", f"--key-file={key}",
              f"--socket={folder}/munge.socket", f"--pid-file={folder}/munged.pid",
              f"--log-file={folder}/munged.log", f"--seed-file={folder}/munge.seed")
        wait_for(lambda: (folder / "munge.socket").exists(), 10)
        start("slurmctld", "-D", "-c")
        start("slurmd", "-D")
        if not wait_for(lambda: "idle" in subprocess.run(
                ["sinfo", "-h", "-o", "%T"], env=environment, capture_output=True, text=True, check=False).stdout, 60):
            raise RuntimeError("\n".join(f"{log.name}: {log.read_text(errors='replace')[-1500:]}"
                for log in sorted([*folder.glob("*.out"), *folder.glob("*.log")])))
        yield environment
    finally:
        for daemon in reversed(daemons):
            daemon.terminate()
        for daemon in daemons:
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()


def wait_for(holds, seconds):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if holds():
            return True
        time.sleep(0.2)
    return False
