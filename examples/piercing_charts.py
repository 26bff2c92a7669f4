"""Pictures of the studies of piercing-machine.ssp, two panels each, as SVG."""

import html
import math

BLUE, ORANGE, GREEN, SKY, RED = "#0072B2", "#E69F00", "#009E73", "#56B4E9", "#D55E00"
"""Colours of Okabe and Ito."""
INK, GREY, LIGHT, GRID = "#222222", "#777777", "#dddddd", "#e9e9e9"

WIDTH, HEIGHT, LEFT, TOP, NEXT = 460, 330, 110, 112, 590
"""Size of a panel, left and top of the first one, distance of the second one."""


def text(x, y, words, size=14, anchor="start", fill=INK, **attributes):
    more = "".join(f' {name.replace("_", "-")}="{value}"' for name, value in attributes.items())
    return (f'<text x="{x:.2f}" y="{y:.2f}" font-size="{size}" text-anchor="{anchor}" fill="{fill}"{more}>'
            f"{html.escape(words)}</text>")


def line(points, color=INK, width=1.0):
    path = " ".join(f"{x:.2f},{y:.2f}" for x, y in points)
    return f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="{width}"/>'


def rectangle(x, y, width, height, fill):
    return f'<rect x="{x:.2f}" y="{y:.2f}" width="{width:.2f}" height="{height:.2f}" fill="{fill}"/>'


def circle(x, y, color, size=4.5):
    return f'<circle cx="{x:.2f}" cy="{y:.2f}" r="{size}" fill="{color}"/>'


def square(x, y, color):
    return rectangle(x - 3.5, y - 3.5, 7, 7, color)


def triangle(x, y, color):
    return f'<path d="M{x:.2f} {y - 4.5:.2f}l4.2 7.5h-8.4z" fill="{color}"/>'


def patch(x, y, color):
    return rectangle(x - 15, y - 6, 20, 12, color)


def stroke(x, y, color):
    return line([(x - 15, y), (x + 15, y)], color, 2)


def power_of_ten(exponent):
    return "10" + str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def around(values, share):
    """The range of these values, widened on both sides."""
    low, high = min(values), max(values)
    return low - share * (high - low), high + share * (high - low)


class Panel:
    """Two axes; on a logarithmic one values are decimal logarithms."""

    def __init__(self, index, x, y, names, is_log=False, ticks=(True, True)):
        self.left, self.x, self.y, self.names, self.is_log, self.ticks = LEFT + NEXT * index, x, y, names, is_log, ticks

    def place(self, x, y):
        across, up = ((value - low) / (high - low) for value, (low, high) in ((x, self.x), (y, self.y)))
        return self.left + WIDTH * across, TOP + HEIGHT * (1 - up)

    def marks(self, low, high):
        """Values of the ticks and their names: whole decades, or five or so round numbers."""
        if self.is_log:
            return [(k, power_of_ten(k)) for k in range(math.ceil(low), math.floor(high) + 1)]
        size = 10.0 ** math.floor(math.log10((high - low) / 3))
        size *= max(k for k in (1, 2, 5) if k * size <= (high - low) / 3)
        digits = max(0, -math.floor(math.log10(size)))
        return [(k * size, f"{k * size:.{digits}f}") for k in range(math.ceil(low / size), math.floor(high / size) + 1)]

    def cells(self, rows):
        """Colours row by row, the lowest first."""
        height = HEIGHT / len(rows)
        yield '<g shape-rendering="crispEdges">'
        for row, colors in enumerate(rows):
            width = WIDTH / len(colors)
            for column, color in enumerate(colors):
                yield rectangle(self.left + width * column, TOP + HEIGHT - height * (row + 1), width, height, color)
        yield "</g>"

    def draw(self, *content, grid=True):
        """Content in a frame, with ticks and names."""
        bottom, ground, frame = TOP + HEIGHT, [], []
        for value, name in self.marks(*self.x) if self.ticks[0] else []:
            x, _ = self.place(value, self.y[0])
            ground.append(line([(x, TOP), (x, bottom)], GRID))
            frame += [line([(x, bottom), (x, bottom + 5)]), text(x, bottom + 21, name, anchor="middle")]
        for value, name in self.marks(*self.y) if self.ticks[1] else []:
            _, y = self.place(self.x[0], value)
            ground.append(line([(self.left, y), (self.left + WIDTH, y)], GRID))
            frame += [line([(self.left - 5, y), (self.left, y)]), text(self.left - 9, y + 5, name, anchor="end")]
        across, up = self.names
        frame.append(f'<rect x="{self.left}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="{INK}"/>')
        frame.append(text(self.left + WIDTH / 2, bottom + 43, across, 15, "middle"))
        frame.append(upwards(self.left - 60, TOP + HEIGHT / 2, up, 15))
        return "\n".join([*(ground if grid else []), *content, *frame])


def upwards(x, y, words, size=14):
    return text(x, y, words, size, "middle", transform=f"rotate(-90 {x:.2f} {y:.2f})")


def legend(places, entries):
    """Signs, each of some shapes in a colour, and their names."""
    for (x, y), (shapes, color, name) in zip(places, entries):
        yield "\n".join([*(shape(x + 15, y - 5, color) for shape in shapes), text(x + 39, y, name)])


def below(apart):
    return [(LEFT + apart * k, TOP + HEIGHT + 84) for k in range(3)]


def page(title, subtitle, *content):
    width, height = LEFT + NEXT + WIDTH + 40, TOP + HEIGHT + 110
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        'font-family="DejaVu Sans, Helvetica, Arial, sans-serif">',
        rectangle(0, 0, width, height, "#ffffff"), text(LEFT, 36, title, 20, font_weight="bold"),
        text(LEFT, 58, subtitle, 13, fill=GREY), *content, "</svg>", ""])


