// The page: a machine, what is asked about it, and what is shown.
const given = JSON.parse(byId('given').textContent);
/** The numbers that have their sliders at once. */
const FOREMOST = ['clearance', 'excitation.frequency', 'excitation.frequency_hz', 'stop.stiffness', 'stop.preload', 'stop.preload_deflection', 'damping', 'piercing.thickness'];
/** How long motions are followed: at once, and when the machine has stayed as it is. */
const QUICK = { periods: 200, longest: 200 }, PATIENT = { periods: 200, longest: 1600 };
/** Values of a diagram at most and at least, and those of a machine that is not yet known. */
const COLUMNS = [16, 1000], FIRST_COLUMNS = 24;
/** Milliseconds: of a diagram at once and of one that is worth its time, of basins that are refined no more, and of rest. */
const AT_ONCE = 120, WORTH = 2000, STAYS = 250;
/** Milliseconds for a value of a diagram from which on less is asked. */
const SLOW = 1;
const state = {
  machine: '', about: null, along: '', range: [0, 1], view: 'impact', version: 0, motions: [], branches: null, motion: null, cells: null,
  // Milliseconds for a value of a diagram; 0 of a machine that is not yet known.
  each: 0,
};
let live, slow, charts;

// The machine.
const number = key => state.about.parameters.find(it => it.key === key);
const value = () => number(state.along)?.value;
const pending = new Map();
/** Sets keys of the machine to values, and shows it. The motion goes on from where it was, unless it begins elsewhere. */
function change(values) {
  state.changed = performance.now();
  const from = state.motion?.told.from;
  if (from && !pending.has('initial.position')) [['initial.position', from[0]], ['initial.velocity', from[1]]].forEach(([key, it]) => pending.set(key, String(it)));
  Object.entries(values).forEach(([key, it]) => pending.set(key, String(it)));
  let isSame = false;
  const question = () => {
    const set = [...pending];
    pending.clear();
    isSame = set.every(([key]) => key === state.along || key.startsWith('initial.'));
    return { task: 'machine', machine: state.machine, set };
  };
  live.ask('machine', question, answer => {
    if (!warn(answer)) take(answer.told, isSame);
  });
}
/** Takes another machine from a file. */
function load(machine) {
  const question = () => ({ task: 'machine', machine });
  live.ask('machine', question, answer => {
    if (warn(answer)) return;
    Object.assign(state, { changed: performance.now(), each: 0, about: answer.told, motion: null, branches: null, cells: null });
    const frequency = answer.told.parameters.find(it => it.key.startsWith('excitation.frequency'));
    state.along = frequency.key;
    build();
    across(state.along);
    take(answer.told, false);
  });
}
function warn({ told }) {
  byId('warning').hidden = !told?.error;
  byId('warning').textContent = told?.error ?? '';
  return Boolean(told?.error);
}
function take(about, isSame) {
  Object.assign(state, { about, machine: about.toml, version: state.version + 1 });
  if (state.cells) state.cells.isLast = false;
  // One thing after the other: where there is one core, the diagram comes first, and the basins once the hand rests.
  const rest = () => {
    askBranches();
    if (!live.waiting.has('machine')) askBasin(state.each > SLOW ? 16 : 32, 0);
  };
  if (isSame) rest();
  else {
    state.isPatient = false;
    askDiagram(live, QUICK, columnsIn(AT_ONCE), rest);
  }
  askMotion();
  fillIn();
  charts.diagram.mark(value());
  clearTimeout(state.timer);
  state.timer = setTimeout(settle, STAYS);
}
/** What is worth its time once the machine stays as it is. */
function settle() {
  if (!state.isPatient) askDiagram(slow, state.each > SLOW ? QUICK : PATIENT, columnsIn(WORTH / 2));
  askBranches();
  link();
  say();
}

