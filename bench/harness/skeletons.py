"""Counts of a curve-skeleton, by one rule for all programs."""

from collections import Counter


def read_obj(path):
    """Number of nodes and the edges of an OBJ of 'v' and 'l' lines, polylines cut into edges."""
    nodes, edges = 0, set()
    with open(path, encoding="ascii") as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                nodes += 1
            elif words[:1] == ["l"]:
                ids = [int(word) - 1 for word in words[1:]]
                edges.update(tuple(sorted(e)) for e in zip(ids, ids[1:]) if e[0] != e[1])
    return nodes, edges


def counts(path):
    """Components, cycles and tips (nodes with one edge)."""
    nodes, edges = read_obj(path)
    parent = list(range(nodes))

    def root(i):
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    components = nodes
    for a, b in edges:
        a, b = root(a), root(b)
        if a != b:
            parent[a] = b
            components -= 1
    degree = Counter(node for edge in edges for node in edge)
    return {
        "components": components,
        "cycles": len(edges) - nodes + components,
        "tips": sum(1 for d in degree.values() if d == 1),
    }


def is_expected(found, expected):
    """Whether counts are what a manifest says: numbers, [least, most], or no number: any."""
    for key, value in found.items():
        wanted = expected.get(key)
        if isinstance(wanted, list) and not wanted[0] <= value <= wanted[1]:
            return False
        if isinstance(wanted, int) and value != wanted:
            return False
    return True
