# SPDX-License-Identifier: GPL-3.0-or-later
"""The kinds of trials: each damages a copy of a case and says what to run on it."""

import gzip
import shutil

import mutations

HEADER = b"FoamFile { version 2.0; format ascii; class dictionary; object x; }\n"
DICTIONARY = "system/interfaceStabilityDict"
RESULTS = "postProcessing/interfaceStability/0"

DICTIONARIES = (
    b"alpha alpha.water; U U; phi phi; velocity flux; region region0;\n"
    b"reconstruction isoAlpha; sharpening auto; volumeFit component; smooth 0;\n"
    b"epsilon 0.5; merge nearest; normalGate yes; seamTreatment yes;\n"
    b"wallVelocity slip; tolerance 1e-3; maxParticles 1000; flattening lscm; nThreads 1;\n"
    b"surfaceInterval 1; particleInterval 1; surfaceParts whole; writePrecision 15;\n",
    b"reconstruction bonnell; smooth 2; epsilonAbsolute 0.01; flattening tutte; nThreads 1;\n"
    b"merge untracked; surfaceParts pieces; wallVelocity noSlip;\n"
    b"reconstructions ( later { from 0.001; reconstruction plic; epsilon 0.7; seamTreatment no; }\n"
    b"    last { from 0.003; sharpening profile; volumeFit none; } );\n",
    b"methods ( sharp { sharpening plic; } plain { sharpening none; smooth 1; } ); nThreads 1;\n",
)
ENTRIES = (
    b"timeStart 0; timeEnd 1; enabled yes; log yes; executeControl timeStep; executeInterval 1;\n"
    b"writeControl timeStep; writeInterval 1; classifyControl timeStep; classifyInterval 1;\n"
    b"classifyDisplacement 0.5; writeToFile yes; onError stop; epsilon 0.5; nThreads 1;\n"
    b"reconstruction isoAlpha; reconstructions ( later { from 0.001; sharpening none; } );\n",
    b"type interfaceStability; libs (interfaceStability); classifyControl runTime;\n"
    b"classifyInterval 0.002; onError resume; alpha alpha.water; smooth 1; flattening tutte;\n"
    b"maxParticles 10; surfaceInterval 2; particleInterval 2;\n",
)
METHODS = (
    b"# method stableFraction meanDistance area volumeError detached(1) attached(1)\n"
    b"sharp 0.9 0.1 2 0.001 0.3 0.4\nplain 0.8 0.2 2 0.01 0.4 0.5\n"
)
TIMES = (
    "0.0020 2e-3 00.002 1e-400 1e400 nan inf -0.002 -1 0.002a 0.002~ 1e308 1e-320 9.8e99 "
    "0.00200000000000000001 0.002000000000000001 0.0040000000001 1000000 5 .002 2. 1e+ 0x1 "
    "constant.bak 0.orig processor0 processors2 0.003"
).split()
SELECTIONS = (
    "0: :0 : 0:0.002 0.002: 0.004,0 a 1e400 -1: 0:nan inf 0.001 constant 0:0.002,0.004 ,, 5:6 : :: 0.002:0.001"
).split()


class Trial:
    """What to run: a program with arguments in a folder, and what was done to its input."""

    def __init__(self, program, arguments, what):
        self.program = program
        self.arguments = list(arguments)
        self.what = what


def damage(rng, path, kinds):
    """Mutates this file; tells what was done."""
    data, what = mutations.mutated(rng, path.read_bytes(), kinds)
    path.write_bytes(data)
    return f"{path.name}: {what}"


def copyOf(base, case):
    if case.exists():
        shutil.rmtree(case)
    shutil.copytree(base, case, symlinks=True)


def fields(rng, bases, case):
    base = rng.choice(("ascii", "ascii", "binary"))
    copyOf(bases / base, case)
    files = sorted(f for f in case.glob("0*/*") if f.name in ("alpha.water", "U", "phi"))
    path = rng.choice(files)
    chance = rng.random()
    if chance < 0.08:
        other = rng.choice(files)
        path.write_bytes(other.read_bytes())
        what = f"{path.name}: is {other.parent.name}/{other.name}"
    elif chance < 0.16:
        packed = path.with_name(path.name + ".gz")
        packed.write_bytes(gzip.compress(path.read_bytes(), mtime=0))
        path.unlink()
        what = damage(rng, packed, mutations.BYTES)
    else:
        what = damage(rng, path, mutations.FIELD)
    return Trial("interfaceStability", [], f"{base}/{path.parent.name}/{what}")


