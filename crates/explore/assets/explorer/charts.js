// Charts: axes by uPlot, their contents drawn here.
const css = color => {
  const name = /^var\((.*)\)$/.exec(color)?.[1];
  return name ? getComputedStyle(document.documentElement).getPropertyValue(name).trim() : color;
};
const roomy = ([low, high], room = .05) => {
  const more = high > low ? room * (high - low) : Math.abs(low) || 1;
  return [low - more, high + more];
};
const extent = values => {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
};
/** Six digits at most. */
const told = value => String(+value.toPrecision(6)).replace('-', '−');

/** A chart in a figure; `click` is told where it is clicked. */
class Chart {
  constructor(id, click) {
    this.holder = byId(id).querySelector('.plot');
    this.shown = { x: [0, 1], y: [0, 1], labels: ['', ''], draw: () => {} };
    const axis = k => ({
      stroke: () => css('var(--aside)'), grid: { stroke: () => css('var(--grid)'), width: 1 }, ticks: { show: false },
      font: '13px sans-serif', labelFont: '13px sans-serif', labelGap: 0, labelSize: 22, size: k ? 52 : 30, gap: 4,
      label: () => this.shown.labels[k], space: k ? 34 : 62,
      values: (_, all) => all.map(value => String(+value.toPrecision(8)).replace('-', '−')),
    });
    this.plot = new uPlot({
      ...this.size(), legend: { show: false }, padding: [8, 10, 0, 0],
      cursor: { points: { show: false }, drag: { x: false, y: false } },
      scales: { x: { time: false, range: () => this.shown.x }, y: { range: () => this.shown.y } },
      axes: [axis(0), axis(1)],
      series: [{}, { paths: () => null, points: { show: false } }],
      hooks: { draw: [() => this.paint()] },
    }, [[0, 1], [0, 1]], this.holder);
    if (click) {
      this.plot.over.classList.add('clickable');
      this.plot.over.addEventListener('click', event => {
        const { left, top } = this.plot.over.getBoundingClientRect();
        const at = [event.clientX - left, event.clientY - top];
        click(this.plot.posToVal(at[0], 'x'), this.plot.posToVal(at[1], 'y'));
      });
    }
    new ResizeObserver(() => this.plot.setSize(this.size())).observe(this.holder);
  }
  size() {
    return { width: Math.max(this.holder.clientWidth, 200), height: Math.max(this.holder.clientHeight, 120) };
  }
  /** Shows ranges, labels and what `draw` draws, with the context, places of values in pixels, and their number per CSS pixel. */
  show(it) {
    Object.assign(this.shown, it);
    this.plot.setData([this.shown.x, this.shown.y]);
  }
  redraw() {
    this.plot.redraw();
  }
  paint() {
    const { ctx, bbox } = this.plot;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    // Straight lines: uPlot's own functions take as long as all the rest.
    const place = (from, length, [low, high], turned) => value => from + length * (turned ? high - value : value - low) / (high - low);
    const x = place(bbox.left, bbox.width, this.shown.x, false), y = place(bbox.top, bbox.height, this.shown.y, true);
    this.shown.draw(ctx, x, y, devicePixelRatio);
    ctx.restore();
  }
  /** A line across at a value, which moves without the rest being drawn again. */
  mark(value) {
    if (!this.line) {
      this.line = document.createElement('div');
      this.line.className = 'mark';
      this.plot.over.append(this.line);
    }
    const [low, high] = this.shown.x;
    this.line.hidden = !(low <= value && value <= high);
    this.line.style.left = `${100 * (value - low) / (high - low)}%`;
  }
}

/** A line through points; `dash` is the length of its dashes. */
function stroke(ctx, points, color, width, dash = 0) {
  ctx.beginPath();
  points.forEach(([x, y], k) => k ? ctx.lineTo(x, y) : ctx.moveTo(x, y));
  ctx.strokeStyle = css(color);
  ctx.lineWidth = width;
  ctx.lineJoin = 'round';
  ctx.setLineDash(dash ? [dash, dash] : []);
  ctx.stroke();
  ctx.setLineDash([]);
}
function dot(ctx, x, y, radius, color, isRinged = true) {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
  ctx.fillStyle = css(color);
  ctx.fill();
  if (!isRinged) return;
  ctx.strokeStyle = css('var(--card)');
  ctx.lineWidth = radius / 3;
  ctx.stroke();
}
function words(ctx, text, x, y, color, scale, align = 'left') {
  ctx.font = `${13 * scale}px sans-serif`;
  ctx.textAlign = align;
  ctx.lineWidth = 3 * scale;
  ctx.strokeStyle = css('var(--card)');
  ctx.strokeText(text, x, y);
  ctx.fillStyle = css(color);
  ctx.fillText(text, x, y);
}
