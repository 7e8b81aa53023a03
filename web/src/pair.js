// Two runs on one clock: the parts of the page that a page with one run does not have.
import {data, element, moment} from './page.js';
import {drawn, flights, kRuns} from './flights.js';

const seconds = (time) => `${time.toFixed(2)} s`;

/** @returns an element about the first difference between the runs. */
function difference() {
  const {t, fields, unknown} = data.difference;
  if (unknown) return element('span', {}, `The first difference is unknown: ${unknown}`);
  if (t === undefined) return element('span', {}, 'The two runs are the same, step by step.');
  const go = element('button', {type: 'button', id: 'difference', title: 'Go there'}, `First difference at ${seconds(t)}`);
  go.addEventListener('click', () => moment.set(t));
  const most = 4;
  const more = fields.length > most ? `, and ${fields.length - most} more` : '';
  return element('span', {}, go, ` ${fields.slice(0, most).join(', ')}${more}`);
}

/** @returns the note below the head: names of the runs, and their first difference. */
export function pairNote() {
  const names = flights.map(({data: run}, k) => element(
      'span', {class: `run-${kRuns[k]}`}, element('strong', {}, kRuns[k]), ` ${run.title} by ${run.planners}, ${run.status}`));
  const fleets = data.fleets_differ ? [element('span', {class: 'bad'}, 'Their fleets differ.')] : [];
  return element('p', {class: 'note pair', id: 'pair'}, ...names, ...fleets, difference());
}

/** @param figure  function that makes a figure of the head. */
export const pairFigures = (figure) => [figure('score', 'delivered score of A'), figure('score-b', 'delivered score of B')];

export function showPairHead() {
  const {score, points} = flights[1].scoreAt(moment.newest ? Infinity : moment.seconds);
  const shown = document.getElementById('score-b');
  shown.textContent = score.toFixed(3);
  shown.dataset.exact = String(score);
  document.getElementById('score-b-more').textContent = `${points} of ${data.points.length / 9} points`;
}

function tools(scene, changed) {
  const boxes = kRuns.map((name, k) => {
    const box = element('input', {type: 'checkbox', 'data-run': name});
    box.checked = true;
    box.addEventListener('change', () => {
      drawn.runs[k] = box.checked;
      changed();
    });
    return element('label', {}, box, name);
  });
  const whose = element('select', {id: 'points-of', 'aria-label': 'whose score the points have'},
                        ...kRuns.map((name, k) => element('option', {value: String(k)}, name)));
  whose.addEventListener('change', () => {
    drawn.points = Number(whose.value);
    changed();
  });
  const row = scene.stage.parentElement.querySelector('.tools');
  row.prepend(...boxes, element('label', {}, 'Points of', whose));
}

/** Marks the first difference on the slider. */
function markSlider() {
  const slider = document.getElementById('moment');
  const {t} = data.difference;
  if (t === undefined || slider === null) return;
  const mark = element('span', {class: 'first-difference', title: `first difference, ${seconds(t)}`});
  mark.style.setProperty('--at', String(Math.min(t / Math.max(data.end, 1e-3), 1)));
  const rail = element('span', {class: 'rail'});
  slider.replaceWith(rail);
  rail.append(slider, mark);
}

/** @param changed  called when the user changes what is to be drawn. */
export function completePair(scene, changed) {
  if (!scene) return;
  tools(scene, changed);
  markSlider();
  const entry = (kind, text) => element('li', {}, element('span', {class: `apart ${kind}`, 'aria-hidden': 'true'}), text);
  scene.stage.after(element('ul', {class: 'legend'}, entry('first', 'A: filled, whole trails'), entry('second', 'B: hollow, dashed trails')));
  changed();
}