def dictionary(rng, bases, case):
    copyOf(bases / "ascii", case)
    path = case / DICTIONARY
    path.write_bytes(HEADER + rng.choice(DICTIONARIES))
    return Trial("interfaceStability", [], damage(rng, path, mutations.DICTIONARY))


def solver(rng, bases, case):
    copyOf(bases / "solver", case)
    entries = rng.choice(ENTRIES)
    data, what = mutations.mutated(rng, entries, mutations.DICTIONARY)
    path = case / "system" / "controlDict"
    head = b"" if b"libs" in entries else b"type interfaceStability; libs (interfaceStability);\n"
    path.write_bytes(path.read_bytes() + b"functions { interfaceStability {\n" + head + data + b"} }\n")
    return Trial("interFoam", [], f"functions: {what}")


def surfaces(rng, bases, case):
    copyOf(bases / "files", case)
    form = rng.choice(("own", "own", "ascii", "inline", "raw", "base64", "lz4", "stl", "obj"))
    end = form if form in ("stl", "obj") else "vtp"
    files = f'files "surfaces/{form}/interface_<index>.{end}";'
    (case / DICTIONARY).write_bytes(HEADER + b"reconstruction fromFiles; nThreads 1;" + files.encode())
    path = case / "surfaces" / form / f"interface_00000{rng.randrange(3)}.{end}"
    what = damage(rng, path, mutations.VTK if end == "vtp" else mutations.TABLE)
    return Trial("interfaceStability", [], f"{form}/{what}")


def viewer(rng, bases, case):
    copyOf(bases / "ascii", case)
    results = case / RESULTS
    names = ["interface_000002.vtp"] * 5 + ["particles_000002.vtp"] * 2 + [
        "texture.png",
        "interface.vtp.series",
        "particles.vtp.series",
        "stability.dat",
        "methods.dat",
    ]
    (results / "methods.dat").write_bytes(METHODS)
    path = results / rng.choice(names)
    if path.name == "interface_000002.vtp":
        form = rng.choice(("own", "own", "own", "ascii", "inline", "raw", "base64", "lz4"))
        shutil.copy(bases / "files" / "surfaces" / form / path.name, path)
    what = damage(rng, path, mutations.VTK if path.suffix == ".vtp" else mutations.TABLE)
    arguments = ["-batch", "-size", "320x240", "-output", "pictures"]
    arguments += ["-methods", str(path.relative_to(case))] if path.name == "methods.dat" else ["."]
    return Trial("interfaceStabilityView", arguments, what)


def times(rng, bases, case):
    copyOf(bases / "ascii", case)
    said = []
    arguments = []
    for _ in range(rng.choice((1, 1, 2, 3))):
        folder = case / rng.choice(("0", "0.002", "0.004"))
        name = rng.choice(TIMES)
        action = rng.choice((renamed, copied, withoutFile, otherTime, inTheWay, selected))
        said.append(action(rng, case, folder, name, arguments))
    return Trial("interfaceStability", arguments, ", ".join(said))


def renamed(rng, case, folder, name, arguments):
    if folder.is_dir() and not (case / name).exists():
        folder.rename(case / name)
    return f"{folder.name} becomes {name}"


def copied(rng, case, folder, name, arguments):
    if folder.is_dir() and not (case / name).exists():
        shutil.copytree(folder, case / name, symlinks=True)
    return f"{folder.name} is also {name}"


def withoutFile(rng, case, folder, name, arguments):
    path = folder / rng.choice(("alpha.water", "U", "phi", "uniform/time", "p_rgh"))
    if path.exists():
        path.unlink()
    return f"no {folder.name}/{path.name}"


def otherTime(rng, case, folder, name, arguments):
    path = folder / "uniform" / "time"
    return f"{folder.name}/{damage(rng, path, mutations.DICTIONARY)}" if path.exists() else "nothing"


def inTheWay(rng, case, folder, name, arguments):
    path = rng.choice((case / name, folder / rng.choice(("alpha.water", "U", "phi"))))
    if path.is_dir():
        return "nothing"
    path.unlink(missing_ok=True)
    if not path.parent.is_dir():
        return "nothing"
    kind = rng.choice(("a folder", "a dangling link", "a link to itself", "an empty file"))
    if kind == "a folder":
        path.mkdir()
    elif kind == "an empty file":
        path.touch()
    else:
        path.symlink_to("nowhere" if kind == "a dangling link" else path.name)
    return f"{path.relative_to(case)} is {kind}"


def selected(rng, case, folder, name, arguments):
    if not arguments:
        arguments += ["-time", rng.choice(SELECTIONS)]
    return " ".join(arguments)


KINDS = (fields,) * 8 + (dictionary,) * 5 + (solver,) + (surfaces,) * 3 + (viewer,) * 2 + (times,) * 2
