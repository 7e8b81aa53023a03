// The panel of losses: from the attainable score to the delivered one, cause by cause (docs/results.md), at the moment
// that the page shows. At the end of a run, these are the numbers of result.json.
import {isPair, kRuns} from './flights.js';
import {element, moment, swatch} from './page.js';

const score = (value) => (value === 0 ? 0 : value).toFixed(1);

/** @returns attainable, lost (by cause) and delivered points and score at the moment; falsy: not known. */
function lostBy({lossesAt, data: run}) {
  const final = run.losses && typeof run.attainable?.score === 'number' && moment.seconds >= run.end;
  if (final) {
    return {could: run.attainable, of: (key) => run.losses[key], delivered: {points: run.detected, score: run.score}};
  }
  const so = lossesAt(moment.seconds);
  return so && {could: so.could, of: (key) => so.losses.get(key), delivered: so.delivered};
}

/** @param run  the flight's index on a page with two runs. */
export function lossesPanel(flight, run = 0) {
  const {data} = flight;
  const row = (colour, text, kind = '') => {
    const cells = [element('td'), element('td')];
    return {cells, row: element('tr', kind ? {class: kind} : {}, element('th', {scope: 'row'}, ...(colour ? [swatch(colour)] : []), text), ...cells)};
  };
  const fill = ({cells}, points, value) => {
    cells[0].textContent = String(points);
    cells[1].textContent = score(value);
  };
  const could = row('', 'attainable, by estimate', 'sum'), delivered = row('', 'delivered', 'sum');
  const causes = data.cause_keys.map((key, i) => ({key, ...row(`k${i}`, data.causes[i])}));
  const when = element('th', {scope: 'col'}, '');
  const head = element('tr', {}, when, ...['points', 'score'].map((name) => element('th', {scope: 'col'}, name)));
  const body = element('tbody', {}, could.row, ...causes.map((cause) => cause.row), delivered.row);
  const title = isPair() ? `Where the points went: ${kRuns[run]}` : 'Where the points went';
  const panel = element('section', {class: 'panel', id: run === 0 ? 'losses' : 'losses-B'}, element('h2', {}, title),
                        element('div', {class: 'wide'}, element('table', {class: 'states'}, element('thead', {}, head), body)));
  const show = () => {
    const lost = lostBy(flight);
    panel.hidden = !lost;
    if (!lost) return;
    when.textContent = moment.seconds < data.end ? `at ${moment.seconds.toFixed(1)} s` :
        data.mode === 'replay' ? 'at the end of the run' : 'so far';
    fill(could, lost.could.points, lost.could.score);
    for (const cause of causes) {
      const sum = lost.of(cause.key);
      cause.row.hidden = !(sum?.points > 0);
      if (sum) fill(cause, sum.points, -sum.score);
    }
    fill(delivered, lost.delivered.points, lost.delivered.score);
  };
  return {element: panel, show};
}
