// Where the points of a finished run went: from what could be had to what was delivered, cause by cause (docs/results.md).
import {data, element} from './page.js';

const score = (value) => value.toFixed(1);

/** @param of  a run's scene. @returns the panel; null where the run does not tell. */
export function lossesPanel(of = data, title = 'Where the points went') {
  if (!of.losses || typeof of.attainable?.score !== 'number') return null;
  const row = (colour, text, points, value, kind = '') => {
    const swatch = element('span', {class: 'swatch', 'aria-hidden': 'true'});
    swatch.style.background = `var(--${colour})`;
    const cell = (content) => element('td', {}, content);
    return element('tr', kind ? {class: kind} : {}, element('th', {scope: 'row'}, ...(colour ? [swatch] : []), text), cell(points), cell(value));
  };
  const lost = of.cause_keys.flatMap((key, i) => {
    const sum = of.losses[key];
    return sum?.points > 0 ? [row(`k${i}`, of.causes[i], String(sum.points), score(-sum.score))] : [];
  });
  const rows = [row('', 'could be had, by estimate', String(of.attainable.points), score(of.attainable.score), 'sum'), ...lost,
                row('', 'delivered', String(of.detected), score(of.score), 'sum')];
  const head = element('tr', {}, ...['at the end of the run', 'points', 'score'].map((name) => element('th', {scope: 'col'}, name)));
  const table = element('table', {class: 'states'}, element('thead', {}, head), element('tbody', {}, ...rows));
  return element('section', {class: 'panel', id: 'losses'}, element('h2', {}, title), element('div', {class: 'wide'}, table));
}
