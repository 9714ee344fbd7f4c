"""Section 7 of docs/certificate.md, linear algebra: elimination modulo a prime, with given pivots and without.

Rows are dicts from column to residue.
"""

import functools
import heapq
import math

from notation import TooLarge, need

# Exponents of Mersenne primes: moduli for determinants and ranks over Q.
MERSENNE = (61, 521, 1279, 2203, 4423, 9689, 11213, 19937, 23209, 44497, 86243)


class Elimination:
    """Section 7: elimination modulo p with pivots in a given order: the submatrix is lower times upper."""

    def __init__(self, rows, columns, p, where):
        self.p, self.columns, self.upper, self.lower = p, columns, [], []
        self.place = {column: k for k, column in enumerate(columns)}
        for row in rows:
            self.add({self.place[c]: v % p for c, v in row.items() if c in self.place}, where)

    def add(self, row, where):
        k, p = len(self.upper), self.p
        factors = reduce_row(row, self.upper, k, p)
        pivot = row.pop(k, 0)
        need(pivot, f"{where}: pivot {k} is zero")
        unit = pow(pivot, -1, p)
        factors[k] = pivot
        self.lower.append(factors)
        self.upper.append({s: v * unit % p for s, v in row.items() if v})

    def determinant(self):
        return functools.reduce(lambda x, k: x * self.lower[k][k] % self.p, range(len(self.lower)), 1)

    def solve(self, right):
        """The x with x times the submatrix = right, a dict from column to entry."""
        p, rest, x = self.p, {self.place[c]: v for c, v in right.items() if c in self.place}, []
        for k, upper in enumerate(self.upper):
            value = rest.get(k, 0) % p
            x.append(value)
            if value:
                for s, u in upper.items():
                    rest[s] = rest.get(s, 0) - value * u
        for k in reversed(range(len(x))):
            lower = self.lower[k]
            x[k] = x[k] * pow(lower[k], -1, p) % p
            for t, factor in lower.items():
                if t < k:
                    x[t] -= x[k] * factor
        return x


def reduce_row(row, upper, below, p):
    """Subtracts from a row the earlier pivot rows, one after another; gives the factors."""
    todo = [t for t in row if t < below]
    heapq.heapify(todo)
    factors = {}
    while todo:
        t = heapq.heappop(todo)
        factor = row.pop(t)
        if factor:
            factors[t] = factor
            for s, u in upper[t].items():
                if s in row:
                    row[s] = (row[s] - factor * u) % p
                else:
                    row[s] = -factor * u % p
                    if s < below:
                        heapq.heappush(todo, s)
    return factors


def find_pivots(rows, p):
    """Pivots of a matrix, rows in order: for ranks of which a certificate lists no pivots."""
    pivots, upper, place = [], [], {}
    for number, row in enumerate(rows):
        # Columns with a pivot are named by its number, the others by what comes behind all these.
        row = {place.get(c, c + len(rows)): v % p for c, v in row.items()}
        reduce_row(row, upper, len(upper), p)
        row = {c: v for c, v in row.items() if v}
        if row:
            column = min(row)
            unit = pow(row.pop(column), -1, p)
            k = len(pivots)
            pivots.append((number, column - len(rows)))
            upper.append({c: v * unit % p for c, v in row.items()})
            place[column - len(rows)] = k
            for earlier in upper:
                if column in earlier:
                    earlier[k] = earlier.pop(column)
    return pivots


def primitive(row):
    """Section 7: a row divided by the greatest common divisor of its entries, without zeros."""
    divisor = functools.reduce(math.gcd, row.values(), 0)
    return {c: x // divisor for c, x in row.items() if x}


def modulus_above(rows, where):
    """A Mersenne prime above twice every minor of these rows: entries of a row are at most its norm."""
    bits = 2 + sum((sum(x * x for x in row) or 1).bit_length() for row in rows) // 2 + len(list(rows))
    for exponent in MERSENNE:
        if exponent > bits:
            return 2**exponent - 1
    raise TooLarge(f"{where}: numbers of {bits} bits")
