# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs trials of damaged input and tells which end wrongly.

trials.py FOLDER N [-seed S] [-only INDEX] [-seconds LIMIT] [-sanitized FOLDER]
FOLDER holds bases/, made by `run`, and forkServer.so. A trial depends on the seed and its
index alone; -only repeats one and keeps its case.
"""

import argparse
import collections
import os
import random
import shutil
import subprocess
import sys
import threading
from pathlib import Path

import inputs
import outcomes


class Server:
    """A program that runs once for each line (forkServer.c)."""

    libraries = {
        "interfaceStability": ["interfaceStabilityVtk"],
        "interFoam": ["interfaceStability", "interfaceStabilityVtk"],
        "interfaceStabilityView": [],
    }

    def __init__(self, program, options, sanitized):
        environment = dict(os.environ, OMP_NUM_THREADS="1")
        folder = Path(sanitized) if sanitized else Path(os.environ["FOAM_USER_LIBBIN"])
        preload = [options.folder / "forkServer.so"]
        path = shutil.which(program)
        if sanitized:
            preload = [runtime(name) for name in ("libasan.so", "libubsan.so")] + preload
            environment["LD_LIBRARY_PATH"] = f"{folder}:{environment['LD_LIBRARY_PATH']}"
            environment["ASAN_OPTIONS"] = "detect_leaks=0:max_allocation_size_mb=2000:handle_segv=0:new_delete_type_mismatch=0"
            environment["UBSAN_OPTIONS"] = "print_stacktrace=1"
            path = str(folder / program) if (folder / program).exists() else path
        else:
            environment["FORK_MEMORY"] = "4000"
        preload += [folder / f"lib{name}.so" for name in self.libraries[program]]
        environment["LD_PRELOAD"] = " ".join(map(str, preload))
        self.process = subprocess.Popen(
            [path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment
        )

    def run(self, seconds, folder, log, words):
        self.process.stdin.write("\t".join([str(seconds), str(folder), str(log), *words]) + "\n")
        self.process.stdin.flush()
        answer = self.process.stdout.readline()
        if not answer:
            raise RuntimeError(f"The server of {words[0]} has ended.")
        return int(answer)


def runtime(name):
    found = subprocess.run(["gcc", f"-print-file-name={name}"], capture_output=True, text=True, check=True)
    return found.stdout.strip()


class Bases:
    """The cases that are damaged, and what may not change."""

    def __init__(self, folder):
        self.folder = folder
        self.earlier = outcomes.sums(folder / "ascii" / inputs.RESULTS)
        solved = folder / "solved"
        self.solverFields = {
            str(path.relative_to(solved)): path.read_bytes()
            for path in solved.glob("0.0*/*")
            if path.name in ("alpha.water", "U", "phi", "p_rgh")
        }


class Worker(threading.Thread):
    """Takes trial after trial."""

    def __init__(self, number, options, bases, indices, report):
        super().__init__()
        self.options = options
        self.bases = bases
        self.indices = indices
        self.report = report
        self.case = options.folder / f"trial.{number}"
        self.log = options.folder / f"log.{number}"
        self.servers = {}

    def server(self, program, sanitized):
        key = (program, sanitized)
        if key not in self.servers:
            self.servers[key] = Server(program, self.options, sanitized)
        return self.servers[key]

    def trial(self, index, sanitized):
        rng = random.Random(f"{self.options.seed} {index}")
        trial = rng.choice(inputs.KINDS)(rng, self.bases.folder, self.case)
        status = self.server(trial.program, sanitized).run(
            self.options.seconds, self.case, self.log, [trial.program, *trial.arguments]
        )
        log = self.log.read_text(encoding="utf-8", errors="replace")
        if sanitized and outcomes.lacksMemory(log):
            return self.trial(index, None)
        return trial, status, log, outcomes.faults(trial, status, log, self.case, self.bases)

    def run(self):
        while True:
            try:
                index = self.indices.popleft()
            except IndexError:
                break
            try:
                self.report(index, *self.trial(index, self.options.sanitized), self.case)
            except Exception as failure:  # a trial that cannot be judged has failed
                self.report(index, None, -1, "", [f"{type(failure).__name__}: {failure}"], self.case)
        for server in self.servers.values():
            server.process.stdin.close()
            server.process.wait()


class Report:
    """Counts, and keeps the cases of those that failed."""

    def __init__(self, options):
        self.options = options
        self.lock = threading.Lock()
        self.ended = collections.Counter()
        self.failures = 0

    def __call__(self, index, trial, status, log, found, case):
        with self.lock:
            self.ended[(trial.program if trial else "none", status)] += 1
            if self.options.only is not None:
                print(log)
            if self.options.only is not None or found:
                print(f"trial {index} of seed {self.options.seed}: {trial.program if trial else ''} "
                      f"({trial.what if trial else ''}): {'; '.join(found) or 'as it should'}", flush=True)
            if found:
                self.failures += 1
                kept = self.options.folder / "failed" / str(index)
                if self.failures <= 40 and case.exists():
                    kept.parent.mkdir(exist_ok=True)
                    shutil.rmtree(kept, ignore_errors=True)
                    shutil.copytree(case, kept, symlinks=True)
                    kept.with_suffix(".log").write_text(log, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("n", type=int)
    parser.add_argument("-seed", default="1")
    parser.add_argument("-only", type=int)
    parser.add_argument("-from", type=int, default=0, dest="first")
    parser.add_argument("-seconds", type=int, default=60)
    parser.add_argument("-sanitized")
    options = parser.parse_args()
    options.folder = options.folder.resolve()
    chosen = range(options.first, options.first + options.n) if options.only is None else [options.only]
    indices = collections.deque(chosen)
    report = Report(options)
    bases = Bases(options.folder / "bases")
    nWorkers = 1 if options.only is not None else os.cpu_count() or 1
    workers = [Worker(k, options, bases, indices, report) for k in range(nWorkers)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    for (program, status), n in sorted(report.ended.items()):
        print(f"{n} trials of {program} with status {status}")
    sys.exit(1 if report.failures else 0)


if __name__ == "__main__":
    main()
