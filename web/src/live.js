// The page that follows a live run, and replays it when it is over. Scene and charts are those of the report.
import uplotStyle from 'uplot/dist/uPlot.min.css';

import {takeClouds} from './clouds.js';
import {connect} from './connection.js';
import {addFigures} from './figures.js';
import filmStyle from './film.css';
import {offerFilm} from './film.js';
import {begin, flights, isPair, stand, tell} from './flights.js';
import {faultsPanel, setConnected, setOrderFunction, uavFaultsPanel} from './hand_faults.js';
import {handPanel} from './hand_flight.js';
import {tellKept} from './kept.js';
import style from './live.css';
import {lossesPanel} from './losses.js';
import {otherModes} from './modes.js';
import {data, element, growth, moment} from './page.js';
import pairStyle from './pair.css';
import {completePair, pairFigures, pairNote, showPairHead} from './pair.js';
import {chosenPanel, describe, eventsPanel, fleetPanel, linksPanel, pointsPanel} from './panels.js';
import reportStyle from './report.css';
import {readEye, watchEye, writeEye} from './viewpoint.js';

const kPanels = 400;  // ms between two drawings of the panels while time goes on
const kSpeeds = ['0.1', '0.5', '1', '2', '4', '8', '16', '32', 'max'];
const main = document.getElementById('flight');
const chosen = {uav: -1, point: -1, through: false};

document.head.append(element('style', {}, uplotStyle + reportStyle + style + pairStyle + filmStyle));

function figure(name, text) {
  const strong = element('strong', {id: name}, '–');
  const small = element('small', {id: `${name}-more`, class: 'soft'}, '');
  return element('div', {class: 'figure'}, element('span', {}, text), strong, small);
}

const set = (id, text) => {
  const found = document.getElementById(id);
  if (found.textContent !== text) found.textContent = text;
};

/** Controls of a live run: pause, step and speed. */
function controls(order) {
  const pause = element('button', {type: 'button', id: 'pause', class: 'main', 'aria-keyshortcuts': 'p', title: 'Pause the flight (p)'}, 'Pause');
  const step = element('button', {type: 'button', id: 'step', 'aria-keyshortcuts': 's', title: 'One exchange further (s)'}, 'Step');
  const speed = element('select', {id: 'speed', 'aria-label': 'speed of the flight'},
                        ...kSpeeds.map((value) => element('option', {value}, value === 'max' ? 'as fast as it goes' : `${value}x`)));
  pause.addEventListener('click', () => order({do: data.now?.paused ? 'resume' : 'pause'}));
  step.addEventListener('click', () => {
    if (!data.now?.paused) order({do: 'pause'});
    order({do: 'step'});
  });
  speed.addEventListener('change', () => order({do: 'speed', speed: speed.value === 'max' ? 'max' : Number(speed.value)}));
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || ['INPUT', 'SELECT', 'TEXTAREA'].includes(event.target.tagName)) return;
    if (event.key === 'p') pause.click();
    if (event.key === 's') step.click();
  });
  return element('div', {class: 'controls', role: 'group', 'aria-label': 'time of the flight'}, pause, step, speed);
}

function showControls(live) {
  const {now} = data;
  if (!now) return;
  const pause = document.getElementById('pause');
  pause.textContent = now.paused ? 'Resume' : 'Pause';
  pause.title = `${now.paused ? 'Resume the flight' : 'Pause the flight'} (p)`;
  const speed = document.getElementById('speed');
  if (![...speed.options].some(({value}) => value === now.speed)) speed.append(element('option', {value: now.speed}, `${now.speed}x`));
  if (document.activeElement !== speed) speed.value = now.speed;
  for (const id of ['pause', 'step', 'speed']) document.getElementById(id).disabled = !live || !data.paced;
}

const kStates = {
  flies: ['flies', ''],
  paused: ['paused', 'held'],
  waits: ['waits', 'held'],
  gone: ['not connected; trying again', 'gone'],
  replay: ['replay', 'replay'],
  closed: ['replay, no longer served', 'gone'],
};
let live = false;

function stateOf() {
  if (data.mode === 'replay') return live ? 'replay' : 'closed';
  if (!live) return 'gone';
  if (data.now?.waits) return 'waits';
  return data.now?.paused ? 'paused' : 'flies';
}

