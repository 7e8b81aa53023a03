// The panels beside the scene: what each UAV does, its links, what happened, and what was chosen. Each is drawn anew for
// the moment that the page shows.
import {custody, doing, events, kLinks, linkOf, linksAt, pointsAt, poseAt, sharesAt} from './flight.js';
import {data, element, moment, trackColour} from './page.js';

const kMostEvents = 150;
const kMostInMatrix = 12;  // radio nodes

function swatch(name) {
  const made = element('span', {class: 'swatch', 'aria-hidden': 'true'});
  made.style.background = `var(--${name})`;
  return made;
}

function panel(title, attributes, ...children) {
  return element('section', {class: 'panel', ...attributes}, element('h2', {}, title), ...children);
}

function headRow(names) {
  return element('thead', {}, element('tr', {}, ...names.map((name) => element('th', {scope: 'col'}, name))));
}

/** @param choose  what a click on a UAV means */
export function fleetPanel(choose) {
  const rows = data.uavs.map((uav, i) => {
    const button = element('button', {type: 'button', title: `Follow ${uav.name}`}, swatch(trackColour(i)), uav.name);
    button.addEventListener('click', () => choose(i));
    const cells = ['words', '', '', '', ''].map((kind) => element('td', kind ? {class: kind} : {}));
    return {row: element('tr', {'aria-selected': 'false'}, element('th', {scope: 'row'}, button), ...cells), cells};
  });
  const body = element('tbody', {}, ...rows.map(({row}) => row));
  const show = (chosen) => {
    const shares = sharesAt(moment.seconds);
    rows.forEach(({row, cells}, i) => {
      row.setAttribute('aria-selected', String(i === chosen));
      const pose = poseAt(i, moment.seconds, moment.newest);
      [doing(i, moment.seconds), pose === null ? '–' : pose.speed.toFixed(1), linkOf(i, moment.seconds),
       String(shares[i].undelivered), shares[i].score.toFixed(2)]
          .forEach((text, k) => (cells[k].textContent = text));
    });
  };
  const table = element(
      'table', {class: 'uavs'}, headRow(['UAV', 'does', 'm/s', 'station', 'not delivered', 'score']), body);
  return {element: panel('Fleet', {id: 'fleet'}, element('div', {class: 'wide'}, table)), show};
}

const kPointStates = [
  ['delivered', 'q3', 'delivered'],
  ['carried', 'carried', 'photographed, not delivered'],
  ['poor', 'q0', 'photographed too poorly (below 0.2)'],
  ['unseen', 'q0', 'in no picture'],
];

/** What became of the points so far, and what keeps those that were delivered from 1. */
export function pointsPanel() {
  const cells = kPointStates.map(() => ['', ''].map(() => element('td')));
  const rows = kPointStates.map(([, colour, text], i) => element(
      'tr', {}, element('th', {scope: 'row'}, swatch(colour), text), ...cells[i]));
  const note = element('p', {class: 'soft'}, '');
  const show = () => {
    const {states, blur, resolution} = pointsAt(moment.seconds);
    kPointStates.forEach(([state], i) => {
      cells[i][0].textContent = String(states[state].points);
      cells[i][1].textContent = state === 'unseen' ? '–' : states[state].score.toFixed(1);
    });
    note.textContent = states.delivered.points === 0 ? '' :
        `A delivered point lost ${(100 * blur).toFixed(0)} % to blur and ${(100 * resolution).toFixed(0)} % to ` +
        'resolution (distance and tilt), on average.';
  };
  const table = element('table', {class: 'states'}, headRow(['points', 'number', 'score']), element('tbody', {}, ...rows));
  return {element: panel('Where the score is', {id: 'points'}, element('div', {class: 'wide'}, table), note), show};
}

