# SPDX-License-Identifier: GPL-3.0-or-later
"""Damage to the bytes of a file: each function takes a random generator and the bytes."""

import re
import struct

NUMBERS = (
    b"1e400 -1e400 nan inf -inf 1e308 -1e308 1e155 -1e30 1e-320 0 -0.0 -1 2 3 1.3 1e9 "
    b"2147483647 2147483648 -2147483648 4294967295 4294967296 9223372036854775807 "
    b"18446744073709551616 99999999999999999999999 0x10 1,5 1e 1e+ . 007 10000000 1000000000"
).split()
TOKENS = (
    b'{ } ( ) [ ] ; , " / // /* */ # $ ${ :. yes no none () {} (()) (;) "x y" ../x /x * . '
    b"uniform nonuniform List<scalar> List<vector> List<label> 0() 5{1} -1() "
).split(b" ")
DIRECTIVES = (
    b'#include "nowhere"',
    b'#includeIfPresent "nowhere"',
    b'#include "interfaceStabilityDict"',
    b'#include "."',
    b"#includeEtc \"caseDicts\"",
    b'#calc "1 + 1"',
    b"#codeStream { code #{ os << 1; #}; }",
    b'#eval "1 + 1"',
    b"#inputMode error",
    b"#inputMode protect",
    b"#inputMode nonsense",
    b'#remove "x"',
    b"#remove ( epsilon U )",
    b"#ifeq 1 2",
    b"#else",
    b"#endif",
    b"#if 1",
    b"#nonsense",
    b"#{ x #}",
    b"#",
    b"$nothing;",
    b"${nothing}",
    b"$:nothing",
    b"$..x",
    b"x $x;",
    b"x { $x; }",
    b'"(a|b" 1;',
    b'".*" 1;',
    b'"(.*)+(.*)+" { }',
)
NUMBER = re.compile(rb"(?<![\w.])[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?(?![\w.])")
TOKEN = re.compile(rb"[A-Za-z_][\w.<>:]*|[-+]?\d[\w.+-]*|\"[^\"\n]*\"|[{}()\[\];]")
ATTRIBUTE = re.compile(rb'(?<==")[^"<>]*(?=")')
TAG = re.compile(rb"<[^<>]*>")


def place(rng, data):
    """A position, more often than not in what comes first."""
    end = min(len(data), rng.choice((200, 1500, len(data), len(data))))
    return rng.randrange(end) if end else 0


def flipped(rng, data):
    result = bytearray(data)
    for _ in range(rng.choice((1, 1, 2, 8))):
        if result:
            result[place(rng, data)] ^= 1 << rng.randrange(8)
    return bytes(result)


def noisy(rng, data):
    at = place(rng, data)
    noise = rng.randbytes(rng.choice((1, 4, 16, 300)))
    return data[:at] + noise + data[at + len(noise) :]


def cutShort(rng, data):
    return data[: rng.choice((0, place(rng, data), max(0, len(data) - rng.randrange(1, 60))))]


def cutOut(rng, data):
    at = place(rng, data)
    return data[:at] + data[at + rng.choice((1, 8, 100, 2000)) :]


def doubled(rng, data):
    at = place(rng, data)
    end = at + rng.choice((1, 8, 100, 2000))
    return data[:end] + data[at:end] + data[end:]


def replaced(rng, data, pattern, values):
    """One of the places that match gets another value, or one from elsewhere."""
    found = list(pattern.finditer(data))
    if not found:
        return data
    hit = found[min(rng.randrange(len(found)), rng.randrange(len(found)))]
    value = rng.choice(values) if rng.random() < 0.8 else rng.choice(found)[0]
    return data[: hit.start()] + value + data[hit.end() :]


def otherNumber(rng, data):
    return replaced(rng, data, NUMBER, NUMBERS)


def otherToken(rng, data):
    return replaced(rng, data, TOKEN, NUMBERS + TOKENS)


def withoutToken(rng, data):
    return replaced(rng, data, TOKEN, (b"",))


def moreTokens(rng, data):
    found = list(TOKEN.finditer(data))
    if not found:
        return data
    hit = rng.choice(found)
    more = rng.choice(
        (hit[0], rng.choice(TOKENS), rng.choice(NUMBERS), rng.choice(found)[0], rng.choice(DIRECTIVES))
    )
    return data[: hit.end()] + b" " + more + b"\n" + data[hit.end() :]


def nested(rng, data):
    """Braces within braces."""
    at = rng.choice([0] + [hit.end() for hit in re.finditer(rb"[;{}(]", data)])
    n = rng.choice((1, 3, 200, 5000))
    opened, closed = rng.choice(((b"{", b"}"), (b"x {", b"}"), (b"(", b")"), (b"x (", b");")))
    missing = rng.choice((0, 0, 1, n))
    return data[:at] + opened * n + closed * (n - missing) + data[at:]


def withDirective(rng, data):
    at = rng.choice([0, len(data)] + [hit.end() for hit in re.finditer(rb"[;{}]", data)])
    return data[:at] + b"\n" + rng.choice(DIRECTIVES) + b"\n" + data[at:]


def otherBinary(rng, data):
    """Numbers of a binary list, or of raw data, become others."""
    start = data.find(b"(", data.find(b"List<")) + 1 or data.find(b"_") + 1
    result = bytearray(data)
    for _ in range(rng.choice((1, 3, 50))):
        value = rng.choice(
            [struct.pack("<d", x) for x in (float("nan"), float("inf"), 1e308, -1e155, 1e-310, 1.5, -1e9)]
            + [struct.pack("<q", x) for x in (-1, 0, 1, 2**31 - 1, 2**31, 2**40, 2**62)]
            + [struct.pack("<i", x) for x in (-1, 0, 1, 100000, 2**31 - 1, -(2**31))]
        )
        at = start + len(value) * rng.randrange(max(1, min(rng.choice((4, 10**7)), (len(data) - start) // 8)))
        result[at : at + len(value)] = value
    return bytes(result)


def otherAttribute(rng, data):
    values = NUMBERS + (
        b"Int8 Int32 Int64 UInt8 UInt32 UInt64 Float32 Float64 String ascii binary appended raw base64 "
        b"LittleEndian BigEndian vtkZLibDataCompressor vtkLZ4DataCompressor vtkLZMADataCompressor "
        b"connectivity offsets Points vertex cellSize 1.0 2.0 0.1"
    ).split() + [b""]
    return replaced(rng, data, ATTRIBUTE, values)


def otherTags(rng, data):
    found = list(TAG.finditer(data))
    if not found:
        return data
    hit = rng.choice(found)
    return data[: hit.start()] + rng.choice((b"", hit[0] * 2, rng.choice(found)[0])) + data[hit.end() :]


BYTES = (flipped, noisy, cutShort, cutOut, doubled)
FIELD = BYTES + (otherNumber,) * 4 + (otherToken,) * 2 + (withoutToken, moreTokens, otherBinary, otherBinary)
DICTIONARY = (flipped, cutShort, otherNumber, nested) + 2 * (otherToken, withoutToken, moreTokens, withDirective)
VTK = BYTES + (otherNumber, otherTags, otherBinary, otherBinary) + (otherAttribute,) * 4
TABLE = BYTES + (otherNumber, otherToken, withoutToken, moreTokens)


def mutated(rng, data, mutations):
    """The data, and the names of what was done to them."""
    names = []
    for _ in range(rng.choice((1, 1, 1, 2, 3))):
        mutation = rng.choice(mutations)
        data = mutation(rng, data)
        names.append(mutation.__name__)
    return data, "+".join(names)