function showHead() {
  setConnected(live);
  const [text, kind] = kStates[stateOf()];
  const state = document.getElementById('state');
  if (state.className !== `state ${kind}`) state.className = `state ${kind}`;
  const {waits} = data.now ?? {};
  set('state', stateOf() === 'waits' ? `waits for ${waits.for.join(', ')} (${waits.what})` : text);
  if (document.body.dataset.state !== stateOf()) document.body.dataset.state = stateOf();
  const {score, points} = flights[0].scoreAt(moment.newest ? Infinity : moment.seconds);
  set('score', score.toFixed(3));
  set('score-more', `${points} of ${data.points.length / 9} points`);
  document.getElementById('score').dataset.exact = String(score);
  set('clock', `${moment.seconds.toFixed(moment.newest && data.now?.paused ? 2 : 1)} s`);
  const mission = data.now?.mission;
  set('clock-more', mission === undefined ? `of ${data.end.toFixed(1)} s` :
      moment.newest ? (mission > 0 ? `mission ${mission.toFixed(1)} of ${data.duration} s` : 'before take-off') :
                      `flown: ${data.end.toFixed(1)} s`);
  if (data.now) document.getElementById('clock').dataset.tick = String(data.now.tick);
  if (isPair()) showPairHead();
  if (data.mode === 'live') showControls(live);
}

function frame(order) {
  const by = isPair() ? ', two runs' : data.planners ? ` by ${data.planners}` : '';
  const scores = isPair() ? pairFigures(figure) : [figure('score', 'delivered score')];
  const title = element('h1', {}, `${data.title ?? data.scenario}${by}`, element('span', {id: 'state', class: 'state', role: 'status'}));
  const bar = element('header', {class: 'bar'}, title, figure('clock', 'simulated time'), ...scores,
                      ...(data.mode === 'live' ? [controls(order)] : []));
  const picture = (name, caption) => element('figure', {'data-live': name}, element('figcaption', {}, caption));
  const places = {
    scene: picture('3d', 'In three dimensions'),
    score: picture('score', 'Score over time'),
    lanes: picture('lanes', 'What each UAV did'),
  };
  const side = element('div', {class: 'column side'}, places.score);
  const couple = element('div', {class: 'couple'});
  const missing = data.missing?.length ? [element('p', {class: 'note'}, `This recording is incomplete: ${data.missing.join(' ')}`)] : [];
  main.replaceChildren(bar, ...(isPair() ? [pairNote()] : []), ...missing, element('div', {class: 'layout'},
      element('div', {class: 'views'}, places.scene), side, element('div', {class: 'column below'}, places.lanes, couple)));
  return {...places, side, couple};
}

/** The page's address contains what the page shows, so that a user can save or share it. */
const address = {
  shown: false,  // whether the page shows what its address said when it was opened; before that, write() does nothing
  write() {
    if (!this.shown) return;
    const words = new URLSearchParams();
    if (!moment.newest) words.set('t', moment.seconds.toFixed(2));
    if (chosen.uav >= 0) words.set('uav', data.uavs[chosen.uav].name);
    if (chosen.through) words.set('view', 'camera');
    if (chosen.point >= 0) words.set('point', String(chosen.point));
    writeEye(words);
    const hash = words.size > 0 ? `#${words}` : '';
    if (hash !== location.hash) history.replaceState(null, '', hash || location.pathname);
  },
  read() {
    const words = new URLSearchParams(location.hash.slice(1));
    const time = Number(words.get('t') ?? NaN);
    const point = Number(words.get('point') ?? -1);
    return {
      time,
      uav: data.uavs.findIndex(({name}) => name === words.get('uav')),
      point: Number.isInteger(point) && point < data.points.length / 9 ? point : -1,
      through: words.get('view') === 'camera',
    };
  },
};

/**
 * Puts the panels beside and below the scene.
 * @param choose  called with the UAV or point that the user chooses.
 * @returns the panel for flights by hand, if there is one, and a function that brings all panels up to date.
 */
function placePanels(places, order, choose) {
  const fleet = fleetPanel(data.onUav);
  const panels = [chosenPanel(() => choose({uav: chosen.uav, through: !chosen.through}), () => choose({})), pointsPanel(data.onPoint), linksPanel(), eventsPanel(), uavFaultsPanel(), faultsPanel()];
  const hand = handPanel(order, (uav, through) => choose({uav, through}));
  places.side.prepend(...(hand ? [hand.element] : []), panels[0].element, panels[4].element, fleet.element);
  const [morePoints, moreLinks] = isPair() ? [pointsPanel(null, 1), linksPanel(1)] : [];
  if (isPair()) panels.push(morePoints, moreLinks);
  const losses = flights.map(lossesPanel);
  panels.push(...losses);
  places.side.append(panels[1].element, ...(isPair() ? [morePoints.element] : []), ...losses.map((one) => one.element));
  places.couple.append(panels[2].element, ...(isPair() ? [moreLinks.element] : []), panels[5].element, panels[3].element);
  const showPanels = () => {
    fleet.show(chosen.uav);
    for (const one of panels) one.show(chosen);
  };
  return {hand, showPanels};
}

