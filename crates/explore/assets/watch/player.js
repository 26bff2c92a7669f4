// The player: numbers, buttons, keys and sound.

// What is told in numbers.
const cells = [
  ['time', labels.time, t => told(t)],
  ['x', labels.position, (_, now) => told(now.x)],
  ['v', labels.velocity, (_, now) => told(now.v)],
  ['f', labels.force, (_, now) => told(now.f)],
  ['angle', 'drive angle', t => `${(((angle(t) * 180 / Math.PI) % 360 + 360) % 360).toFixed(1)}°`],
  ['phase', 'phase', t => phase(t).kind],
  ...(places.strip ? [['strip', 'strip', t => strip(t)]] : []),
  ['impact', 'impact', (_t, _now, k) => `${k} of ${impacts.length}`],
  ['before', labels.before_impact_velocity, (_t, _now, k) => k ? told(impacts[k - 1].velocity_before) : '–'],
];
byId('readout').innerHTML = cells.map(([id, label]) => `<div><dt>${label}</dt><dd id="now-${id}"></dd></div>`).join('');

// The player.
let t = begin, isPlaying = false, last = 0, audio = null;
function draw() {
  const now = state(t), k = count(impactTimes, t), hit = motion.hits[count(hitTimes, t) - 1];
  drawMachine(t, now, hit);
  if (isClose) drawCloseup(t, now, hit);
  drawSeries('position', t, now.x, samples.position, heights, labels.position, lines);
  drawSeries('force', t, now.f, samples.force, roomy(forces, .06), labels.force, []);
  drawPortrait(t, now);
  for (const [id, , tell] of cells) byId(`now-${id}`).textContent = tell(t, now, k);
  byId('at').value = t;
  byId('at').setAttribute('aria-valuetext', `${labels.time} ${told(t)}, impact ${k} of ${impacts.length}`);
  byId('back-impact').disabled = !(impactTimes[0] < t);
  byId('on-impact').disabled = !(impactTimes[impactTimes.length - 1] > t);
}
function strike(hit, delay) {
  const at = audio.currentTime + delay, loud = Math.abs(hit.velocity_before) / loudest;
  for (const [pitch, share, fade] of [[620, .5, .11], [1730, .3, .06], [3900, .2, .025]]) {
    const tone = audio.createOscillator(), gain = audio.createGain();
    tone.frequency.value = pitch;
    gain.gain.setValueAtTime(Math.max(.8 * loud * share, 1e-4), at);
    gain.gain.exponentialRampToValueAtTime(1e-5, at + fade);
    tone.connect(gain).connect(audio.destination);
    tone.start(at);
    tone.stop(at + fade);
  }
}
function frame(time) {
  if (!isPlaying) return;
  const pace = +byId('speed').value * drive.period, from = t;
  t = Math.min(t + pace * Math.min((time - last) / 1000, .1), end);
  last = time;
  if (audio) motion.hits.slice(count(hitTimes, from), count(hitTimes, t)).forEach(hit => strike(hit, (hit.time - from) / pace));
  if (t >= end) play(false);
  draw();
  requestAnimationFrame(frame);
}
function play(on) {
  if (on && t >= end) t = begin;
  isPlaying = on;
  last = performance.now();
  byId('play').textContent = on ? 'Pause' : 'Play';
  if (on) requestAnimationFrame(frame);
}
function go(to) {
  play(false);
  t = between(begin, to, end);
  draw();
}
const step = way => go(t + way * drive.period / 200);
function leap(way) {
  const k = way > 0 ? count(impactTimes, t) : impactTimes.findLastIndex(it => it < t), hit = impacts[k];
  if (!hit) return;
  go(hit.time);
  byId('said').textContent = `Impact ${k + 1} of ${impacts.length}: ${labels.before_impact_velocity} ${told(hit.velocity_before)} at ${labels.time} ${told(hit.time)}`;
}
function hear() {
  if (audio) audio.close();
  audio = audio ? null : new AudioContext();
  byId('sound').setAttribute('aria-pressed', audio !== null);
  byId('sound').textContent = audio ? 'Sound on' : 'Sound off';
}
function pace(way) {
  const speed = byId('speed');
  speed.selectedIndex = between(0, speed.selectedIndex + way, speed.options.length - 1);
}
const keys = {
  ' ': () => play(!isPlaying), Home: () => go(begin), End: () => go(end),
  PageUp: () => go(t - drive.period), PageDown: () => go(t + drive.period),
  '+': () => pace(1), '-': () => pace(-1), s: hear, S: hear,
};
for (const [key, way] of [['ArrowLeft', -1], ['ArrowRight', 1]]) keys[key] = event => (event.shiftKey ? leap : step)(way);
document.addEventListener('keydown', event => {
  const isNative = event.target.tagName === 'SELECT' || (event.target.tagName === 'BUTTON' && event.key === ' ');
  if (isNative || event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
  event.preventDefault();
  keys[event.key](event);
});
byId('play').onclick = () => play(!isPlaying);
byId('sound').onclick = hear;
byId('at').oninput = () => go(+byId('at').value);
for (const id of ['position', 'force', 'portrait']) {
  const svg = byId(id).querySelector('svg');
  svg.onclick = event => {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    go(seeks[id](at.x, at.y));
  };
}
for (const [id, act] of [['back', () => step(-1)], ['on', () => step(1)], ['back-impact', () => leap(-1)], ['on-impact', () => leap(1)]]) byId(id).onclick = act;

// What stands on the page from the beginning.
const options = (id, all, chosen) => {
  byId(id).innerHTML = all.map(([value, words]) => `<option value="${value}">${words}</option>`).join('');
  byId(id).value = chosen;
  byId(id).onchange = draw;
};
const slow = [100, 50, 20, 10, 5, 2].map(it => [1 / it, `1/${it} drive period a second`]);
options('speed', [...slow, ...[1, 2, 5].map(it => [it, `${it} drive period${it > 1 ? 's' : ''} a second`]),
  ...(motion.machine.language === 'ratios' ? [] : [[1 / drive.period, 'as it is']])], 1 / 2);
options('window', [1, 2, 4, 8, 16].map(it => [it, `${it} drive period${it > 1 ? 's' : ''}`]), 4);
document.title = `${motion.title}: motion`;
byId('title').textContent = motion.title;
byId('about').textContent = `${(end - begin) / drive.period < 1.5 ? '1 drive period' : Math.round((end - begin) / drive.period) + ' drive periods'}, stop: ${places.model}, ${impacts.length} impact${impacts.length === 1 ? '' : 's'}`;
byId('closeup').hidden = !isClose;
const kinds = new Map(phases.filter(it => it.color).map(it => [it.kind, it.color]));
byId('position').querySelector('figcaption').innerHTML = [...kinds].map(([kind, color]) => `<span><i style="--of:${color}"></i>${kind}</span>`).join('') + (impacts.length ? '<span>▾ impact</span>' : '');
Object.assign(byId('at'), { min: begin, max: end });
const layout = () => { still = {}; drawTrack(); draw(); };
addEventListener('resize', layout);
layout();