// Questions.
const along = () => ({ along: state.along, from: state.range[0], to: state.range[1] });
/** Asks about the machine; `then` has the answer, and whether the machine is still the same. */
function ask(engine, subject, question, then) {
  let version;
  const made = () => {
    version = state.version;
    return { machine: state.machine, ...question() };
  };
  engine.ask(subject, made, answer => !answer.told?.error && then(answer, version === state.version));
}
/** How many values a diagram can have in some milliseconds: where a stop takes longer, fewer keep up with the hand. */
const columnsIn = time => state.each ? Math.round(Math.min(Math.max(time / state.each, COLUMNS[0]), COLUMNS[1])) : FIRST_COLUMNS;
function askDiagram(engine, patience, columns, then = () => {}) {
  let { range } = state;
  const question = () => {
    ({ range } = state);
    return { task: 'diagram', ...along(), columns, starts: state.about.starts, ...patience };
  };
  ask(engine, 'diagram', question, ({ numbers, took }, isNow) => {
    const isFirst = !state.each, isPatient = engine === slow;
    if (isNow ? state.isPatient : isPatient) return then();
    if (!isPatient) state.each = took / columns;
    state.isPatient = isPatient;
    state.motions = [...motions(numbers, columns, range)];
    showDiagram();
    // The chart draws itself in a task that was made just now.
    if (!isPatient) queueMicrotask(() => performance.measure('redrawn', { start: state.changed, detail: columns }));
    if (isFirst) askDiagram(live, QUICK, columnsIn(AT_ONCE), then);
    else then();
  });
}
/** The motions of a diagram: see `Diagram::answer`. */
function* motions(numbers, columns, [low, high]) {
  const starts = state.about.starts.length;
  for (let at = 0, k = 0; at < numbers.length; k++) {
    const [kind, p, n, impacts, states] = numbers.subarray(at, at + 5), first = at + 5, second = first + impacts;
    at = second + 2 * states;
    const share = Math.floor(k / starts) / Math.max(columns - 1, 1);
    yield { value: low + share * (high - low), kind, p, n, impacts: numbers.subarray(first, second), states: numbers.subarray(second, at) };
  }
}
function askMotion() {
  const question = () => ({ task: 'motion', drawn: 4, seen: 1000, ...PATIENT });
  ask(live, 'motion', question, ({ told, numbers }) => {
    const rows = (from, count, width) => Array.from({ length: count }, (_, k) => numbers.subarray(from + width * k, from + width * (k + 1)));
    const [samples, impacts, states] = told.counts;
    state.motion = {
      told, samples: rows(0, samples, 3), impacts: rows(3 * samples, impacts, 2), states: rows(3 * samples + 2 * impacts, states, 2),
    };
    showMotion();
  });
}
function askBranches() {
  const shown = () => {
    const [, , n] = state.motion?.told.kind ?? [0, 0, 0];
    return n ? [n, state.motion.told.from] : null;
  };
  ask(slow, 'branches', () => ({ task: 'branches', ...along(), shown: shown() }), ({ told, numbers }) => {
    state.branches = { told, numbers };
    showDiagram();
    fillIn();
  });
}
/** Some rows of the basins, and then the others; finer ones once they are whole. */
function askBasin(size, row) {
  const rows = [row, Math.min(row + Math.max(2, 512 / size), size)];
  const question = () => ({ task: 'basin', reach: state.about.reach, cells: [size, size], rows, periods: QUICK.periods });
  ask(slow, 'basin', question, ({ numbers, took }, isNow) => {
    if (!isNow) return;
    if (!row) state.next = { size, kinds: new Float64Array(3 * size * size), took: 0 };
    state.next.took += took;
    state.next.kinds.set(numbers, 3 * size * row);
    if (rows[1] < size) return askBasin(size, rows[1]);
    state.cells = state.next;
    showBasin();
    state.cells.isLast = size === 128 || 4 * state.next.took > WORTH;
    if (!state.cells.isLast) askBasin(2 * size, 0);
  });
}

