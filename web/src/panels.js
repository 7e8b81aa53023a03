// The panels beside the scene: activities of the UAVs, links, events, and facts about the chosen UAV or point. Each is
// drawn for the moment that the page shows.
import {factsOfActivity, numbersOf, saidAt, showDoes} from './activity.js';
import {kDetected, weakestPart} from './custody.js';
import {allEvents, doing, drawn, flights, isPair, kLinks, kRuns, linkOf, poseAt, sharesAt} from './flights.js';
import {linkButton, showLinkButton} from './hand_faults.js';
import {data, element, moment, shortName, swatch, trackColour} from './page.js';

const kMostEvents = 150;
const kMostInMatrix = 33;  // radio nodes; larger fleets have no matrix
const kManyInMatrix = 9;   // from here on cells are small, and columns have no names

function panel(title, attributes, ...children) {
  return element('section', {class: 'panel', ...attributes}, element('h2', {}, title), ...children);
}

/** @returns title and id of a panel that exists once for each of two flights. */
const titled = (run, title, id) => [isPair() ? `${title}: ${kRuns[run]}` : title, {id: run > 0 ? `${id}-${kRuns[run]}` : id}];

function headRow(names) {
  return element('thead', {}, element('tr', {}, ...names.map((name) => element('th', {scope: 'col'}, name))));
}

/** @param choose  called with the UAV that the user clicks on. */
export function fleetPanel(choose) {
  const rows = data.uavs.map((uav, i) => {
    const button = element('button', {type: 'button', title: `Follow ${uav.name}`}, swatch(trackColour(i)), shortName(uav.name, 12));
    button.addEventListener('click', () => choose(i));
    const does = element('div', {class: 'does'});
    const cells = [0, 1, 2, 3].map(() => element('td'));
    return {row: element('tr', {'aria-selected': 'false'}, element('th', {scope: 'row'}, button, does), ...cells), does, cells};
  });
  const body = element('tbody', {}, ...rows.map(({row}) => row));
  const show = (chosen) => {
    const shares = sharesAt(moment.seconds);
    rows.forEach(({row, does: place, cells}, i) => {
      row.setAttribute('aria-selected', String(i === chosen));
      const pose = poseAt(i, moment.seconds, moment.newest);
      const does = doing(i, moment.seconds);
      const said = saidAt(i, moment.seconds);
      showDoes(place, does, does === said?.mode ? said : null);
      [pose === null ? '–' : pose.speed.toFixed(1), linkOf(i, moment.seconds), String(shares[i].undelivered),
       shares[i].score.toFixed(2)]
          .forEach((text, k) => cells[k].textContent === text || (cells[k].textContent = text));
    });
  };
  const table = element(
      'table', {class: data.uavs.length > 8 ? 'uavs many' : 'uavs'},
      headRow(['UAV, and what it does', 'm/s', 'station', 'not delivered', 'score']), body);
  return {element: panel('Fleet', {id: 'fleet'}, element('div', {class: 'wide'}, table)), show};
}

function askForPoint(choose) {
  const number = element('input', {
    type: 'number', id: 'point-number', min: '0', max: String(data.points.length / 9 - 1), step: '1', 'aria-label': 'number of a point'});
  const ask = element('form', {class: 'tools-row'}, element('label', {}, 'Point ', number), element('button', {}, 'Show'));
  ask.addEventListener('submit', (event) => {
    event.preventDefault();
    if (number.value !== '' && number.checkValidity()) choose(Number(number.value));
  });
  return ask;
}

const kPointStates = [
  ['delivered', 'q3', 'delivered'],
  ['carried', 'carried', 'photographed, not delivered'],
  ['poor', 'q0', 'photographed too poorly (below 0.2)'],
  ['unseen', 'q0', 'in no picture'],
];

/**
 * The panel of the points: number and score by state, why delivered points have less than the full quality, and why
 * others were photographed too poorly.
 * @param choose  called with the number of a point that the user enters, for users who cannot click on it in the scene;
 * null: no such field. @param run  index of the flight on a page with two runs.
 */