/** @returns figures about the page, for measurements (figures.js). @param scene  undefined: there is no scene. */
function figuresOf(scene) {
  return {
    end: data.end, shown: scene?.shown ?? moment.seconds, points: data.points.length / 9, capturesKept: flights.reduce((sum, flight) => sum + flight.kept(), 0),
    otherModes: data.uavs.flatMap((_, uav) => otherModes(data.saidBy(uav))),
    losses: Object.fromEntries(flights[0].lossesAt(Infinity)?.losses ?? []),
    trailSegments: scene?.trails.reduce((sum, {ends}) => sum + ends.length, 0) ?? 0,
    trailsUntil: Math.min(...(scene?.trails ?? []).map(({ends}) => ends.at(-1) ?? 0)),  // [s]
  };
}

async function show(order) {
  setOrderFunction(order);
  const places = frame(order);
  data.describe = describe;
  let scene;
  const choose = ({uav = -1, point = -1, through = false}) => {
    Object.assign(chosen, {uav, point, through});
    address.write();
    scene?.follow(uav, through);
    showPanels();
  };
  data.onUav = (uav) => choose({uav: uav === chosen.uav ? -1 : uav});
  data.onPoint = (point) => choose({point});
  const [{sceneView}, {scoreChart, lanesChart}] = [await import('./scene_view.js'), await import('./charts.js')];
  const {hand, showPanels} = placePanels(places, order, choose);
  let due = 0;
  let later = 0;
  const showPanelsDue = () => {
    later = 0;
    due = performance.now() + kPanels;
    showPanels();
    address.write();
  };
  moment.listen(() => {
    showHead();
    hand?.show();
    const wait = due - performance.now();
    if (wait <= 0) showPanelsDue();
    else if (later === 0) later = setTimeout(showPanelsDue, wait);
  });
  scene = sceneView(places.scene);
  isPictureFinished = () => scene?.isFinished() ?? true;
  addFigures(() => figuresOf(scene));
  scoreChart(places.score);
  lanesChart(places.lanes);
  showHead();
  showPanels();
  document.addEventListener('keydown', (event) => event.key === 'Escape' && choose({}));
  if (isPair()) completePair(scene, () => {
    scene.painted = null;
    scene.show();
    showPanels();
  });
  growth.tell();
  watchEye(scene);
  const open = () => {
    address.shown = true;
    const {time, ...what} = address.read();
    readEye();
    if (Number.isFinite(time)) moment.set(time);
    if (what.uav >= 0 || what.point >= 0) choose(what);
    return {time};
  };
  open();
  addEventListener('hashchange', open);
  scene?.controls.addEventListener('end', () => address.write());
  if (keptFlight !== null) offerFilm(open, showPanels);
}

let isPictureFinished = () => true;
let begun = false;
let ready = Promise.resolve();
const keptFlight = document.getElementById('kept');
const follow = keptFlight === null ? connect : (use) => tellKept(keptFlight, use);
const order = follow({
  scene(told) {
    // Another program serves the run now: the launcher, which serves the replay, or a restarted station.
    if (begun) return location.reload();
    begun = true;
    live = true;
    begin(told);
    data.ask = (text) => order(text);
    if (told.mode === 'replay') return;  // shown when all lines have arrived
    ready = show((text) => order(text));
  },
  lines(lines, more) {
    tell(lines);
    if (more) return;
    if (data.mode === 'replay' && !main.querySelector('.bar')) ready = show(() => {});
    ready.then(grow);
  },
  state(state) {
    stand(state);
    ready.then(grow);
  },
  clouds(clouds) {
    takeClouds(clouds);
    ready.then(grow);
  },
  gone() {
    live = false;
    if (begun && main.querySelector('.bar')) showHead();
  },
});

let waiting = false;
/** Draws new data at most once per picture of the screen; without a graphics card, drawing may take a second. */
function grow() {
  if (waiting) return;
  waiting = true;
  const draw = () => {
    if (!isPictureFinished()) return requestAnimationFrame(draw);
    waiting = false;
    growth.tell();
    document.body.dataset.live = 'yes';
  };
  requestAnimationFrame(draw);
}