// Pictures.
const color = kind => given.classes[kind][1];
const areImpacts = () => state.view === 'impact';
/** Where a motion of the diagram is seen in it. */
function heights({ impacts, states }) {
  if (!areImpacts()) return states.filter((_, k) => k % 2 === 0);
  return impacts.length ? impacts : [0];
}
function showDiagram() {
  const { motions } = state, isImpact = areImpacts();
  const all = motions.map(heights);
  const special = state.branches?.told.specials.map(it => isImpact ? it.velocity : it.position) ?? [];
  let [low, high] = extent([...all.map(extent).flat(), ...special]);
  if (!(low <= high)) [low, high] = [0, 1];
  const groups = new Map();
  motions.forEach(({ kind }, k) => {
    if (!groups.has(kind)) groups.set(kind, []);
    groups.get(kind).push(k);
  });
  const draw = (ctx, x, y, scale) => {
    drawZone(ctx, x, scale);
    drawBranches(ctx, x, y, scale);
    const size = 1.6 * scale;
    for (const [kind, members] of groups) {
      ctx.fillStyle = css(kind ? color(kind) : 'var(--aside)');
      for (const k of members) {
        const at = x(motions[k].value) - size / 2;
        for (const height of all[k]) ctx.fillRect(at, y(height) - size / 2, size, size);
      }
    }
    drawSpecials(ctx, x, y, scale);
  };
  charts.diagram.show({
    x: state.range, y: roomy([low, high]), draw,
    labels: [number(state.along).label, isImpact ? state.about.labels.impact : `${state.about.labels.position} at drive angle φ`],
  });
  charts.diagram.mark(value());
  legend(groups);
}
const ends = () => {
  const { g0, s_sn, s_pd } = state.branches?.told.zone ?? {};
  return [['g₀', g0], ['s_SN', s_sn], ['s_PD', s_pd]].filter(([, it]) => it != null).sort((a, b) => a[1] - b[1]);
};
function drawZone(ctx, x, scale) {
  const [top, bottom] = [0, ctx.canvas.height], { g0, s_sn } = state.branches?.told.zone ?? {};
  if (g0 != null && s_sn != null) {
    ctx.globalAlpha = .16;
    ctx.fillStyle = css('var(--allowed)');
    ctx.fillRect(x(g0), top, x(s_sn) - x(g0), bottom - top);
    ctx.globalAlpha = 1;
  }
  ends().forEach(([name, it], k) => {
    stroke(ctx, [[x(it), top], [x(it), bottom]], 'var(--aside)', scale, 4 * scale);
    words(ctx, name, x(it) + 4 * scale, (26 + 15 * (k % 2)) * scale, 'var(--ink)', scale);
  });
}
function drawBranches(ctx, x, y, scale) {
  if (!state.branches) return;
  const { told, numbers } = state.branches, height = areImpacts() ? 1 : 2;
  let at = 0;
  for (const { points } of told.branches) {
    const rows = Array.from({ length: points }, (_, k) => numbers.subarray(at + 4 * k, at + 4 * k + 4));
    at += 4 * points;
    for (let from = 0; from + 1 < points;) {
      let to = from + 1;
      while (to + 1 < points && rows[to + 1][3] === rows[from + 1][3]) to++;
      stroke(ctx, rows.slice(from, to + 1).map(it => [x(it[0]), y(it[height])]), 'var(--ink)', 1.4 * scale, rows[from + 1][3] ? 0 : 5 * scale);
      from = to;
    }
  }
}
function drawSpecials(ctx, x, y, scale) {
  for (const it of state.branches?.told.specials ?? []) {
    const place = [x(it.value), y(areImpacts() ? it.velocity : it.position)];
    dot(ctx, ...place, 4.5 * scale, given.marks[it.symbol]);
    // The ends of the zone have their names already.
    const isNamed = ends().some(([, end]) => Math.abs(end - it.value) < 1e-9 * end);
    if (!isNamed) words(ctx, it.symbol, place[0] + 7 * scale, place[1] - 6 * scale, 'var(--ink)', scale);
  }
}
function legend(groups) {
  const kinds = [...new Set([...groups.keys(), ...(state.cells ? state.cells.kinds.filter((_, k) => k % 3 === 0) : [])])].sort((a, b) => a - b);
  const patches = kinds.map(kind => `<span><i style="--of:${kind ? color(kind) : 'var(--still)'}"></i>${given.classes[kind][0]}</span>`);
  const lines = state.branches?.told.branches.length ? '<span><i class="line"></i>stable</span><span><i class="line dashed"></i>unstable</span>' : '';
  byId('legend').innerHTML = patches.join('') + lines;
}
function showMotion() {
  const { told: motion, samples, impacts, states } = state.motion, { labels, period } = state.about;
  const [times, positions, velocities] = [0, 1, 2].map(k => samples.map(it => it[k]));
  const clearance = number('clearance')?.value ?? NaN;
  const x = roomy(extent([...positions, ...states.map(it => it[0])])), v = roomy(extent([...velocities, ...states.map(it => it[1])]));
  charts.portrait.show({
    x, y: v, labels: [labels.position, labels.velocity],
    draw: (ctx, x, y, scale) => {
      stroke(ctx, [[x(clearance), 0], [x(clearance), ctx.canvas.height]], 'var(--aside)', scale, 5 * scale);
      stroke(ctx, samples.map(it => [x(it[1]), y(it[2])]), 'var(--design)', 1.5 * scale);
      const areFew = states.length <= 64;
      states.forEach(it => dot(ctx, x(it[0]), y(it[1]), (areFew ? 4 : 1.5) * scale, 'var(--mark)', areFew));
    },
  });
  charts.series.show({
    x: [0, 4 * period], y: roomy(extent([...positions, clearance].filter(Number.isFinite))), labels: [labels.time, labels.position],
    draw: (ctx, x, y, scale) => {
      stroke(ctx, [[0, y(clearance)], [ctx.canvas.width, y(clearance)]], 'var(--aside)', scale, 5 * scale);
      stroke(ctx, samples.map((it, k) => [x(times[k]), y(it[1])]), 'var(--design)', 1.6 * scale);
      for (const [time] of impacts) dot(ctx, x(time), y(clearance), 3.5 * scale, 'var(--mark)');
    },
  });
  charts.basin.redraw();
  fillIn();
  hear();
}
function showBasin() {
  const { size, kinds } = state.cells, [far, fast] = state.about.reach, { labels } = state.about;
  const picture = Object.assign(document.createElement('canvas'), { width: size, height: size }), pen = picture.getContext('2d');
  const colors = given.classes.map(([, it]) => css(it));
  for (let k = 0; k < size * size; k++) {
    pen.fillStyle = colors[kinds[3 * k]];
    pen.fillRect(k % size, size - 1 - Math.floor(k / size), 1, 1);
  }
  charts.basin.show({
    x: [-far, far], y: [-fast, fast], labels: [labels.position, labels.velocity],
    draw: (ctx, x, y, scale) => {
      ctx.imageSmoothingEnabled = false;
      ctx.drawImage(picture, x(-far), y(fast), x(far) - x(-far), y(-fast) - y(fast));
      for (const [position, velocity] of state.motion?.states.slice(0, 64) ?? []) dot(ctx, x(position), y(velocity), 4 * scale, 'var(--mark)');
    },
  });
}