export function linksPanel() {
  const names = ['station', ...data.uavs.map(({name}) => name)];
  const legend = element('ul', {class: 'legend'}, ...kLinks.map((text, i) => element(
      'li', {}, element('span', {class: `l l${i}`, 'aria-hidden': 'true'}), text)));
  if (names.length > kMostInMatrix)
    return {element: panel('Radio links', {id: 'links'}, element('p', {}, 'A fleet of this size has its links in the scene.')), show: () => {}};
  const cells = names.map(() => names.map(() => element('span', {class: 'l l0'})));
  const rows = names.map((name, from) => element(
      'tr', {}, element('th', {scope: 'row'}, name),
      ...names.map((_, to) => element('td', {}, ...(from === to ? [] : [cells[from][to]])))));
  const table = element(
      'table', {class: 'matrix'}, headRow(['from, to', ...names.map((name) => name.slice(0, 6))]),
      element('tbody', {}, ...rows));
  const show = () => {
    const digits = linksAt(moment.seconds);
    cells.forEach((row, from) => row.forEach((cell, to) => {
      const kind = digits === '' ? 0 : Number(digits[from * names.length + to]);
      cell.className = `l l${kind}`;
      cell.title = `${names[from]} to ${names[to]}: ${kLinks[kind]}`;
    }));
  };
  return {element: panel('Radio links', {id: 'links'}, element('div', {class: 'wide'}, table), legend), show};
}

const kWords = {
  joined: (e) => `${e.subject} takes part`,
  left: (e) => `${e.subject} takes no part any more`,
  collision: (e) => `${e.subject} collided with ${e.object}`,
  fault: (e) => `fault: ${[e.subject, e.object].filter(Boolean).join(' ')}`,
  delivered: (e) => `${e.subject} delivered ${e.object} ${e.object === 1 ? 'capture' : 'captures'}`,
};
const kTone = {left: 'bad', collision: 'bad', fault: 'bad', delivered: 'good'};

export function eventsPanel() {
  const list = element('ol', {class: 'events', tabindex: '0', 'aria-label': 'what happened, newest first'});
  let shown = '';
  const show = () => {
    const past = events.filter(({time}) => time <= moment.seconds).sort((a, b) => b.time - a.time).slice(0, kMostEvents);
    const key = `${past.length} ${past[0]?.time} ${past[0]?.object}`;
    if (key === shown) return;
    shown = key;
    list.replaceChildren(...past.map((e) => element(
        'li', {}, element('time', {}, `${e.time.toFixed(1)} s`),
        element('span', {class: kTone[e.event] ?? ''}, (kWords[e.event] ?? (() => e.event))(e)))));
  };
  return {element: panel('Events', {id: 'events'}, list), show};
}

const seconds = (time) => `${time.toFixed(1)} s`;

function factsOfPoint(index) {
  const {delivered, taken} = custody(index, moment.seconds);
  const one = delivered ?? taken;
  if (one === null) return [['state', 'unseen: in no picture so far']];
  const by = data.uavs[one.of.uav].name;
  const facts = [
    ['state', delivered !== null ? 'delivered' : 'photographed, not delivered'],
    ['score', `${one.q.toFixed(3)}${one.q < 0.2 ? ' (below 0.2 does not count)' : ''}`],
    ['best capture', `no. ${one.of.number} of ${by}, at ${seconds(one.of.time)}`],
    ['qualities', `sharp ${one.blur.toFixed(3)}, resolution ${one.res.toFixed(3)}` +
                      (one.distance > 0 ? `, ${one.distance.toFixed(3)} if seen head-on` : '')],
    ['delivered', one.of.delivered <= moment.seconds ? `at ${seconds(one.of.delivered)}` : 'not yet: its UAV had no direct link to the station, or has not sent it'],
  ];
  if (delivered !== null && taken.q > delivered.q + 1e-6)
    facts.push(['better', `${taken.q.toFixed(3)} by ${data.uavs[taken.of.uav].name}, not delivered`]);
  return facts;
}

function factsOfUav(index) {
  const pose = poseAt(index, moment.seconds, moment.newest);
  const share = sharesAt(moment.seconds)[index];
  return [
    ['does', doing(index, moment.seconds)],
    ['position', pose === null ? '–' : `${[pose.x, pose.y, pose.z].map((v) => v.toFixed(1)).join(', ')} m`],
    ['speed', pose === null ? '–' : `${pose.speed.toFixed(1)} m/s`],
    ['undelivered', String(share.undelivered)],
    ['share of the score', share.score.toFixed(2)],
  ];
}

/** One line, for the pointer. */
export function describe(index) {
  return [`point ${index}`, ...factsOfPoint(index).slice(0, 3).map(([, text]) => text)].join(' · ');
}

/** @param onThrough, onLeave  what its buttons mean */
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
    facts.replaceChildren(...(isUav ? factsOfUav(chosen.uav) : factsOfPoint(chosen.point))
                              .flatMap(([name, text]) => [element('dt', {}, name), element('dd', {}, text)]));
  };
  return {element: made, show};
}
