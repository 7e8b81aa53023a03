// The legends below the scene.
import {data, element, swatch, trackColour} from './page.js';
import {points} from './points.js';

/** @returns the entries for the colours of the points. @param by  what the colours show: 'score', 'estimate', 'cause' or 'uav'. */
export function legendOf(by) {
  const entry = (name, text) => element('li', {}, swatch(name), text);
  if (by === 'uav')
    return [
      ...data.uavs.slice(0, 12).map((uav, i) => entry(trackColour(i), `by ${uav.name}`)), entry('q0', 'by no UAV')
    ];
  if (by === 'cause') {
    const there = new Set(points.map((p) => p.cause));
    return [
      ...data.causes.flatMap((cause, i) => (there.has(i) ? [entry(`k${i}`, cause)] : [])), entry('q0', 'nothing lost')
    ];
  }
  const steps = [[0.2, 0.4], [0.4, 0.6], [0.6, 0.8], [0.8, 1]].map(
      ([from, to], i) => entry(`q${i + 1}`, `${from.toFixed(1)} to ${to.toFixed(1)}`));
  if (data.custody && by === 'score') return [entry('q0', 'unseen'), entry('carried', 'not delivered'), ...steps];
  return [entry('q0', by === 'estimate' ? 'not attainable' : 'not detected'), ...steps];
}

/** @returns the legend of the lines that show links. */
export function legendOfLinks() {
  const names = [['direct', 'link to the station'], ['relayed', 'link between UAVs'], ['bad', 'cut by a fault']];
  const entry = (background, text) => {
    const line = element('span', {class: 'swatch line', 'aria-hidden': 'true'});
    line.style.background = background;
    return element('li', {}, line, text);
  };
  const dashes = (share) => `repeating-linear-gradient(90deg, var(--soft) 0 ${6 * share}px, transparent ${6 * share}px 6px)`;
  return element(
      'ul', {class: 'legend'}, ...names.map(([name, text]) => entry(`var(--${name})`, text)),
      ...(data.runs ? [] : [entry(dashes(0.5), 'blocked, of the followed UAV'), entry(dashes(0.17), 'dead')]));
}
