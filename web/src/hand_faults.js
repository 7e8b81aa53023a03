// Shows the faults of the run, and lets a viewer begin and end faults by hand. To do so, the page sends an order
// (view/fault_order.hpp). An order takes effect in the next step; the next state says whether the server accepted it.
import {data, element, moment} from './page.js';

const kMostRows = 60;
// The station serves this page. So while the station is killed or paused, a viewer cannot end this fault; it ends by
// itself after this time.
const kStationFault_s = 5;
const kStation = 'gcs';  // name of its node; its program is called station

// order: sends an order; connected: whether a server receives orders; refusedBefore: number of orders that the server
// had refused before the newest one.
const hand = {order: () => {}, connected: false, refusedBefore: null};

/**
 * Enters the begin or end of a fault, from a line of the kind "fault" (view/story.hpp), into a list. @param faults  one
 * entry for each fault that has begun: its number, byHand (a viewer began the fault), kind, of (its target), from and
 * until [s].
 */
export function recordFault(faults, {t, n, hand: byHand, on, kind, of}) {
  if (on === 1) faults.push({number: n, byHand: byHand === 1, kind, of, from: t, until: Infinity});
  const open = faults.find((one) => one.number === n && one.byHand === (byHand === 1) && one.until === Infinity);
  if (on === 0 && open !== undefined) open.until = t;
}

/** @param order  function that sends an order. */
export function setOrderFunction(order) {
  hand.order = order;
}

/** @param connected  whether a server receives orders. */
export function setConnected(connected) {
  hand.connected = connected;
}

const openByHand = () => data.now?.faults?.open ?? [];
const openOf = (kind, of) => openByHand().find((one) => one.kind === kind && one.of === of);
/** Faults begin now, so a viewer cannot begin one while the page shows the past. */
const mayAct = () => data.mode === 'live' && hand.connected && moment.newest;

function ask(order) {
  hand.refusedBefore = data.now?.faults?.refused ?? 0;
  hand.order(order);
}
const begin = (kind, of, more = {}) => ask({do: 'fault', kind, ...(of === null ? {} : {of}), ...more});
const end = (number) => ask({do: 'end_fault', fault: number});

function setButton(button, text, title, disabled) {
  if (button.textContent !== text) button.textContent = text;
  if (button.title !== title) button.title = title;
  button.disabled = disabled;
}

// ---- the link matrix --------------------------------------------------------------------------------------------

const nodeName = (node) => (node === 0 ? kStation : data.uavs[node - 1].name);
const shownName = (node) => (node === 0 ? 'station' : data.uavs[node - 1].name);
const cutOf = (from, to) => openOf('link', `${nodeName(from)} > ${nodeName(to)}`);

function toggleLink(from, to) {
  const cut = cutOf(from, to);
  if (cut !== undefined) return end(cut.n);
  ask({do: 'fault', kind: 'link', from: nodeName(from), to: nodeName(to)});
}

/** @returns a cell of the matrix: a click cuts the link or restores it; with Shift, also in the other direction. */
export function linkButton(from, to) {
  const button = element('button', {type: 'button', class: 'l l0', disabled: '', 'data-from': from, 'data-to': to});
  button.addEventListener('click', (event) => {
    const heals = cutOf(from, to) !== undefined;
    toggleLink(from, to);
    if (event.shiftKey && heals === (cutOf(to, from) !== undefined)) toggleLink(to, from);
  });
  return button;
}

/** @param kind  state of the link: a digit of kLinks. @param text  the same state in words. */
export function showLinkButton(button, from, to, kind, text) {
  const cut = cutOf(from, to);
  const waits = cut !== undefined && !cut.begun;
  button.className = `l l${kind}${waits ? ' waits' : ''}`;
  button.disabled = !mayAct();
  const what = cut === undefined ? 'Click to cut it' : waits ? 'It is cut in the next step; click to cancel' : 'Cut by hand; click to restore it';
  const title = `${shownName(from)} to ${shownName(to)}: ${text}${button.disabled ? '' : `. ${what} (with Shift: both directions)`}`;
  if (button.title === title) return;
  button.title = title;
  button.setAttribute('aria-label', title);
}

// ---- faults of one UAV ----------------------------------------------------------------------------------------------