// Numbers and words.
function summary() {
  const rows = [[number(state.along).label, told(value())]];
  if (state.motion) rows.push(['motion', state.motion.told.name], [`hardest ${state.about.labels.impact}`, told(state.motion.told.hardest)]);
  ends().forEach(([name, it]) => rows.push([name, told(it)]));
  return rows;
}
function fillIn() {
  for (const it of state.about.parameters) {
    for (const input of document.querySelectorAll(`[data-key="${it.key}"]`)) {
      // The one that is being moved is ahead of the machine.
      if (input !== document.activeElement) input.value = it.value;
      if (input.type === 'range') input.setAttribute('aria-valuetext', told(it.value));
    }
  }
  byId('readout').innerHTML = summary().map(([name, it]) => `<div><dt>${name}</dt><dd>${it}</dd></div>`).join('');
}
/** Tells a screen reader what there is now, and names the pictures after it. */
function say() {
  const text = summary().map(([name, it]) => `${name}: ${it}`).join(', ');
  byId('said').textContent = text;
  for (const [id, name] of [['diagram', 'Bifurcation diagram'], ['portrait', 'Phase portrait'], ['basin', 'Basins of attraction'], ['series', 'Position over time']]) {
    byId(id).querySelector('.plot').setAttribute('aria-label', `${name}. ${text}`);
  }
}

