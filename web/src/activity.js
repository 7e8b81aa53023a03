// What each UAV says that it does, and why (topic /{id}/activity): kept as it is told, asked for any moment, and drawn
// into the scene as a line to its goal. A UAV that says nothing has none; then flight.js goes by its motion.
import * as THREE from 'three';

import {kMostSayings, thin} from './history.js';
import {kDashes, Segments} from './overlays.js';
import {colour, data, element, indexAt, moment, trackColour} from './page.js';

const kCross = 0.9;  // m, at the goal

/** What the UAVs of a flight said. */
export function makeSayings() {
  const said = [];  // by UAV: {t: [], what: []}
  return {
    /** A line of the flight. */
    take({t, u, m, g, w, n}) {
      while (said.length <= u) said.push({t: [], what: []});
      said[u].t.push(t);
      said[u].what.push({mode: m, goal: g && {x: g[0] / 100, y: g[1] / 100, z: g[2] / 100}, waitsFor: w, noWay: n, since: t});
      thin([said[u].t, said[u].what], kMostSayings);
    },
    /** All that a UAV said: {t, what}, in order; null: nothing. */
    of: (index) => said[index] ?? null,
    /** What a UAV said last; null: nothing so far. */
    at(index, time) {
      const at = said[index] === undefined ? -1 : indexAt(said[index].t, time);
      return at < 0 ? null : said[index].what[at];
    },
  };
}

/** What a UAV of the page said last; null: nothing so far. */
export const saidAt = (uav, time) => data.saidAt?.(uav, time) ?? null;

/** How far it is from a pose to what was said as its goal [m]; null: it has none. */
export const toGoal = (what, pose) => what?.goal && pose ?
    Math.hypot(what.goal.x - pose.x, what.goal.y - pose.y, what.goal.z - pose.z) : null;

/** Its own numbers, as of now; null: it says none, or the page shows another moment. */
export function numbersOf(index) {
  const now = moment.newest ? data.now?.a?.[index] : null;
  return now ? {speed: now[0] / 100, undelivered: now[1], cpu: now[2]} : null;
}

/** Why it does that, in words; empty: nothing holds it. */
export function whyOf(what) {
  if (what === null) return '';
  return [what.waitsFor && `waits for ${what.waitsFor}`, what.noWay && `no way: ${what.noWay}`].filter(Boolean).join('; ');
}

/** What it does, and below that why. */
export function showDoes(cell, text, what) {
  const why = whyOf(what);
  const key = `${text}\n${why}`;
  if (cell.dataset.key === key) return;
  cell.dataset.key = key;
  cell.replaceChildren(text, ...(why ? [element('small', {class: 'why'}, why)] : []));
}

/** For the panel of one UAV. */
export function factsOfActivity(index, pose) {
  const what = saidAt(index, moment.seconds);
  if (what === null) return [];
  const {goal} = what;
  const far = toGoal(what, pose);
  const cpu = numbersOf(index)?.cpu ?? null;
  return [
    ['since', `${what.since.toFixed(1)} s`],
    ['goal', goal === null ? 'none' :
         `${[goal.x, goal.y, goal.z].map((v) => v.toFixed(1)).join(', ')} m${far === null ? '' : `, ${far.toFixed(1)} m away`}`],
    ['waits for', what.waitsFor || 'nobody'],
    ...(what.noWay ? [['no way', what.noWay]] : []),
    ...(cpu === null ? [] : [['CPU', `${cpu} ms for a simulated second`]]),
  ];
}

/** Dashed lines from UAVs to their goals. */
export function makeGoals(bodies) {
  const segments = new Segments((kDashes + 3) * data.uavs.length, 1.4, 0.9);
  let colours = [];
  const place = ({x, y, z}) => new THREE.Vector3(x, y, z);
  return {
    object: segments.object,
    paint: () => (colours = data.uavs.map((_, uav) => new THREE.Color(colour(trackColour(uav))))),
    show(seconds) {
      segments.begin();
      bodies.forEach((body, uav) => {
        const goal = saidAt(uav, seconds)?.goal;
        const {collided} = data.uavs[uav];
        if (!goal || !body.visible || (collided !== null && collided <= seconds)) return;
        const to = place(goal);
        segments.addDashed(body.position, to, colours[uav]);
        for (const axis of [new THREE.Vector3(kCross, 0, 0), new THREE.Vector3(0, kCross, 0), new THREE.Vector3(0, 0, kCross)])
          segments.add(to.clone().sub(axis), to.clone().add(axis), colours[uav]);
      });
      segments.end();
    },
  };
}