/** For each fault: its kind, and the texts of its button while it would begin the fault, and while it would end it. */
const kUavFaults = [
  ['kill', 'Kill its program', 'Restart its program'],
  ['pause', 'Pause its program', 'Resume its program'],
  ['blackout', 'Cut its radio', 'Restore its radio'],
  ['camera_failure', 'Disable its camera', 'Restore its camera'],
  ['lidar_failure', 'Disable its LiDAR', 'Restore its LiDAR'],
  ['stuck_gimbal', 'Block its gimbal', 'Release its gimbal'],
  ['odometry_freeze', 'Freeze its odometry', 'Restore its odometry'],
];

function toggle(kind, of, begins, ends, more = {}) {
  const button = element('button', {type: 'button', 'data-fault': kind, 'data-of': of ?? ''}, begins);
  const name = of ?? kStation;
  button.addEventListener('click', () => {
    const open = openOf(kind, name);
    if (open !== undefined) return end(open.n);
    begin(kind, of, more);
  });
  const show = () => {
    const open = openOf(kind, name);
    const other = {kill: 'pause', pause: 'kill'}[kind];
    const taken = other !== undefined && openOf(other, name) !== undefined;
    const waits = open !== undefined && !open.begun;
    setButton(button, open === undefined ? begins : waits ? `Cancel: ${begins}` : ends,
              waits ? 'begins with the next step' : `takes effect in the next step (${kind})`, !mayAct() || taken);
    button.setAttribute('aria-pressed', String(open !== undefined));
  };
  return {button, show};
}

function selectOf(label, values, chosen) {
  return element('select', {'aria-label': label},
                 ...values.map(([value, text]) => element('option', value === chosen ? {value, selected: ''} : {value}, text)));
}

/** @returns the panel with the faults of the chosen UAV. */
export function uavFaultsPanel() {
  const title = element('h2', {}, '');
  const row = element('div', {class: 'tools-row'});
  const made = element('section', {class: 'panel', id: 'uav-faults'}, title, row);
  made.hidden = true;
  let [shown, parts] = [-1, []];
  const build = (uav) => {
    const {name, explorer} = data.uavs[uav];
    title.textContent = `Inject faults into ${name}`;
    parts = kUavFaults.filter(([kind]) => explorer || kind !== 'lidar_failure').map(([kind, ...texts]) => toggle(kind, name, ...texts));
    const rotor = selectOf('rotor', [0, 1, 2, 3, 4, 5].map((i) => [i, `rotor ${i}`]), 0);
    const thrust = selectOf('remaining thrust', [[0, 'no thrust'], [0.25, '25 %'], [0.5, '50 %'], [0.75, '75 %']], 0.5);
    const weaken = element('button', {type: 'button', 'data-fault': 'motor_failure'}, 'Weaken');
    weaken.addEventListener('click', () => begin('motor_failure', name, {rotor: Number(rotor.value), thrust: Number(thrust.value)}));
    const delay = selectOf('delay', [[4, '0.2 s'], [10, '0.5 s'], [20, '1 s']], 4);
    const late = element('button', {type: 'button', 'data-fault': 'command_delay'}, 'Delay its commands by');
    late.addEventListener('click', () => begin('command_delay', name, {exchanges: Number(delay.value)}));
    parts.push({show: () => {
      for (const one of [rotor, thrust, weaken, delay, late]) one.disabled = !mayAct();
    }});
    row.replaceChildren(...parts.flatMap(({button}) => button ?? []),
                        element('span', {class: 'joint'}, weaken, rotor, thrust), element('span', {class: 'joint'}, late, delay));
  };
  const show = ({uav}) => {
    made.hidden = uav < 0 || data.mode !== 'live';
    if (made.hidden) return;
    if (uav !== shown) build(uav);
    shown = uav;
    for (const part of parts) part.show();
  };
  return {element: made, show};
}

// ---- all faults ----------------------------------------------------------------------------------------------------

const kKinds = {
  link: 'link', partition: 'partition', blackout: 'radio blackout', station_outage: 'radio outage', kill: 'killed',
  pause: 'paused', lidar_failure: 'LiDAR fails', camera_failure: 'camera fails', motor_failure: 'rotor weak',
  command_delay: 'commands late', odometry_freeze: 'odometry frozen', odometry_jump: 'odometry jumped', stuck_gimbal: 'gimbal stuck',
  gust: 'gust', fix_loss: 'position fix lost', battery_loss: 'battery loses charge', conditions: 'conditions change',
};
const targetText = ({kind, of}) => (kind === 'link' ? of.replaceAll(kStation, 'station').replace(' > ', ' to ') : of === kStation ? 'station' : of);

