# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with how a trial ended; nothing where all is as it should be."""

import hashlib
import json
import math
import re
import signal
from pathlib import Path

from inputs import RESULTS

ROOT = Path(__file__).resolve().parents[3]
OURS = {path.name for path in (ROOT / "src").rglob("*.[CH]") if "Make" not in path.parts}
SANITIZER = re.compile(r"runtime error:|AddressSanitizer|LeakSanitizer")
MEMORY = re.compile(r"AddressSanitizer: (requested allocation size|.*out-of-memory|.*exceeds maximum)")
TRACE = re.compile(r"^#\d+ |printStack|sigHandler|core dumped|terminate called", re.MULTILINE)


def lacksMemory(log):
    """Sanitizers end a program that lacks memory, which it could have told itself."""
    return bool(MEMORY.search(log))


def sums(folder):
    """The files of a set of results, but the one that tells seconds."""
    return {
        str(path.relative_to(folder)): hashlib.md5(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.name not in ("timing.dat", ".files")
    }


def ending(status, log, prefix):
    """The exit code is 0, or 1 with one message; no signal, no line of ours."""
    if status & 0x7F:
        number = status & 0x7F
        yield "it takes too long" if number == signal.SIGALRM else f"signal {number}"
        return
    code = status >> 8
    if SANITIZER.search(log):
        yield "sanitizer: " + log[SANITIZER.search(log).start() :].split("\n")[0][:200]
        return
    if code not in (0, 1):
        yield f"code {code}"
    if TRACE.search(log):
        yield "a stack trace"
    if prefix:
        if code == 1 and (len(log.strip().split("\n")) != 1 or not log.startswith(prefix)):
            yield "not one line"
        return
    # OpenFOAM's reader has a message of its own for keywords that it does not like.
    n = len(re.findall(r"FOAM FATAL|^Invalid option|is considered fatal$", log, re.MULTILINE))
    if n != code:
        yield f"code {code} and {n} messages"
    for name in re.findall(r"From function [^\n]*\n\s*in file (\S+)", log):
        if Path(name).name in OURS:
            yield f"a line of {name}"
    if "An error without a message" in log:
        yield "no message"
    if code == 0 and "\nEnd\n" not in log:
        yield "no end"


def numbers(path):
    """Rows of a table; those of words are left out."""
    for line in path.read_text(encoding="utf-8").splitlines():
        if not line.startswith("#"):
            yield [float(word) for word in line.split() if not re.match(r"[a-z]{3,}$", word) or word == "nan"]


def wholeness(folder):
    """A set is whole: what its lists name is there, and tables tell the same times."""
    for path in folder.rglob("*"):
        if path.suffix == ".tmp":
            yield f"{path.name} is left"
    for path in folder.glob("*.series"):
        for entry in json.loads(path.read_text(encoding="utf-8"))["files"]:
            file = folder / entry["name"]
            if not file.is_file() or not file.read_bytes().rstrip().endswith(b"</VTKFile>"):
                yield f"{file.name} is not whole"
    rows = {}
    for name in ("stability.dat", "survival.dat", "droplets.dat"):
        if (folder / name).is_file():
            table = list(numbers(folder / name))
            rows[name] = [row[0] for row in table]
            if not all(math.isfinite(x) for row in table for x in row):
                yield f"{name} has numbers that are not finite"
    if rows.get("stability.dat") != rows.get("survival.dat"):
        yield "the tables have different times"


def results(code, case, earlier):
    """The earlier set is there, or a whole one in its place."""
    folder = case / RESULTS
    if not folder.is_dir():
        yield "the earlier results are gone"
        return
    previous = folder / "previous"
    now = sums(folder)
    kept = earlier.items() <= now.items() and not previous.exists()
    putAside = previous.is_dir() and earlier.items() <= sums(previous).items()
    if code == 1 and not kept and not putAside:
        yield "the earlier results are damaged"
    if code == 0 and previous.exists():
        yield "the earlier results are left in the way"
    if not kept:
        yield from wholeness(folder)
    for other in case.glob("postProcessing/interfaceStability*/*"):
        if other.is_dir() and other != folder:
            yield from wholeness(other)


def solved(case, fields):
    """The solver's fields are those of a run without us."""
    for name, content in fields.items():
        path = case / name
        if not path.is_file() or path.read_bytes() != content:
            yield f"{name} differs"


def faults(trial, status, log, case, base):
    """All that is wrong, in words."""
    if trial.program == "interFoam" and "Create mesh" not in log:
        # The solver's own reading of controlDict, before it loads any library of ours.
        return list(results(1, case, base.earlier))
    viewing = trial.program == "interfaceStabilityView"
    found = list(ending(status, log, "interfaceStabilityView: " if viewing else ""))
    code = -1 if status & 0x7F else status >> 8
    if viewing:
        if code == 0 and not list(case.rglob("*.png")):
            found.append("no picture")
        return found
    found += list(results(code, case, base.earlier))
    if trial.program == "interFoam" and code == 0:
        found += list(solved(case, base.solverFields))
    return found
