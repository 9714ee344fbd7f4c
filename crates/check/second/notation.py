"""Section 1 of docs/certificate.md: one strict JSON text, its values, and the three ways to refuse one.

What the other files of this folder say about a certificate, they say with `need`: a condition, and the reason for which
the certificate is rejected where it does not hold.
"""

import functools
import json
import re
import sys

DIGITS_LIMIT = 100_000  # of a *big*
if hasattr(sys, "set_int_max_str_digits"):
    sys.set_int_max_str_digits(0)  # the limit on digits is the one above


# Section 3: a and b of full(k) = a k - b, columns for each node.
MODELS = {"projective": (11, 15, 12), "calibrated": (3, 4, 3), "affine": (8, 12, 2)}


class Reject(Exception):
    """The certificate does not prove its claim."""


class Unreadable(Exception):
    """A file cannot be read, or does not hold one graph for sure."""


class TooLarge(Exception):
    """The certificate may be right, but is beyond this checker's limits."""


def need(condition, reason):
    if not condition:
        raise Reject(reason)


# Section 1: notation -------------------------------------------------------------------------------------------------


def parse(data):
    """Section 1: one strict JSON text."""
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        raise Reject("the text is not UTF-8") from None
    need(not text.startswith("\ufeff"), "the text begins with a byte order mark")
    depth = 0
    for mark in re.findall(r"[\[{\]}]", re.sub(r'"(?:[^"\\]|\\.)*"', "", text, flags=re.S)):
        depth += 1 if mark in "[{" else -1
        need(depth <= 127, "objects and lists are nested more than 127 deep")

    def pairs(items):
        found = dict(items)
        need(len(found) == len(items), "a member is repeated")
        return found

    def integer(digits):
        need(re.fullmatch(r"0|-?[1-9][0-9]{0,15}", digits), f"{digits[:40]} is not an int")
        need(abs(int(digits)) < 2**53, f"the int {digits} is not below 2^53")
        return int(digits)

    def refuse(token):
        raise Reject(f"the number {token[:40]} is not an int")

    try:
        document = json.loads(
            text, object_pairs_hook=pairs, parse_int=integer, parse_float=refuse, parse_constant=refuse
        )
    except json.JSONDecodeError as error:
        raise Reject(f"not JSON: {error}") from None
    escaped = json.dumps(document, ensure_ascii=False) if "\\" in text else ""
    need(not re.search("[\ud800-\udfff]", escaped), "an escape is half of a surrogate pair")
    return document


# Evidence that was moved to the laboratory, as the member or the kind that it was.
LABORATORY = ("oriented", "overlap", "added", "points")
OF_LABORATORY = "belongs to the laboratory: this checker does not verify it"


def members(value, names, where):
    """The values of exactly the members `names` (separated by blanks) of an object, in that order."""
    need(type(value) is dict, f"{where} is not an object")
    names = names.split()
    for name in names:
        need(name in value, f"{where}: the member {name} is missing")
    for name in value:
        need(name in names or name not in LABORATORY, f"{where}: evidence {name} {OF_LABORATORY}")
        need(name in names, f"{where}: the member {name} is unknown")
    return [value[name] for name in names]


def members_about(question, document, names, where):
    """Section 3: the members of the document of a question, without those that every document has."""
    version = document.get("version") if type(document) is dict else None
    need(type(version) is not int or version >= 3, f"section 3: version {version} is not read any more; write the certificate anew")
    form, version, asked, program, *values = members(document, "format version question program " + names, where)
    need(same(form, "viewcert certificate"), "section 3: the format is another")
    need(same(version, 3), "section 3: the version is not 3")
    need(same(asked, question), "section 3: there is no such question")
    a_string(program, f"{where}: program")
    return values


def a_list(value, where):
    need(type(value) is list, f"{where} is not a list")
    return value


def a_string(value, where):
    need(type(value) is str, f"{where} is not a string")
    return value


def an_int(value, where, least=None, below=None):
    need(type(value) is int, f"{where} is not an int")
    need(least is None or value >= least, f"{where}: {value} is below {least}")
    need(below is None or value < below, f"{where}: {value} is out of range")
    return value


def a_big(value, where, least=None, below=None):
    need(type(value) is str and re.fullmatch(r"0|-?[1-9][0-9]*", value), f"{where} is not a big")
    if below is not None:
        need(len(value) <= len(str(below)), f"{where} is out of range")
    if len(value) > DIGITS_LIMIT:
        raise TooLarge(f"{where} has more than {DIGITS_LIMIT} digits")
    number = int(value)
    need(least is None or number >= least, f"{where}: {number} is below {least}")
    need(below is None or number < below, f"{where} is out of range")
    return number


def a_pair(value, where):
    need(type(value) is list and len(value) == 2, f"{where} is not a pair")
    i, j = (an_int(node, where) for node in value)
    need(i < j, f"{where}: a pair has the smaller node first")
    return (i, j)


def increasing(values, where):
    need(all(a < b for a, b in zip(values, values[1:])), f"{where} is not increasing")
    return values


def same(a, b):
    """Whether two JSON values are the same; true is not 1."""
    return type(a) is type(b) and a == b


def distinct(points):
    return len(set(points)) == len(points)


@functools.lru_cache(maxsize=1024)
def is_prime(p):
    """Strong pseudoprimes to all of these bases are beyond 2^81 (theory, section 7)."""
    bases = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)
    if p < 2 or any(p % b == 0 for b in bases):
        return p in bases
    twos = (p - 1 & 1 - p).bit_length() - 1
    for base in bases:
        power = pow(base, p - 1 >> twos, p)
        if power == 1:
            continue
        for _ in range(twos - 1):
            if power == p - 1:
                break
            power = power * power % p
        if power != p - 1:
            return False
    return True
