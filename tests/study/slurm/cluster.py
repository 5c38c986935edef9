"""A Slurm of our own on this machine: munged, slurmctld and slurmd in a folder, on ports that nobody
has, with one node. They belong to who starts them, and end with `with Cluster(folder) as cluster:`.
"""
import ctypes
import os
import pathlib
import pwd
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo", "scontrol", "scancel")

CONFIGURATION = """ClusterName=flowslide
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,batch_sched_delay=0,sched_min_interval=0
MpiDefault=none
SwitchType=switch/none
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=5
MinJobAge=300
MessageTimeout=20
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=4000 State=UNKNOWN
PartitionName=day Nodes=ALL Default=YES MaxTime=60 State=UP
"""


def find(program):
    """Daemons lie where users do not look."""
    return shutil.which(program) or shutil.which(program, path="/usr/sbin:/sbin:/usr/local/sbin")


def missing():
    return [program for program in PROGRAMS if not find(program)]


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


def end_with_parent():
    """Of a new process: should this one be killed, it gets SIGTERM."""
    set_parent_death_signal = 1
    ctypes.CDLL(None).prctl(set_parent_death_signal, signal.SIGTERM)


class CannotStart(Exception):
    pass


class Cluster:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.processes = []
        self.host = socket.gethostname().split(".")[0]

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
        folder = self.folder
        for name in ("state", "spool"):
            (folder / name).mkdir()
        controller_port, node_port = free_ports(2)
        (folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=self.host, user=pwd.getpwuid(os.getuid()).pw_name, folder=folder,
            controller_port=controller_port, node_port=node_port), encoding="utf-8")
        (folder / "munge.key").write_bytes(os.urandom(1024))
        (folder / "munge.key").chmod(0o400)
        self.environment = os.environ | {"SLURM_CONF": str(folder / "slurm.conf")}
        for name in list(self.environment):
            if name.startswith(("SBATCH_", "SQUEUE_", "SLURM_")) and name != "SLURM_CONF":
                del self.environment[name]
        self.daemon("munged", "--foreground", "--force", f"--key-file={folder}/munge.key",
                    f"--socket={folder}/munge.socket", f"--pid-file={folder}/munge.pid",
                    f"--log-file={folder}/munge.log", f"--seed-file={folder}/munge.seed")
        self.await_("munged", lambda: (folder / "munge.socket").exists())
        self.daemon("slurmctld", "-D", "-i")
        self.daemon("slurmd", "-D")
        self.await_("a node", lambda: "idle" in self.call("sinfo", "--noheader").stdout)

    def daemon(self, program, *arguments):
        log = open(self.folder / f"{program}.out", "w", encoding="utf-8")
        self.processes.append(subprocess.Popen(
            [find(program), *arguments], env=self.environment, stdout=log, stderr=log,
            stdin=subprocess.DEVNULL, start_new_session=True, preexec_fn=end_with_parent))
        log.close()

    def await_(self, what, ready, seconds=20):
        end = time.monotonic() + seconds
        while not ready():
            ended = [p.args[0] for p in self.processes if p.poll() is not None]
            if ended or time.monotonic() > end:
                logs = "".join(f"{log.name}: {log.read_text(errors='replace')[-1500:]}\n"
                               for log in sorted(self.folder.glob("*.*"))
                               if log.suffix in (".out", ".log"))
                raise CannotStart(f"{what} does not come up {ended}\n{logs}")
            time.sleep(0.1)

    def call(self, program, *arguments, **more):
        return subprocess.run([find(program) or program, *arguments], env=self.environment,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)

    def queue(self):
        """Lines "JOB TASK STATE SCRIPT" of what waits or runs."""
        told = self.call("squeue", "--array", "--noheader", "--format=%F %K %t %o")
        if told.returncode != 0:
            raise CannotStart(f"squeue: {told.stdout}")
        return [line.split(" ", 3) for line in told.stdout.splitlines()]

    def await_end(self, seconds=60):
        """Nothing waits or runs. What goes back into the queue may not start for two minutes; a few
        seconds are enough for the pass of its first start to be void."""
        hurried = set()

        def empty():
            waiting = self.call("squeue", "--array", "--noheader", "--format=%i %r").stdout
            for line in waiting.splitlines():
                job, reason = line.split(" ", 1)
                if reason == "BeginTime" and job not in hurried:
                    hurried.add(job)
                    self.call("scontrol", "update", f"job={job}", "StartTime=now+3")
            return not self.queue()
        self.await_("the end of all jobs", empty, seconds)

    def stop(self):
        """In the opposite order of the start; first the jobs, whose processes are nobody's child."""
        try:
            self.end_jobs()
        finally:
            self.end_daemons()

    def end_jobs(self):
        if len(self.processes) < 3 or any(p.poll() is not None for p in self.processes):
            return
        self.call("scancel", f"--user={os.getuid()}")
        end = time.monotonic() + 15
        while self.queue() and time.monotonic() < end:
            time.sleep(0.1)

    def end_daemons(self):
        for process in reversed(self.processes):
            if process.poll() is None:
                process.send_signal(signal.SIGTERM)
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self.processes = []
