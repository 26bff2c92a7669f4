"""Pictures of the studies of piercing-machine.ssp, two panels below each other, as SVG."""

import html
import math

ONE, ZERO, HALF = "#0072B2", "#E4E4E4", "#E69F00"
"""Kinds of motion, as in crates/draw/src/style.rs: z = 1, no impacts, another one."""
RISING, FALLING, SERIES = "#0072B2", "#D55E00", ["#0072B2", "#E69F00", "#009E73"]
INK, GREY, GRID = "#222222", "#777777", "#e9e9e9"
DARK = "@media screen and (prefers-color-scheme: dark) { svg { filter: invert(.88) hue-rotate(180deg) } }"

WIDTH, HEIGHT, LEFT, TOP, NEXT = 480, 300, 84, 92, 376
"""Size of a panel, left and top of the first one, distance of the second one below it."""


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

    def __init__(self, index, x, y, names, is_log=False):
        self.top, self.x, self.y, self.names, self.is_log = TOP + NEXT * index, x, y, names, is_log

    def place(self, x, y):
        across, up = ((value - low) / (high - low) for value, (low, high) in ((x, self.x), (y, self.y)))
        return LEFT + WIDTH * across, self.top + HEIGHT * (1 - up)

    def marks(self, low, high):
        """Values of the ticks and their names: whole decades, or five or so round numbers."""
        if self.is_log:
            return [(k, power_of_ten(k)) for k in range(math.ceil(low), math.floor(high) + 1)]
        size = 10.0 ** math.floor(math.log10((high - low) / 3))
        size *= max(k for k in (1, 2, 5) if k * size <= (high - low) / 3)
        digits = max(0, -math.floor(math.log10(size)))
        return [(k * size, f"{k * size:.{digits}f}") for k in range(math.ceil(low / size), math.floor(high / size) + 1)]

    def draw(self, *content):
        """Content in a frame, with ticks and names."""
        top, bottom, ground, frame = self.top, self.top + HEIGHT, [], []
        for value, name in self.marks(*self.x):
            x, _ = self.place(value, self.y[0])
            ground.append(line([(x, top), (x, bottom)], GRID))
            frame += [line([(x, bottom), (x, bottom + 5)]), text(x, bottom + 21, name, anchor="middle")]
        for value, name in self.marks(*self.y):
            _, y = self.place(self.x[0], value)
            ground.append(line([(LEFT, y), (LEFT + WIDTH, y)], GRID))
            frame += [line([(LEFT - 5, y), (LEFT, y)]), text(LEFT - 9, y + 5, name, anchor="end")]
        across, up = self.names
        frame.append(f'<rect x="{LEFT}" y="{top}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="{INK}"/>')
        frame.append(text(LEFT + WIDTH / 2, bottom + 43, across, anchor="middle"))
        frame.append(upwards(LEFT - 60, top + HEIGHT / 2, up))
        return "\n".join([*ground, *content, *frame])


def upwards(x, y, words, size=14):
    return text(x, y, words, size, "middle", transform=f"rotate(-90 {x:.2f} {y:.2f})")


def legend(places, entries):
    """Signs, each of some shapes in a colour, and their names."""
    for (x, y), (shapes, color, name) in zip(places, entries):
        yield "\n".join([*(shape(x + 15, y - 5, color) for shape in shapes), text(x + 39, y, name)])


def inside(index, right, down):
    """Places of a legend inside of a panel."""
    return [(LEFT + right, TOP + NEXT * index + down + 22 * k) for k in range(3)]


def page(title, *content):
    width, height = LEFT + WIDTH + 24, TOP + NEXT + HEIGHT + 62
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        'font-family="DejaVu Sans, Helvetica, Arial, sans-serif">', f"<style>{DARK}</style>",
        rectangle(0, 0, width, height, "#ffffff"), text(24, 38, title, 18, font_weight="bold"), *content, "</svg>", ""])


def run_up(rows, levels):
    """What runs from rest end in, over torque and time, and speed over voltage."""
    colors = {"lands in z = 1": ONE, "no impacts": ZERO, "another motion": HALF}
    ways = {"up": RISING, "down": FALLING}
    runs = [(*(math.log10(it[name]) for name in ("torque / mean torque", "rise (s)")), it["end"]) for it in rows]
    first = Panel(0, *(around([run[axis] for run in runs], 0.04) for axis in range(2)),
                  ("torque at rest / mean torque of z = 1", "time in which the voltage rises (s)"), is_log=True)
    second = Panel(1, around([it["voltage"] for it in levels], 0.04), around([it["speed (rad/s)"] for it in levels], 0.06),
                   ("voltage / rated voltage (torque at rest three times that of z = 1)", "mean speed (rad/s)"))
    shapes = []
    for way, color in ways.items():
        own = [(second.place(it["voltage"], it["speed (rad/s)"]), it["impacts per turn"]) for it in levels if it["way"] == way]
        shapes.append(line([place for place, _ in own], color, 1.8))
        shapes += [circle(*place, color, 3.5) for place, impacts in own if impacts]
    signs = [*(([stroke], color, way) for way, color in ways.items()), ([circle], INK, "with impacts")]
    ends = {end for *_, end in runs}
    return page("Running up to z = 1, ρ = 10, η = 1.15",
                first.draw(*(circle(*first.place(x, y), colors[end]) for x, y, end in runs)), second.draw(*shapes),
                *legend([(LEFT + 170 * k, TOP - 12) for k in range(3)], [([circle], colors[end], end) for end in colors if end in ends]),
                *legend(inside(1, 20, 24), signs))


def order(rows, orders, finest):
    """Errors over the step of the master."""
    looks = {it["coupling"]: look for it, look in zip(orders, zip([circle, square, triangle], SERIES))}
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
    return page(f"Error after 12 s, against roll back in steps of {finest:.1g} s",
                *panels, *legend(inside(0, 270, 236), signs))