/**
 * @returns the faults at the moment that the page shows: first those that begin with the next step, then those in force,
 * then those in the past; the newest first.
 */
function rows() {
  const now = moment.seconds;
  const open = openByHand();
  const waiting = moment.newest ? open.filter(({begun}) => !begun) : [];
  const known = (data.failures ?? []).filter(({from}) => from <= now).map((one) => ({...one, over: one.until <= now}));
  known.sort((a, b) => a.over - b.over || b.from - a.from);
  const seconds = (time) => time.toFixed(2);
  const list = waiting.map((one) => ({
    key: `${one.n}`, text: `${kKinds[one.kind] ?? one.kind}`, of: targetText(one), when: 'begins with the next step', state: 'waits',
    ends: one.n, label: 'Cancel',
  }));
  for (const one of known.slice(0, kMostRows)) {
    const byHand = one.byHand && moment.newest ? open.find(({n}) => n === one.number) : undefined;
    const ending = data.mode === 'live' && one.byHand && moment.newest && !one.over && byHand === undefined;
    const until = byHand?.until !== undefined ? `, until ${seconds(byHand.until)} s` : '';
    list.push({
      key: `${one.byHand ? '' : 'f'}${one.number}`, text: kKinds[one.kind] ?? one.kind, of: targetText(one),
      when: one.over ? `${seconds(one.from)} to ${seconds(one.until)} s` :
          ending ? `since ${seconds(one.from)} s; ends with the next step` : `since ${seconds(one.from)} s${until}`,
      state: one.over ? 'over' : 'on', ends: one.over ? undefined : byHand?.n, label: 'End', byHand: one.byHand,
    });
  }
  return list;
}

function rowOf({key, text, of, when, state, ends, label, byHand}) {
  const button = element('button', {type: 'button', 'data-end': key}, label ?? '');
  button.addEventListener('click', () => end(ends));
  button.disabled = !mayAct();
  return element('li', {class: state}, element('div', {}, element('strong', {}, text), ' ', of, element('div', {class: 'soft'}, when)),
                 ends === undefined ? element('span', {class: 'soft'}, byHand === false ? 'fault file' : '') : button);
}

/**
 * @returns the panel with all faults. Here, viewers can end the faults that a viewer began, and kill or pause the
 * programs that belong to no UAV.
 */
export function faultsPanel() {
  const parts = [
    toggle('kill', 'station', `Kill the station for ${kStationFault_s} s`, 'Restart the station', {for_s: kStationFault_s}),
    toggle('pause', 'station', `Pause the station for ${kStationFault_s} s`, 'Resume the station', {for_s: kStationFault_s}),
    toggle('station_outage', null, 'Cut the station\'s radio', 'Restore the station\'s radio'),
    toggle('kill', 'comm_router', 'Kill the radio router', 'Restart the radio router'),
    toggle('pause', 'comm_router', 'Pause the radio router', 'Resume the radio router'),
  ];
  const buttons = element('div', {class: 'tools-row'}, ...parts.map(({button}) => button));
  const refused = element('p', {class: 'refused', role: 'status'}, '');
  const list = element('ol', {class: 'faults', 'aria-label': 'faults, those in force first'});
  const none = element('p', {class: 'soft'}, 'None so far.');
  const made = element('section', {class: 'panel', id: 'faults'}, element('h2', {}, 'Faults'),
                       ...(data.mode === 'live' ? [buttons, refused] : []), none, list);
  let shown = '';
  const show = () => {
    for (const part of parts) part.show();
    const now = data.now?.faults;
    hand.refusedBefore ??= now?.refused ?? null;
    const text = now !== undefined && hand.refusedBefore !== null && now.refused > hand.refusedBefore ? `The server refused this: ${now.why}.` : '';
    if (refused.textContent !== text) refused.textContent = text;
    const all = rows();
    none.hidden = all.length > 0;
    const key = JSON.stringify([all, mayAct()]);
    if (key === shown) return;
    shown = key;
    const focused = list.contains(document.activeElement) ? document.activeElement.dataset.end : undefined;
    list.replaceChildren(...all.map(rowOf));
    if (focused !== undefined) list.querySelector(`[data-end="${focused}"]`)?.focus();
  };
  return {element: made, show};
}
