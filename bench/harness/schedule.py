"""What more cores would bring, on paper."""

import heapq


def makespan(tasks, cores):
    """When the last of `tasks` is done, each taken in this order by the first core that is free."""
    free = [0.0] * cores
    for seconds in tasks:
        heapq.heapreplace(free, free[0] + seconds)
    return max(free)


def prediction(views, serial, cores):
    """[(cores, milliseconds, speedup)] for the views in parallel and the rest on one core."""
    alone = sum(views) + serial
    rows = []
    for count in cores:
        whole = makespan(views, count) + serial
        rows.append((count, whole, alone / whole))
    return rows
