"""B.4.1, transform 0: the quadrature mirror filter."""

from vectors import plus_scaled

PLACES = ((1, 6), (2, -2), (3, 0.5), (-3, 0.5), (-2, 2), (-1, -6))


def apply_details(level, points, refined, moves):
    """P p + Q d, where `refined` is P p and `moves` are the details as vectors by edge."""
    result = list(refined)
    for edge, move in moves.items():
        column = curve_column(level, edge) if level.sharp[edge] else smooth_column(level, edge)
        for vertex, weight in column:
            result[vertex] = plus_scaled(result[vertex], weight / 16, move)
    return result


def curve_column(level, edge):
    """(vertex, weight over 16) of a boundary or crease edge."""
    odd = level.vertex_count + edge
    column = [(odd, 12)]
    for vertex in level.ends[edge]:
        column += [(vertex, -8), (level.vertex_count + next_along_curve(level, edge, vertex), 2)]
    return column


def next_along_curve(level, edge, vertex):
    """The other sharp edge at the vertex, or the edge itself where the curve ends."""
    sharp = level.sharp_edges[vertex]
    if level.is_corner[vertex] or len(sharp) != 2:
        return edge
    return sharp[1] if sharp[0] == edge else sharp[0]


def smooth_column(level, edge):
    """(vertex, weight over 16) of a smooth edge."""
    first_odd = level.vertex_count
    column = [(first_odd + edge, 10)]
    for vertex in level.ends[edge]:
        column.append((vertex, -6))
        edge_at = fan_places(level, edge, vertex)
        column += [(first_odd + edge_at(place), weight) for place, weight in PLACES]
    for side in level.left[edge], level.right[edge]:
        apex = level.opposite(side)
        column.append((apex, -2))
        one, other = level.side_edges(side)
        column.append((first_odd + edge_beyond(level, one, other, side, apex), 1))
        column.append((first_odd + edge_beyond(level, other, one, side, apex), 1))
    return column


def fan_places(level, edge, vertex):
    """A function from a place, counted counter-clockwise from the edge, to the edge there."""
    fan = level.fans[vertex]
    edges, own = fan.edges, fan.edges.index(edge)
    if fan.closed and len(level.sharp_edges[vertex]) < 2:
        return lambda place: edges[(own + place) % len(edges)]
    sector, h = enclosing_sector(level, fan, own)
    s = len(sector) - 1

    def edge_at(place):
        q = (h + place) % (2 * s)
        return sector[2 * s - q if q > s else q]

    return edge_at


def enclosing_sector(level, fan, own):
    """The edges from the last sharp one before `own` to the first one after it; own's number."""
    edges, count = fan.edges, len(fan.edges)
    first = own
    while not level.sharp[edges[first % count]]:
        first -= 1
    last = own
    while not level.sharp[edges[last % count]]:
        last += 1
    return [edges[k % count] for k in range(first, last + 1)], own - first


def edge_beyond(level, between, third, side, apex):
    """Beyond the edge `between`: the other edge that meets the apex; `third` if it is sharp."""
    if level.sharp[between]:
        return third
    left, right = level.left[between], level.right[between]
    beyond = right if left[0] == side[0] else left
    one, other = level.side_edges(beyond)
    return one if apex in level.ends[one] else other
