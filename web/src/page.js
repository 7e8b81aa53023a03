// What all parts of the page share: its data, its colours, and one moment in the run that they all show.

/** Of a finished run, in the page; of one that is followed, filled while it goes on (flight.js). */
export const data = JSON.parse(document.getElementById('data')?.textContent ?? '{"end": 0, "follows": true}');

/** A colour of the style sheet, as it is in light or dark. */
export const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** Calls back now and whenever light turns to dark or back. */
export function onTheme(use) {
  use();
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', use);
}

/** As many colours as style.cpp has for tracks; then they repeat. */
export const trackColour = (uav) => `t${uav % 6}`;

const listeners = [];
export const moment = {
  seconds: data.end,
  /** Whether it is the newest that there is, and moves on with it. */
  newest: true,
  set(seconds) {
    this.seconds = Math.min(Math.max(seconds, 0), data.end);
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

/** Undoes the differences of page_data.cpp: a track in seconds and metres. One that grows is in them already. */
export function track(uav) {
  if (uav.track.grows) return uav.track;
  const sum = (differences, scale) => {
    let last = 0;
    return Float32Array.from(differences, (d) => (last += d) * scale);
  };
  const {t, x, y, z} = uav.track;
  return {t: sum(t, 0.01), x: sum(x, 0.01), y: sum(y, 0.01), z: sum(z, 0.01)};
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

/** Puts a live part before a figure's drawing, which stays for paper. */
export function replaceDrawing(figure, live) {
  for (const child of figure.children) {
    if (child.tagName === 'FIGCAPTION') continue;
    child.classList.add('still-drawing');
    child.setAttribute('hidden', '');
  }
  figure.append(live);
}
