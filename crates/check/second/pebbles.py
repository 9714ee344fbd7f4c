"""Ranks by counting alone: the pebble game of multigraphs of which k |X| - (k + 1) edges are independent on nodes X.

With k = 3 and two copies of each edge it gives the generic rank of N, with k = 2 that of the plane direction matrix R
(theory, Corollary 13.8). No arithmetic is done, so that it cannot err in the way in which elimination can.
"""

STEPS = 2_000_000  # nodes times edges; plain Python needs seconds up to there


def independent_edges(n, edges, k):
    """How many of k - 1 copies of each edge are independent.

    Each node has k pebbles; an accepted copy is covered by one of an end of its own, and points to its other end. A copy
    is independent of those before it if k + 2 pebbles can be brought together at its two ends.
    """
    free, out, count = [k] * n, [[] for _ in range(n)], 0

    def bring(to, other):
        """Brings one pebble to a node, against the direction of edges, and not by way of the other one."""
        before, todo = {to: None, other: None}, [to]
        while todo:
            node = todo.pop()
            for after in out[node]:
                if after in before:
                    continue
                before[after] = node
                if free[after]:
                    free[after] -= 1
                    free[to] += 1
                    while after != to:
                        node = before[after]
                        out[node].remove(after)
                        out[after].append(node)
                        after = node
                    return True
                todo.append(after)
        return False

    for u, v in edges:
        for _ in range(k - 1):
            while free[u] + free[v] < k + 2 and (bring(u, v) or bring(v, u)):
                pass
            if free[u] + free[v] < k + 2:
                break
            near, far = (u, v) if free[u] else (v, u)
            free[near] -= 1
            out[near].append(far)
            count += 1
        if count == k * n - k - 1:
            break
    return count


def counted_rank(n, edges, model):
    """The generic rank of a core by counting, in the unit of the model; None where it is not to be had, or too dear."""
    if model == "projective" or n * len(edges) > STEPS:
        return None
    return independent_edges(n, edges, 3) if model == "calibrated" else 4 * independent_edges(n, edges, 2)
