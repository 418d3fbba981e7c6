"""Line plots and tables of paper_figures: SVG and HTML text, by itself."""
import html
import math

width, height, left, right, top, bottom = 600, 360, 64, 190, 28, 44
colours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999"]


def ticks(low, high, is_log):
    """Round numbers from low to high."""
    if is_log:
        decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
        step = max(1, len(decades) // 7)
        return [10.0 ** d for d in decades[::step] if low <= 10.0 ** d <= high * 1.0001]
    rough = (high - low) / 6
    unit = 10.0 ** math.floor(math.log10(rough))
    step = min((m * unit for m in (1, 2, 5, 10)), key=lambda s: abs(s - rough))
    first = math.ceil(low / step)
    return [step * i for i in range(first, math.floor(high / step + 1e-9) + 1)]


def cut(line, x0, x1, y0, y1):
    """The parts of a line within a rectangle, as lines."""
    parts = [[]]
    for (ax, ay), (bx, by) in zip(line, line[1:]):
        low, high = 0.0, 1.0
        for a, d, near, far in ((ax, bx - ax, x0, x1), (ay, by - ay, y0, y1)):
            if d == 0.0:
                if not near <= a <= far:
                    high = -1.0
                continue
            enter, leave = sorted(((near - a) / d, (far - a) / d))
            low, high = max(low, enter), min(high, leave)
        if low > high:
            parts.append([])
            continue
        start, end = ((ax + t * (bx - ax), ay + t * (by - ay)) for t in (low, high))
        if not parts[-1] or parts[-1][-1] != start:
            parts.append([start])
        parts[-1].append(end)
    return [part for part in parts if len(part) > 1]


def line_plot(title, x_name, y_name, series, x_range=None, y_range=None, log_y=False, points=False):
    """series: {name: [(x, y), ...]}; what lies outside the ranges is cut off."""
    xs = [x for line in series.values() for x, _ in line]
    ys = [y for line in series.values() for _, y in line if not log_y or y > 0.0]
    x0, x1 = x_range or (min(xs), max(xs))
    y0, y1 = y_range or (min(ys), max(ys))
    if y0 == y1:
        y0, y1 = y0 - 1.0, y1 + 1.0
    scale = (lambda y: math.log10(max(y, 1e-3 * y0))) if log_y else (lambda y: y)

    def place(x, y):
        across = (x - x0) / (x1 - x0) * (width - left - right)
        up = (scale(y) - scale(y0)) / (scale(y1) - scale(y0)) * (height - top - bottom)
        return left + across, height - bottom - up

    inner = f'x="{left}" y="{top}" width="{width - left - right}" height="{height - top - bottom}"'
    text = [f'<svg viewBox="0 0 {width} {height}" width="{width}" xmlns="http://www.w3.org/2000/svg" '
            'font-family="sans-serif" font-size="12">',
            f'<text x="{left}" y="18" font-weight="bold">{html.escape(title)}</text>']
    for x in ticks(x0, x1, False):
        px, _ = place(x, y1)
        text.append(f'<path d="M{px:.1f} {top}V{height - bottom}" stroke="#ddd"/>'
                    f'<text x="{px:.1f}" y="{height - bottom + 16}" text-anchor="middle">{x:.4g}</text>')
    for y in ticks(y0, y1, log_y):
        _, py = place(x0, y)
        text.append(f'<path d="M{left} {py:.1f}H{width - right}" stroke="#ddd"/>'
                    f'<text x="{left - 6}" y="{py + 4:.1f}" text-anchor="end">{y:.4g}</text>')
    for i, (name, line) in enumerate(series.items()):
        colour = colours[i % len(colours)]
        for part in cut([place(x, y) for x, y in line], left, width - right, top, height - bottom):
            path = " ".join("%.1f,%.1f" % point for point in part)
            text.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="1.6"/>')
        if points:
            text += ['<circle cx="%.1f" cy="%.1f" r="2.6" fill="%s"/>' % (*place(x, y), colour) for x, y in line]
        row = top + 10 + 17 * i
        text.append(f'<path d="M{width - right + 10} {row - 4}h18" stroke="{colour}" stroke-width="3"/>'
                    f'<text x="{width - right + 33}" y="{row}">{html.escape(name)}</text>')
    text.append(f'<rect {inner} fill="none" stroke="#555"/>'
                f'<text x="{(left + width - right) / 2}" y="{height - 8}" text-anchor="middle">'
                f'{html.escape(x_name)}</text>'
                f'<text transform="translate(14 {(top + height - bottom) / 2}) rotate(-90)" '
                f'text-anchor="middle">{html.escape(y_name)}</text></svg>')
    return "\n".join(text)


def table(header, rows):
    """An HTML table; cells are text or numbers."""
    def cells(row, tag):
        return "<tr>" + "".join(f"<{tag}>{html.escape(str(cell))}</{tag}>" for cell in row) + "</tr>"
    return "<table>" + cells(header, "th") + "".join(cells(row, "td") for row in rows) + "</table>"
