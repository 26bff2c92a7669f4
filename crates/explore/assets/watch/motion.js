'use strict';
// The motion: what the page holds, and the state at any time.
const byId = id => document.getElementById(id);
const motion = JSON.parse(byId('motion').textContent);
const { samples, phases, places, strips, drive, labels } = motion;
const [begin, end] = motion.span;
const impacts = motion.hits.filter(hit => hit.impact);
const [hitTimes, impactTimes] = [motion.hits, impacts].map(hits => hits.map(hit => hit.time));
const calm = matchMedia('(prefers-reduced-motion: reduce)');

// Numbers.
const between = (low, value, high) => Math.min(Math.max(value, low), high);
const range = values => values.reduce(([low, high], it) => [Math.min(low, it), Math.max(high, it)], [Infinity, -Infinity]);
const told = (value, digits = 6) => {
  const text = Math.abs(value) < 1e-300 ? '0' : value.toPrecision(digits);
  return text.replace(/-/g, '−').replace('e', ' e');
};
/** Without zeros at the end. */
const short = value => told(value, 4).replace(/(\.\d*?)0+(?= e|$)/, '$1').replace(/\.(?= e|$)/, '');
/** How many of the sorted times are at or before t. */
function count(times, t) {
  let [low, high] = [0, times.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle + 1; else high = middle;
  }
  return low;
}
/** Round values between two ends, some `wanted` of them. */
function ticks([low, high], wanted) {
  const rough = (high - low) / wanted, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5].find(it => it * power >= rough) ?? 10);
  const [first, last] = [Math.ceil(low / step - 1e-9), Math.floor(high / step + 1e-9)];
  return Array.from({ length: Math.max(last - first + 1, 0) }, (_, k) => +((first + k) * step).toPrecision(12));
}
function roomy([low, high], room) {
  const more = high > low ? room * (high - low) : Math.abs(low) || 1;
  return [low - more, high + more];
}

// The motion between its samples: Hermite's cubic for the position, straight lines for velocity and force.
function state(t) {
  const last = samples.time.length - 1;
  const i = between(0, count(samples.time, t) - 1, last), j = Math.min(i + 1, last);
  const h = samples.time[j] - samples.time[i], u = h > 0 ? (t - samples.time[i]) / h : 0;
  const line = values => values[i] + u * (values[j] - values[i]);
  const [x0, x1, v0, v1] = [samples.position[i], samples.position[j], samples.velocity[i], samples.velocity[j]];
  const x = x0 + u * (h * v0 + u * (3 * (x1 - x0) - h * (2 * v0 + v1) + u * (2 * (x0 - x1) + h * (v0 + v1))));
  return { x, v: line(samples.velocity), f: line(samples.force) };
}
const phaseTimes = phases.map(it => it.from);
const angle = t => 2 * Math.PI * t / drive.period + drive.angle;
const phase = t => phases[between(0, count(phaseTimes, t) - 1, phases.length - 1)];
const stripTimes = strips.map(it => it[0]);
const strip = t => strips[count(stripTimes, t) - 1]?.[1] ?? 'whole';
const positions = range(samples.position), velocities = range(samples.velocity), forces = range(samples.force);
const faces = [...new Set([...(places.strip ?? []), places.stop, places.wall].filter(it => it != null))];
// Those on either side.
const lines = [...faces, ...(places.below ? [places.below.face] : [])];
// A stop far out of reach does not flatten the motion.
const isNear = face => Math.max(face - positions[1], positions[0] - face) < 2 * (positions[1] - positions[0]);
const heights = roomy(range([...positions, ...lines.filter(isNear)]), .06);
const loudest = Math.max(...motion.hits.map(hit => Math.abs(hit.velocity_before)), 1e-300);
