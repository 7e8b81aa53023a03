// The flights that the page shows: one, or two on one clock. Scene, charts and panels use the functions of this file,
// with a UAV's number on the page: the UAVs of the second fleet follow those of the first. A flight itself numbers its
// own fleet.
import {makeFlight} from './flight.js';
import {data} from './page.js';

export {kLinks} from './flight.js';

/** The names of two flights. */
export const kRuns = ['A', 'B'];

export let flights = [makeFlight(data)];
/** Which runs are drawn; and the run whose score the points show. */
export const drawn = {runs: [true, true], points: 0};

export const isPair = () => flights.length > 1;

function whose(uav) {
  const first = flights[0].data.uavs.length;
  return uav < first ? [flights[0], uav] : [flights[1], uav - first];
}

/** @returns a function of a UAV of the page that calls the function of this name of its flight. */
const ofUav = (name) => (uav, ...rest) => {
  const [flight, own] = whose(uav);
  return flight[name](own, ...rest);
};
export const doing = ofUav('doing');
export const linkOf = ofUav('linkOf');
export const poseAt = ofUav('poseAt');
const saidAt = ofUav('saidAt');
const saidBy = ofUav('saidBy');

/** @returns by UAV of the page: its share of the score, and its undelivered captures. */
export const sharesAt = (time) => flights.flatMap((flight) => flight.sharesAt(time));

/** @returns the events of all flights; for two flights, `run` names the flight of each event. */
export function allEvents() {
  if (!isPair()) return flights[0].events;
  return flights.flatMap(({events}, k) => events.map((event) => ({...event, run: kRuns[k]})));
}

/** @returns the links of both fleets as those of one; there are none between the fleets. */
function pairedLinksAt(time) {
  const sizes = flights.map((flight) => flight.data.uavs.length);
  const nodes = 1 + sizes[0] + sizes[1];
  const digits = new Array(nodes * nodes).fill('0');
  flights.forEach((flight, k) => {
    const told = drawn.runs[k] ? flight.linksAt(time) : '';
    const place = (node) => (node === 0 ? 0 : node + (k === 0 ? 0 : sizes[0]));
    const own = sizes[k] + 1;
    for (let i = 0; i < told.length; ++i) digits[place(Math.floor(i / own)) * nodes + place(i % own)] = told[i];
  });
  return digits.join('');
}

/**
 * @returns a UAV of one of two flights for the page: it inherits from the flight's UAV, and its name begins with the
 * run's.
 */
const seenIn = (k, uav, own) => Object.create(uav, {name: {value: `${kRuns[k]} ${uav.name}`}, own: {value: own}, run: {value: k}});

function beginPair({other, ...first}) {
  flights = [first, other].map((scene) => {
    const flight = makeFlight({end: 0});
    flight.begin(scene);
    return flight;
  });
  const faults = JSON.stringify(first.faults) === JSON.stringify(other.faults) ? first.faults : [...first.faults, ...other.faults];
  Object.assign(data, first, {
    end: 0,
    runs: flights.map((flight) => flight.data),
    uavs: flights.flatMap((flight, k) => flight.data.uavs.map((uav, own) => seenIn(k, uav, own))),
    faults,
    causes_known: false,  // the causes of losses are known only for each flight by itself
    best: [],
    collisions: [...first.collisions, ...other.collisions],
    custody: (point, time) => flights[drawn.points].custody(point, time),
    linksAt: pairedLinksAt,
    saidAt: (uav, ...rest) => (drawn.runs[data.uavs[uav].run] ? saidAt(uav, ...rest) : null),
    saidBy,
    failures: flights[0].failures,
    poseAt: (uav, ...rest) => (drawn.runs[data.uavs[uav].run] ? poseAt(uav, ...rest) : null),
  });
}

/** Fills the data of scene and charts from the scene of one flight, or of two. */
export function begin(scene) {
  if (scene.other)
    beginPair(scene);
  else
    flights[0].begin(scene);
}

/** Takes lines. Those of the second flight arrive as {"k": "other", "line": ...}. */
export function tell(lines) {
  if (!isPair()) return flights[0].tell(lines);
  for (const line of lines) {
    if (line.k === 'other')
      flights[1].tell([line.line]);
    else
      flights[0].tell([line]);
  }
  data.end = Math.max(...flights.map((flight) => flight.data.end));
}

/** Takes the newest state of a live flight. A page never follows two live flights. */
export const stand = (state) => flights[0].stand(state);