export function pointsPanel(choose, run = 0) {
  const cells = kPointStates.map(() => ['', ''].map(() => element('td')));
  const rows = kPointStates.map(([, colour, text], i) => element(
      'tr', {}, element('th', {scope: 'row'}, swatch(colour), text), ...cells[i]));
  const note = element('p', {class: 'soft'}, '');
  const show = () => {
    const {states, blur, resolution, poor} = flights[run].pointsAt(moment.seconds);
    kPointStates.forEach(([state], i) => {
      cells[i][0].textContent = String(states[state].points);
      cells[i][1].textContent = state === 'unseen' ? '–' : states[state].score.toFixed(1);
    });
    const sentences = [];
    if (states.delivered.points > 0)
      sentences.push(`A delivered point lost ${(100 * blur).toFixed(0)} % to blur and ${(100 * resolution).toFixed(0)} % to ` +
                     'resolution (distance and tilt), on average.');
    const causes = Object.entries(poor).filter(([, points]) => points > 0);
    if (causes.length > 0)
      sentences.push('What lowers the quality of points photographed too poorly most: ' +
                     `${causes.map(([part, points]) => `${part} (${points})`).join(', ')}.`);
    note.textContent = sentences.join(' ');
  };
  const table = element('table', {class: 'states'}, headRow(['points', 'number', 'score']), element('tbody', {}, ...rows));
  return {
    element: panel(...titled(run, 'Where the score is', 'points'), element('div', {class: 'wide'}, table), note,
                   ...(choose === null ? [] : [askForPoint(choose)])),
    show,
  };
}

export function linksPanel(run = 0) {
  const names = ['station', ...flights[run].data.uavs.map(({name}) => name)];
  const legend = element('ul', {class: 'legend'}, ...kLinks.map((text, i) => element(
      'li', {}, element('span', {class: `l l${i}`, 'aria-hidden': 'true'}), text)));
  if (names.length > kMostInMatrix)
    return {element: panel(...titled(run, 'Radio links', 'links'), element('p', {}, 'A fleet of this size has its links in the scene.')), show: () => {}};
  const cells = names.map((_, from) => names.map((__, to) => linkButton(from, to)));
  const rows = names.map((name, from) => element(
      'tr', {}, element('th', {scope: 'row', title: name}, shortName(name, 14)),
      ...names.map((_, to) => element('td', {}, ...(from === to ? [] : [cells[from][to]])))));
  const many = names.length > kManyInMatrix;
  const columns = names.map((name, i) => (many ? (i === 0 ? 'stn' : String(i)) : shortName(name, 7)));
  if (many) rows.forEach((row, i) => i > 0 && row.firstChild.prepend(element('small', {}, `${i} `)));
  const table = element(
      'table', {class: many ? 'matrix many' : 'matrix'}, headRow(['from, to', ...columns]), element('tbody', {}, ...rows));
  const show = () => {
    const digits = flights[run].linksAt(moment.seconds);
    cells.forEach((row, from) => row.forEach((cell, to) => {
      const kind = digits === '' ? 0 : Number(digits[from * names.length + to]);
      showLinkButton(cell, from, to, kind, kLinks[kind]);
    }));
  };
  return {element: panel(...titled(run, 'Radio links', 'links'), element('div', {class: 'wide'}, table), legend), show};
}

const kWords = {
  joined: (e) => `${e.subject} takes part`,
  left: (e) => `${e.subject} takes no part any more`,
  collision: (e) => `${e.subject} collided with ${e.object}`,
  fault: (e) => `fault: ${[e.subject, e.object].filter(Boolean).join(' ')}`,
  delivered: (e) => `${e.subject} delivered ${e.object} ${e.object === 1 ? 'capture' : 'captures'}`,
};
const clock = (time) => `${time.toFixed(1)} s`;
const kTone = {left: 'bad', collision: 'bad', fault: 'bad', delivered: 'good'};

export function eventsPanel() {
  const list = element('ol', {class: 'events', tabindex: '0', 'aria-label': 'what happened, newest first'});
  let shown = '';
  const show = () => {
    const past = allEvents().filter(({time}) => time <= moment.seconds).sort((a, b) => b.time - a.time).slice(0, kMostEvents);
    const key = `${past.length} ${past[0]?.time} ${past[0]?.object}`;
    if (key === shown) return;
    shown = key;
    list.replaceChildren(...past.map((e) => element(
        'li', {}, element('time', {}, clock(e.time)),
        element('span', {class: kTone[e.event] ?? ''}, `${e.run ? `${e.run}: ` : ''}${(kWords[e.event] ?? (() => e.event))(e)}`))));
  };
  return {element: panel('Events', {id: 'events'}, list), show};
}

