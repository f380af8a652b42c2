"""Circles in graphs."""


def find_circles(graph):
    """Yields circles of a graph (node -> nodes), at least one where there is any, as lists of nodes.

    Each begins with its least node, and ends with it.
    """
    state, stack = {}, []

    def visit(node):
        state[node] = "open"
        stack.append(node)
        for target in graph.get(node, ()):
            if state.get(target) == "open":
                circle = stack[stack.index(target):]
                least = circle.index(min(circle))
                yield circle[least:] + circle[:least + 1]
            elif target not in state:
                yield from visit(target)
        stack.pop()
        state[node] = "done"

    for node in sorted(graph):
        if node not in state:
            yield from visit(node)
