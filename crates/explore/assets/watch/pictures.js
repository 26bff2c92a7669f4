// The pictures: functions of the time t alone.

// Shapes.
const n = value => Math.round(100 * value) / 100;
const path = (name, d) => `<path class="${name}" d="${d}"/>`;
const box = (name, x, y, w, h, more = '') => `<rect class="${name}" x="${n(x)}" y="${n(y)}" width="${n(Math.max(w, 0))}" height="${n(Math.max(h, 0))}" ${more}/>`;
const dot = (name, x, y, r) => `<circle class="${name}" cx="${n(x)}" cy="${n(y)}" r="${r}"/>`;
const text = (name, x, y, words) => `<text class="${name}" x="${n(x)}" y="${n(y)}">${words}</text>`;
const polyline = (name, points) => points.length ? path(name, 'M' + points.map(([x, y]) => n(x) + ' ' + n(y)).join('L')) : '';
function spring(name, from, to, y, coils, tall) {
  const ends = Math.min(10, 0.1 * (to - from)), step = (to - from - 2 * ends) / (2 * coils);
  const inner = Array.from({ length: 2 * coils }, (_, k) => [from + ends + (k + .5) * step, y + (k % 2 ? tall : -tall)]);
  return polyline(name, [[from, y], [from + ends, y], ...inner, [to - ends, y], [to, y]]);
}
/** A damper whose cylinder is held at `held`, its rod at `moved`. */
function damper(name, held, moved, y) {
  const way = Math.sign(moved - held), cylinder = held + way * Math.min(70, .45 * Math.abs(moved - held)), piston = cylinder - way * 8;
  const open = cylinder + way * 14;
  return path(name, `M${n(held)} ${y}H${n(piston - way * 8)}M${n(open)} ${y - 9}H${n(piston - way * 8)}V${y + 9}H${n(open)}M${n(piston)} ${y - 6}V${y + 6}M${n(piston)} ${y}H${n(moved)}`);
}
function show(figure, width, height, body) {
  const svg = figure.querySelector('svg');
  svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
  svg.innerHTML = body;
}
const wide = figure => Math.max(Math.round(figure.clientWidth - 20), 240);