function factsOfPoint(index, flight = flights[drawn.points]) {
  const {delivered, taken} = flight.custody(index, moment.seconds);
  const one = delivered ?? taken;
  if (one === null) return [['state', 'unseen: in no picture so far']];
  const by = flight.data.uavs[one.of.uav].name;
  const poor = one.q < kDetected ? ` (below ${kDetected} does not count; lowered most by ${weakestPart(one)})` : '';
  const facts = [
    ['state', delivered !== null ? 'delivered' : 'photographed, not delivered'],
    ['score', `${one.q.toFixed(3)}${poor}`],
    ['best capture', `no. ${one.of.number} of ${by}, at ${clock(one.of.time)}`],
    ['qualities', `sharp ${one.blur.toFixed(3)}, resolution ${one.res.toFixed(3)}` +
                      (one.distance > 0 ? `, ${one.distance.toFixed(3)} if seen head-on` : '')],
    ['delivered', one.of.delivered <= moment.seconds ? `at ${clock(one.of.delivered)}` : 'not yet: its UAV had no direct link to the station, or has not sent it'],
  ];
  if (delivered !== null && taken.q > delivered.q + 1e-6)
    facts.push(['better', `${taken.q.toFixed(3)} by ${flight.data.uavs[taken.of.uav].name}, not delivered`]);
  return facts;
}

/** @returns the facts about a point in each flight of the page. */
const factsOfPoints = (index) => !isPair() ? factsOfPoint(index) :
    flights.flatMap((flight, k) => factsOfPoint(index, flight).map(([name, text]) => [`${kRuns[k]}: ${name}`, text]));

function factsOfUav(index) {
  const pose = poseAt(index, moment.seconds, moment.newest);
  const share = sharesAt(moment.seconds)[index];
  const counts = numbersOf(index)?.undelivered ?? share.undelivered;
  return [
    ['does', doing(index, moment.seconds)],
    ...factsOfActivity(index, pose),
    ['position', pose === null ? '–' : `${[pose.x, pose.y, pose.z].map((v) => v.toFixed(1)).join(', ')} m`],
    ['speed', pose === null ? '–' : `${pose.speed.toFixed(1)} m/s`],
    ['undelivered', `${share.undelivered}${counts === share.undelivered ? '' : `; ${counts} by its own count`}`],
    ['share of the score', share.score.toFixed(2)],
  ];
}

/** @returns a line about a point, for the tip at the pointer. */
export function describe(index) {
  return [`point ${index}`, ...factsOfPoint(index).slice(0, 3).map(([, text]) => text)].join(' · ');
}

/** @param onThrough, onLeave  called by its buttons. */
export function chosenPanel(onThrough, onLeave) {
  const title = element('h2', {}, '');
  const facts = element('dl', {});
  const through = element('button', {type: 'button', 'aria-pressed': 'false'}, 'Look through its camera');
  const leave = element('button', {type: 'button'}, 'Let go');
  through.addEventListener('click', onThrough);
  leave.addEventListener('click', onLeave);
  const made = element(
      'section', {class: 'panel', id: 'chosen', 'aria-live': 'polite'}, title, facts,
      element('div', {class: 'tools-row'}, through, leave));
  made.hidden = true;
  const show = (chosen) => {
    made.hidden = chosen.uav < 0 && chosen.point < 0;
    if (made.hidden) return;
    const isUav = chosen.uav >= 0;
    title.textContent = isUav ? data.uavs[chosen.uav].name : `Point ${chosen.point}`;
    through.hidden = !isUav;
    through.setAttribute('aria-pressed', String(chosen.through));
    through.textContent = chosen.through ? 'Look from outside' : 'Look through its camera';
    facts.replaceChildren(...(isUav ? factsOfUav(chosen.uav) : factsOfPoints(chosen.point))
                              .flatMap(([name, text]) => [element('dt', {}, name), element('dd', {}, text)]));
  };
  return {element: made, show};
}