def strips(rows, chances, low, high):
    """What becomes of z = 1 when strips fail, over frequency."""
    colors = {"no stroke missed": SKY, "strokes missed, z = 1 again": ORANGE, "z = 1 lost": RED}
    fates, frequencies = list(colors), sorted({it["frequency (rad/s)"] for it in rows})
    missing, probabilities = (list(dict.fromkeys(it[name] for it in of)) for name, of in
                              (("missing strips", rows), ("probability of a strip", chances)))
    content = []
    for index, drive in enumerate(dict.fromkeys(it["drive"] for it in rows)):
        def at(of, name, value, frequency):
            return [it for it in of if (it["drive"], it["frequency (rad/s)"], it[name]) == (drive, frequency, value)]

        cells = [[colors[max((it["fate"] for it in at(rows, "missing strips", count, f)), key=fates.index)]
                  for f in frequencies] for count in missing]
        cells += [[ORANGE if any(it["strokes missed"] for it in at(chances, "probability of a strip", share, f)) else SKY
                   for f in frequencies] for share in probabilities]
        panel = Panel(index, (low, high), (0, 1), ("drive frequency η = ω/Ω, up to the fold", ""), ticks=(True, False))
        row, border = HEIGHT / len(cells), TOP + HEIGHT * len(probabilities) / len(cells)
        names = [*map(str, missing), *(f"{100 * share:.0f} %" for share in probabilities)]
        content += [
            panel.draw(*panel.cells(cells), line([(panel.left, border), (panel.left + WIDTH, border)], INK, 1.6), grid=False),
            *(text(panel.left - 8, TOP + HEIGHT - row * (k + 0.5) + 5, name, anchor="end") for k, name in enumerate(names)),
            upwards(panel.left - 58, (border + TOP + HEIGHT) / 2, "failing in a row"),
            upwards(panel.left - 58, (border + TOP) / 2, "by chance"),
            text(panel.left, TOP - 12, drive, 16, font_weight="bold")]
    return page("Strips that fail, on an ideal drive and on a motor, ρ = 10",
                "rows: strips that fail in a row, the worst of all drive angles; above, those that come by chance",
                *content, *legend(below(280), [([patch], color, fate) for fate, color in colors.items()]))


def run_up(rows, levels, torques, rises):
    """What runs from rest end in, over torque and time, and speed over voltage."""
    colors = {"lands in z = 1": SKY, "no impacts": LIGHT, "another motion": ORANGE}
    ways = {"up": BLUE, "down": RED}
    times = len({it["rise (s)"] for it in rows})
    count = len(rows) // times

    def decades(range_, cells):
        """The range of cells whose middles lie evenly on the logarithmic one."""
        low, high = map(math.log10, range_)
        half = (high - low) / (cells - 1) / 2
        return low - half, high + half

    first = Panel(0, decades(torques, count), decades(rises, times),
                  ("torque at rest / mean torque of z = 1", "time of the rise (s)"), is_log=True)
    cells = [[colors[rows[k * times + row]["end"]] for k in range(count)] for row in range(times)]
    second = Panel(1, around([it["voltage"] for it in levels], 0.04), around([it["speed (rad/s)"] for it in levels], 0.06),
                   ("voltage / rated voltage", "mean speed (rad/s)"))
    shapes = []
    for way, color in ways.items():
        own = [(second.place(it["voltage"], it["speed (rad/s)"]), it["impacts per turn"]) for it in levels if it["way"] == way]
        shapes.append(line([place for place, _ in own], color, 1.8))
        shapes += [circle(*place, color, 3.5) for place, impacts in own if impacts]
    signs = [*(([stroke], color, way) for way, color in ways.items()), ([circle], INK, "with impacts")]
    return page("Running up to z = 1, ρ = 10, η = 1.15",
                "left: the voltage of the motor rises evenly from 0; right: voltage up and down in steps, torque at rest "
                "three times what z = 1 takes",
                first.draw(*first.cells(cells), grid=False), second.draw(*shapes),
                *legend([(second.left + 24, TOP + 24 + 22 * k) for k in range(3)], signs),
                *legend(below(170), [([patch], color, end) for end, color in colors.items()]))


def order(rows, orders, finest):
    """Errors over the step of the master."""
    looks = {it["coupling"]: look for it, look in zip(orders, [(circle, BLUE), (square, ORANGE), (triangle, GREEN)])}
    panels = []
    for index, name in enumerate(["error of the speed (rad/s)", "error of the last impact (s)"]):
        points = [(it["coupling"], math.log10(it["step (s)"]), math.log10(max(it[name], 1e-15))) for it in rows]
        panel = Panel(index, around([x for _, x, _ in points], 0.06), around([y for _, _, y in points], 0.06),
                      ("step of the master (s)", name), is_log=True)
        shapes = []
        for coupling, (mark, color) in looks.items():
            own = [panel.place(x, y) for which, x, y in points if which == coupling]
            shapes += [line(own, color, 2), *(mark(*place, color) for place in own)]
        panels.append(panel.draw(*shapes))
    signs = [([stroke, looks[it["coupling"]][0]], looks[it["coupling"]][1], f'{it["coupling"]}: order {it["order"]:.1f}')
             for it in orders]
    return page("What the coupling costs",
                f"the machine B on its motor after 12 s, beside roll back with steps of {finest:.1g} s",
                *panels, *legend(below(320), signs))
