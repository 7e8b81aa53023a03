// Things that all parts of the page share: its data, its colours, and the moment of the run that they all show.

/** A report contains its data; on the page that follows a run, flight.js fills them. */
export const data = JSON.parse(document.getElementById('data')?.textContent ?? '{"end": 0, "follows": true}');

const colours = new Map();
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => colours.clear());

/** @returns a colour of the style sheet, in the current light or dark scheme. */
export function colour(name) {
  if (!colours.has(name))
    colours.set(name, getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim());
  return colours.get(name);
}

/** Calls back now, and whenever the colour scheme changes between light and dark. */
export function onTheme(use) {
  use();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', use);
}

/** @returns the colour of a UAV: one of the 6 of style.cpp, by its number in its own fleet. */
export const trackColour = (uav) => `t${(data.uavs?.[uav]?.own ?? uav) % 6}`;

const listeners = [];
let chosen = data.end;
export const moment = {
  /** Whether the page always shows the newest moment, also while the run goes on. */
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
/** Informs the parts of the page when the data have grown. */
export const growth = {
  tell() {
    for (const use of growing) use();
    if (moment.newest) moment.set(data.end);
  },
  listen: (use) => growing.push(use),
};

/** @returns a track in seconds, metres and radians. That of a report is stored as differences (page_data.cpp). */
export function track(uav) {
  if (uav.track.grows) return uav.track;
  const sum = (differences, scale) => {
    let last = 0;
    return Float32Array.from(differences, (d) => (last += d) * scale);
  };
  const {t, x, y, z, yaw, pitch} = uav.track;
  return {t: sum(t, 0.01), x: sum(x, 0.01), y: sum(y, 0.01), z: sum(z, 0.01), yaw: sum(yaw, 0.001), pitch: sum(pitch, 0.001)};
}

/** @returns the last index with a value of at most `value`; -1: none. @param values  ascending. */
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

/** @returns a new element with attributes and children. */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/** @returns a small field in a colour of the style sheet. */
export function swatch(name) {
  const made = element('span', {class: 'swatch', 'aria-hidden': 'true'});
  made.style.background = `var(--${name})`;
  return made;
}

/** Shows an interactive part in place of a figure's drawing, which remains for printing. */
export function replaceDrawing(figure, live) {
  for (const child of figure.children) {
    if (child.tagName === 'FIGCAPTION') continue;
    child.classList.add('still-drawing');
    child.setAttribute('hidden', '');
  }
  figure.append(live);
}

/** @returns the lengths of the common prefix and of the common suffix of all names of the fleet. */
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

/**
 * Shortens a name to about `most` characters. The part that distinguishes it from the other names of the fleet stays.
 */
export function shortName(name, most) {
  if (name.length <= most) return name;
  shared ??= common();
  const [begin, end] = shared;
  const own = name.slice(begin, name.length - Math.max(end, 0));
  if (own.length + 2 > most) return `${name.slice(0, (most - 1) >> 1)}…${name.slice(-(most >> 1))}`;
  return `${name.slice(0, Math.min(begin, most - own.length - 2))}…${own}${end > 0 ? '…' : ''}`;
}