// The machine, to scale; `to` maps positions to pixels.
const MIDDLE = 92, FLOOR = 156, HEIGHT = 196;
function ruler(to, ends, width) {
  const marks = ticks(ends, width / 90).map(x => path('axis', `M${n(to(x))} ${FLOOR + 12}v6`) + text('aside mid', to(x), HEIGHT - 8, short(x)));
  return box('ground', 0, FLOOR, width, 12) + marks.join('') + (width < 560 ? '' : text('aside end', width - 4, HEIGHT - 8, labels.position));
}
function stripShape(to, t) {
  if (!places.strip) return '';
  const [near, far] = places.strip.map(to), top = MIDDLE - 54, thick = Math.max(far - near, 2);
  const shapes = {
    whole: () => box('strip', near, top, thick, FLOOR - top),
    missing: () => box('missing', near, top, thick, FLOOR - top),
    pierced: () => box('strip', near, top, thick, 33) + box('strip', near, MIDDLE + 21, thick, FLOOR - MIDDLE - 21),
  };
  return shapes[strip(t)]();
}
function stopShape(to, x, right) {
  let shape = '';
  if (places.stop != null) {
    const home = to(places.stop), face = to(Math.max(x, places.stop));
    if (places.model === 'hertz') {
      // A dome, flat where it is pressed.
      const deep = Math.min(right - home, Math.max(60, 1.6 * (to(positions[1]) - home))), center = home + deep, flat = Math.min(face, center);
      const half = n(42 * Math.sqrt(Math.max(1 - ((center - flat) / deep) ** 2, 0))), arc = `A${n(deep)} 42 0 0 0 `;
      shape += path('plate', `M${n(right)} ${MIDDLE - 42}H${n(center)}${arc}${n(flat)} ${MIDDLE - half}V${MIDDLE + half}${arc}${n(center)} ${MIDDLE + 42}H${n(right)}Z`);
    } else {
      shape += spring('stop', face + 9, right, MIDDLE - 18, 9, 10) + (places.is_damped_in_contact ? damper('stop', right, face + 9, MIDDLE + 20) : '');
      if (places.model === 'preloaded') {
        const rim = y => `M${n(right)} ${MIDDLE + y * 52}H${n(home - 4)}V${MIDDLE + y * 33}`;
        shape += path('stop', rim(-1) + rim(1));
      }
      shape += box('plate', face, MIDDLE - 42, 9, 84, 'rx="2"');
    }
  }
  if (places.wall != null) {
    const back = to(places.wall) + (places.stop != null ? 9 : 0);
    shape += places.stop != null
      ? box('solid', back, MIDDLE - 64, 16, 26) + box('solid', back, MIDDLE + 38, 16, 26)
      : box('solid', back, MIDDLE - 60, 22, FLOOR - MIDDLE + 60);
  }
  return shape;
}
/** The stop on the other side, which the mass meets with its back, `long` pixels behind its tip. */
function belowShape(to, x, long) {
  if (!places.below) return '';
  const yields = places.below.model !== 'rigid', face = to(yields ? Math.min(x, places.below.face) : places.below.face) - long;
  return [-64, 38].map(up => box(yields ? 'plate' : 'solid', face - 14, MIDDLE + up, 14, 26)).join('');
}
function flash(to, t, hit, long = 0) {
  const fresh = hit && t - hit.time < .03 * drive.period && !calm.matches;
  if (!fresh) return '';
  const size = 8 + 22 * Math.abs(hit.velocity_before) / loudest;
  const at = to(hit.position) - (places.below && hit.position <= places.below.face ? long : 0);
  return path('flash', [-1, 1].map(way => `M${n(at)} ${MIDDLE + way * 46}l${n(-size / 2)} ${n(way * size)}m${n(size)} 0l${n(-size / 2)} ${n(-way * size)}`).join(''));
}
const reach = (() => {
  const far = lines.length ? [Math.min(...lines), Math.max(...lines)] : [];
  const [low, high] = range([...positions, ...far]);
  return high > low ? [low, high] : [low - 1, high + 1];
})();
let machineScale = 1;
function drawMachine(t, now, hit) {
  const figure = byId('machine'), width = wide(figure), small = width < 560;
  const [long, wall] = small ? [52, 8] : [112, 14], tall = 84;
  const right = width - wall, left = wall + (small ? 40 : 96) + long + 9;
  const room = places.stop != null ? (small ? 62 : 170) : places.wall != null ? 24 : 12;
  machineScale = (right - room - left) / (reach[1] - reach[0]);
  const to = x => left + (x - reach[0]) * machineScale;
  const tip = to(now.x), back = tip - 9 - long, center = back + long / 2, turn = angle(t);
  let body = ruler(to, [reach[0], reach[1]], width) + box('ground', 0, 20, wall, FLOOR - 20);
  if (places.stop != null) body += box('ground', right, 20, wall, FLOOR - 20);
  body += spring('line', wall, back, MIDDLE - 20, 9, 11) + (places.is_damped ? damper('line', wall, back, MIDDLE + 22) : '');
  body += stripShape(to, t) + stopShape(to, now.x, right) + belowShape(to, now.x, long + 9);
  body += box('mass', back, MIDDLE - tall / 2, long, tall, 'rx="5"') + path('tip', `M${n(tip - 9)} ${MIDDLE - 18}L${n(tip)} ${MIDDLE - 12}V${MIDDLE + 12}L${n(tip - 9)} ${MIDDLE + 18}Z`);
  body += [.22, .78].map(at => `<circle class="mass" cx="${n(back + at * long)}" cy="${FLOOR - 11}" r="10"/>`).join('');
  if (drive.amplitude > 0) {
    const radius = small ? 19 : 28, [x, y] = [center + radius * Math.cos(turn), MIDDLE - radius * Math.sin(turn)];
    const arrow = .5 * (long + 20) * Math.cos(turn), head = 7 * Math.sign(arrow);
    body += dot('rotor', center, MIDDLE, radius) + path('drive', `M${n(center)} ${MIDDLE}L${n(x)} ${n(y)}`) + dot('knob', x, y, 5);
    body += path('drive', `M${n(center)} 26h${n(arrow)}` + (Math.abs(arrow) > 8 ? `m${-head} -5l${head} 5l${-head} 5` : ''));
  }
  show(figure, width, HEIGHT, body + flash(to, t, hit, long + 9));
}
// The deepest contact, unless it is rounding, and what lies before it, many times larger.
const near = Math.min(...faces), depth = Math.max(positions[1], ...faces) - near, whole = reach[1] - reach[0];
const isClose = faces.length > 0 && positions[1] > near && depth > 1e-6 * whole && depth < .12 * whole;
function drawCloseup(t, now, hit) {
  const figure = byId('closeup'), width = wide(figure), right = width - 12;
  const ends = [near - .5 * depth, near + 1.08 * depth], room = places.stop != null ? .3 * width : 30;
  const scale = (right - room) / (ends[1] - ends[0]), to = x => (x - ends[0]) * scale;
  const tip = to(now.x), larger = Math.round(scale / machineScale);
  figure.querySelector('figcaption').textContent = `At the stop, ${larger} times larger`;
  let body = ruler(to, [ends[0], ends[1]], width) + stripShape(to, t) + stopShape(to, now.x, right);
  if (places.stop != null) body += box('ground', right, 20, 12, FLOOR - 20) + text('aside', to(places.stop) + 18, 16, 'stop');
  if (places.strip) body += text('aside mid', (to(places.strip[0]) + to(places.strip[1])) / 2 + 14, 16, 'strip');
  if (tip > 0) body += path('tip', `M-9 ${MIDDLE - 26}H${n(tip - 14)}L${n(tip)} ${MIDDLE - 18}V${MIDDLE + 18}L${n(tip - 14)} ${MIDDLE + 26}H-9Z`);
  show(figure, width, HEIGHT, body + flash(to, t, hit));
}

