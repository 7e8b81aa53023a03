// Checks that a flight shows all deliveries of a station that was restarted: their lines, from its journal, come before
// those of the captures. Needs no browser. Prints each problem as a line; prints nothing if all is well.
// usage: node deliveries.mjs
import {register} from 'node:module';

// The flight draws nothing, so neither a document nor Three.js is needed.
globalThis.document = {getElementById: () => null};
globalThis.matchMedia = () => ({addEventListener() {}});
const noSayings = 'data:text/javascript,export const makeSayings = () => ({take() {}, at() {}, of() {}});';
register(`data:text/javascript,${encodeURIComponent(`
  export const resolve = (name, context, next) => name.endsWith('/activity.js') ?
      {url: ${JSON.stringify(noSayings)}, shortCircuit: true} : next(name, context);`)}`);
const {makeFlight} = await import('../../web/src/flight.js');

const expect = (good, what) => good || console.log(what);

/** The flight of one UAV, after these batches of lines. */
function flown(...batches) {
  const data = {};
  const flight = makeFlight(data);
  flight.begin({uavs: [{name: 'alpha'}], points: new Array(2 * 9).fill(0)});
  batches.forEach((lines) => flight.tell(lines));
  const [{undelivered, waiting}] = data.uavs;
  return {undelivered, waiting, delivered: flight.pointsAt(data.end).states.delivered.points};
}

const delivered = (t, ...captures) => ({k: 'delivered', t, d: captures.flatMap((capture) => [0, capture])});
const capture = (t, number) => ({k: 'capture', t, u: 0, c: number, p: [number, 900000, 1000, 900]});
const score = (t, n) => ({k: 'score', t, n, s: 0.9 * n});
const backlog = [capture(1, 0), capture(5, 1), score(3, 1), score(6, 2)];
for (const [name, batches] of Object.entries({
  'in one batch': [[delivered(3, 0), delivered(6, 1), ...backlog]],
  'in two batches': [[delivered(3, 0), delivered(6, 1)], backlog],
  'split between captures': [[delivered(3, 0), delivered(6, 1), backlog[0]], backlog.slice(1)],
})) {
  const found = flown(...batches);
  expect(found.undelivered === 0, `${name}: ${found.undelivered} captures count as not delivered`);
  expect(found.delivered === 2, `${name}: ${found.delivered} points are shown as delivered`);
  expect(found.waiting.t.every((time, i, all) => i === 0 || all[i - 1] <= time),
      `${name}: the curve of undelivered captures goes back in time: ${found.waiting.t}`);
}
expect(flown([delivered(3, 0)]).undelivered === 0, 'a delivery without its capture counts');