// Controls.
function limits({ value, allowed }) {
  if (allowed === 'share') return [0, 1];
  if (allowed === 'power') return [1, Math.max(3, value)];
  if (allowed === 'positive') return [.6 * value, 1.6 * value];
  if (allowed === 'not_negative') return [0, 2.5 * value || 1];
  return value ? [Math.min(-.25 * value, 2 * value), Math.max(-.25 * value, 2 * value)] : [-1, 1];
}
function build() {
  const { name, description, model, parameters } = state.about;
  document.title = `${name ?? 'machine'}: explorer`;
  byId('title').textContent = name ?? 'Machine';
  byId('about').textContent = description ?? `Stop: ${model}`;
  const row = it => {
    const [low, high] = limits(it), id = it.key.replaceAll('.', '-'), off = it.follows ? 'disabled' : '';
    return `<div class="number"><label for="${id}">${it.label}${it.follows ? ` = ${it.follows}` : ''}</label>`
      + `<input type="range" id="${id}" data-key="${it.key}" min="${low}" max="${high}" step="${(high - low) / 400}" ${off}>`
      + `<input type="number" data-key="${it.key}" step="any" aria-label="${it.label}" ${off}></div>`;
  };
  const [first, others] = [true, false].map(isMain => parameters.filter(it => FOREMOST.includes(it.key) === isMain));
  first.sort((a, b) => FOREMOST.indexOf(a.key) - FOREMOST.indexOf(b.key));
  byId('main').innerHTML = first.map(row).join('');
  byId('others').innerHTML = others.map(row).join('');
  document.querySelectorAll('[data-key]').forEach(input => input.addEventListener(input.type === 'range' ? 'input' : 'change', () => {
    if (input.value === '' || Number.isNaN(+input.value)) return;
    const slider = byId(input.dataset.key.replaceAll('.', '-'));
    if (+input.value < +slider.min) slider.min = input.value;
    if (+input.value > +slider.max) slider.max = input.value;
    change({ [input.dataset.key]: +input.value });
  }));
  byId('along').innerHTML = parameters.filter(it => !it.follows).map(it => `<option value="${it.key}">${it.label}</option>`).join('');
}
/** Another parameter goes across the diagram, or another range of it. */
function across(key, range) {
  state.along = key;
  state.range = range ?? limits(number(key));
  state.branches = null;
  byId('along').value = key;
  [byId('from').value, byId('to').value] = state.range.map(it => +it.toPrecision(6));
}
function controls() {
  byId('along').onchange = () => { across(byId('along').value); take(state.about, false); };
  byId('view').onchange = () => { state.view = byId('view').value; showDiagram(); };
  for (const id of ['from', 'to']) {
    byId(id).onchange = () => {
      const range = ['from', 'to'].map(it => +byId(it).value);
      if (range[0] < range[1]) { across(state.along, range); take(state.about, false); }
    };
  }
  ['thrown', 'rest'].forEach((id, k) => { byId(id).onclick = () => begin(state.about.starts[k]); });
  byId('machines').innerHTML = ['as given', 'unloaded (Peterka 2003)', 'loaded (Peterka 2003)'].map(it => `<option>${it}</option>`).join('');
  byId('machines').onchange = () => load([given.machine, ...given.named][byId('machines').selectedIndex]);
  byId('open').onchange = async () => load(await byId('open').files[0].text());
  byId('sound').onclick = () => {
    if (audio) audio.close();
    audio = audio ? null : new AudioContext();
    byId('sound').setAttribute('aria-pressed', audio !== null);
    byId('sound').textContent = audio ? 'Sound on' : 'Sound off';
    hear();
  };
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
    showDiagram();
    showMotion();
    if (state.cells) showBasin();
  });
}
const begin = ([position, velocity]) => change({ 'initial.position': position, 'initial.velocity': velocity });
/** The motion of the diagram nearest to a click. */
function pick(x, height) {
  const [width, tall] = [state.range, charts.diagram.shown.y].map(([low, high]) => high - low);
  let best = null, least = Infinity;
  for (const it of state.motions) {
    for (const y of heights(it)) {
      const far = Math.hypot((it.value - x) / width, (y - height) / tall / 3);
      if (far < least) [best, least] = [it, far];
    }
  }
  if (!best || !best.states.length) return;
  const [position, velocity] = best.states.slice(-2);
  change({ [state.along]: best.value, 'initial.position': position, 'initial.velocity': velocity });
}

