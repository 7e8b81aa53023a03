// What all parts of the page share: its data, its colours, and one moment in the run that they all show.

/** Of a finished run, in the page; of one that is followed, filled while it goes on (flight.js). */
export const data = JSON.parse(document.getElementById('data')?.textContent ?? '{"end": 0, "follows": true}');

const colours = new Map();
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => colours.clear());

/** A colour of the style sheet, as it is in light or dark. */
export function colour(name) {
  if (!colours.has(name))
    colours.set(name, getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim());
  return colours.get(name);
}

/** Calls back now and whenever light turns to dark or back. */
export function onTheme(use) {
  use();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', use);
}

/** As many colours as style.cpp has for tracks; then they repeat. A UAV of a second flight has that of its own fleet. */
export const trackColour = (uav) => `t${(data.uavs?.[uav]?.own ?? uav) % 6}`;

const listeners = [];
let chosen = data.end;
export const moment = {
  /** Whether it is the newest that there is, and moves on with it. */
  newest: true,
  get seconds() {
    return this.newest ? data.end : chosen;
  },
  set(seconds) {
    chosen = Math.min(Math.max(seconds, 0), data.end);
    this.newest = seconds >= data.end;
    for (const use of listeners) use(this.seconds);
  },
  listen: (use) => listeners.push(use),
};

const growing = [];
/** Data that grow: who shows them is told when there are more. */
export const growth = {
  tell() {
    for (const use of growing) use();
    if (moment.newest) moment.set(data.end);
  },
  listen: (use) => growing.push(use),
};

/** Undoes the differences of page_data.cpp: a track in seconds, metres and radians. One that grows is in them already. */
export function track(uav) {
  if (uav.track.grows) return uav.track;
  const sum = (differences, scale) => {
    let last = 0;
    return Float32Array.from(differences, (d) => (last += d) * scale);
  };
  const {t, x, y, z, yaw, pitch} = uav.track;
  return {t: sum(t, 0.01), x: sum(x, 0.01), y: sum(y, 0.01), z: sum(z, 0.01), yaw: sum(yaw, 0.001), pitch: sum(pitch, 0.001)};
}

/** The last index whose value is not beyond `value`, or -1. */
export function indexAt(values, value) {
  let low = 0;
  let high = values.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] <= value)
      low = middle + 1;
    else
      high = middle;
  }
  return low - 1;
}

/** An element with attributes and children. */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** A small field of a named colour. */
export function swatch(name) {
  const made = element('span', {class: 'swatch', 'aria-hidden': 'true'});
  made.style.background = `var(--${name})`;
  return made;
}

/** Puts a live part before a figure's drawing, which stays for paper. */
export function replaceDrawing(figure, live) {
  for (const child of figure.children) {
    if (child.tagName === 'FIGCAPTION') continue;
    child.classList.add('still-drawing');
    child.setAttribute('hidden', '');
  }
  figure.append(live);
}

/** What all names of the fleet begin and end with, in characters. */
function common() {
  const names = data.uavs.map(({name}) => name);
  const least = Math.min(...names.map(({length}) => length)) - 1;
  const shared = (at) => {
    let same = 0;
    while (names.length > 1 && same < least && names.every((name) => name.at(at(same)) === names[0].at(at(same)))) ++same;
    return same;
  };
  const begin = shared((i) => i);
  return [begin, Math.min(shared((i) => -1 - i), least - begin)];
}
let shared = null;

/** A name of about so many characters at most: what sets it apart from the others of the fleet stays. */
export function shortName(name, most) {
  if (name.length <= most) return name;
  shared ??= common();
  const [begin, end] = shared;
  const own = name.slice(begin, name.length - Math.max(end, 0));
  if (own.length + 2 > most) return `${name.slice(0, (most - 1) >> 1)}…${name.slice(-(most >> 1))}`;
  return `${name.slice(0, Math.min(begin, most - own.length - 2))}…${own}${end > 0 ? '…' : ''}`;
}