// Curves. What a click on one seeks: the time at a place.
const seeks = {};
function panel(width, height, across, up, [along, label], wanted) {
  const area = { left: 58, right: width - 8, top: 24, bottom: height - 24 };
  const x = it => area.left + (it - across[0]) / (across[1] - across[0]) * (area.right - area.left);
  const y = it => area.bottom - (it - up[0]) / (up[1] - up[0]) * (area.bottom - area.top);
  let ground = '', axes = text('', 4, 14, label) + text('aside end halo', area.right - 2, area.bottom - 6, along);
  for (const it of ticks(across, (area.right - area.left) / 80)) {
    ground += path('grid', `M${n(x(it))} ${area.top}V${area.bottom}`);
    axes += text('aside mid', x(it), height - 8, short(it));
  }
  for (const it of ticks(up, wanted)) {
    ground += path('grid', `M${area.left} ${n(y(it))}H${area.right}`);
    axes += text('aside end', area.left - 6, y(it) + 4, short(it));
  }
  return { area, x, y, ground, axes: axes + path('axis', `M${area.left} ${area.top}V${area.bottom}H${area.right}`) };
}
function windowAt(t) {
  const long = Math.min(+byId('window').value * drive.period, end - begin);
  const from = calm.matches ? begin + long * Math.floor((t - begin) / long) : t - .6 * long;
  return [from, from + long].map(it => it + between(begin - from, 0, Math.max(end - from - long, begin - from)));
}
function points(from, to, values, map) {
  const [i, j] = [Math.max(count(samples.time, from) - 1, 0), Math.min(count(samples.time, to) + 1, samples.time.length)];
  return Array.from({ length: j - i }, (_, k) => map(samples.time[i + k], values[i + k], i + k));
}
function drawSeries(id, t, value, values, ends, label, lines) {
  const figure = byId(id), width = wide(figure), height = isClose && innerWidth > 760 ? 264 : 182, [from, to] = windowAt(t);
  const { area, x, y, ground, axes } = panel(width, height, [from, to], ends, [labels.time, label], 4);
  seeks[id] = x => from + (to - from) * (x - area.left) / (area.right - area.left);
  const high = area.bottom - area.top;
  let tints = '', marks = '';
  for (let k = Math.max(count(phaseTimes, from) - 1, 0); k < phases.length && phases[k].from < to; k++) {
    const it = phases[k];
    if (it.color) tints += box('', x(it.from), area.top, Math.max(x(it.to) - x(it.from), .4), high, `fill="${it.color}"`);
  }
  for (let k = count(hitTimes, from); k < hitTimes.length && hitTimes[k] <= to; k++) {
    marks += path(motion.hits[k].impact ? 'hit' : 'rebound', `M${n(x(hitTimes[k]))} ${area.top}l-4 -7h8Z`);
  }
  const faces = lines.filter(it => ends[0] < it && it < ends[1]).map(it => path('face', `M${area.left} ${n(y(it))}H${area.right}`)).join('');
  const curve = polyline('curve', points(from, to, values, (time, value) => [x(time), y(value)]));
  const inside = `<clipPath id="in-${id}"><rect x="${area.left}" y="0" width="${area.right - area.left}" height="${height}"/></clipPath>`;
  const cursor = path('cursor', `M${n(x(t))} ${area.top}V${area.bottom}`) + dot('point', x(t), y(value), 4.5);
  show(figure, width, height, `${inside}<g clip-path="url(#in-${id})"><g class="tints">${tints}</g>${ground}${faces}${curve}${marks}</g>${axes}${cursor}`);
}
// The whole run does not move: it is drawn once for each size.
let still = {};
function drawPortrait(t, now) {
  const figure = byId('portrait'), width = wide(figure), height = 300;
  const it = panel(width, height, roomy(positions, .05), roomy(velocities, .05), [labels.position, labels.velocity], 6), { x, y } = it;
  const map = (_, position, k) => [x(position), y(samples.velocity[k])];
  seeks.portrait = (at, height) => {
    const far = k => Math.hypot(x(samples.position[k]) - at, y(samples.velocity[k]) - height);
    return samples.time[samples.time.reduce((best, _, k) => far(k) < far(best) ? k : best, 0)];
  };
  if (still.width !== width) {
    const drawn = lines.map(face => path('face', `M${n(x(face))} ${it.area.top}V${it.area.bottom}`)).join('');
    const marks = impacts.map(hit => dot('hit', x(hit.position), y(hit.velocity_before), 2)).join('');
    still = { width, ground: it.ground + drawn + polyline('run', points(begin, end, samples.position, map)) + marks, axes: it.axes };
    show(figure, width, height, `<g>${still.ground}</g><g></g>${still.axes}<g></g>`);
  }
  const [, trail, point] = figure.querySelectorAll('g');
  trail.innerHTML = polyline('curve', [...points(Math.max(t - drive.period, begin), t, samples.position, map).slice(0, -1), [x(now.x), y(now.v)]]);
  point.innerHTML = dot('point', x(now.x), y(now.v), 5.5);
}
function drawTrack() {
  const svg = byId('track'), width = Math.max(svg.clientWidth, 100), x = t => 8 + (t - begin) / (end - begin) * (width - 16);
  svg.setAttribute('viewBox', `0 0 ${width} 14`);
  svg.innerHTML = path('flash', '') + impacts.map(hit => {
    const tall = 3 + 10 * Math.abs(hit.velocity_before) / loudest;
    return box('hit', x(hit.time) - .75, 14 - tall, 1.5, tall);
  }).join('');
}