// The machine as a file and as a link.
const packed = async (bytes, Stream) => new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new Stream('deflate-raw'))).arrayBuffer());
const plain = toml => toml.split('\n').map(line => line.replace(/^((?:[^"#]|"(?:[^"\\]|\\.)*")*)#.*$/, '$1').trimEnd()).join('\n');
async function link() {
  const bytes = await packed(new TextEncoder().encode(plain(state.machine)), CompressionStream);
  const letters = btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
  byId('permalink').href = `#${letters}`;
  history.replaceState(null, '', `#${letters}`);
  URL.revokeObjectURL(byId('download').href);
  byId('download').href = URL.createObjectURL(new Blob([state.machine], { type: 'application/toml' }));
  byId('download').download = `${state.about.name ?? 'machine'}.toml`;
}
async function linked() {
  try {
    const letters = atob(location.hash.slice(1).replaceAll('-', '+').replaceAll('_', '/'));
    return new TextDecoder().decode(await packed(Uint8Array.from(letters, it => it.charCodeAt(0)), DecompressionStream));
  } catch {
    return '';
  }
}

// Sound: the impacts of the motion, at some drive periods a second.
const PACE = 1.5;
let audio = null, round = null;
function hear() {
  clearTimeout(round);
  if (!audio || !state.motion) return;
  const { told: motion, impacts } = state.motion, { period } = state.about, length = motion.kind[2] || 64;
  const playing = audio, begin = playing.currentTime + .03;
  for (const [time, velocity] of impacts) {
    if (time >= length * period) break;
    strike(playing, begin + time / period / PACE, velocity / motion.hardest);
  }
  round = setTimeout(hear, 1000 * length / PACE);
}
function strike(playing, at, loud) {
  for (const [pitch, share, fade] of [[620, .5, .11], [1730, .3, .06], [3900, .2, .025]]) {
    const tone = playing.createOscillator(), gain = playing.createGain();
    tone.frequency.value = pitch;
    gain.gain.setValueAtTime(Math.max(.6 * loud * share, 1e-4), at);
    gain.gain.exponentialRampToValueAtTime(1e-5, at + fade);
    tone.connect(gain).connect(playing.destination);
    tone.start(at);
    tone.stop(at + fade);
  }
}

(async () => {
  const module = await compile();
  [live, slow] = [new Engine(module), new Engine(module)];
  charts = { diagram: new Chart('diagram', pick), portrait: new Chart('portrait'), basin: new Chart('basin', (x, v) => begin([x, v])), series: new Chart('series') };
  controls();
  load(await linked() || given.machine);
  addEventListener('hashchange', async () => {
    const machine = await linked();
    if (machine && machine !== plain(state.machine)) load(machine);
  });
})();
