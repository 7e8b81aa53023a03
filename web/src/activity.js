// The activity of each UAV and the reason for it, as the UAV reports them (topic /{id}/activity): stores the reports,
// looks them up by time, and draws a line to the goal into the scene. For a UAV that reports nothing, flight.js derives
// its activity from its motion.
import * as THREE from 'three';

import {kMostSayings, thin} from './history.js';
import {kDashes, Segments} from './overlays.js';
import {colour, data, element, indexAt, moment, trackColour} from './page.js';

const kCross = 0.9;  // [m]; half the size of the cross at the goal

/** Stores the activity reports of the UAVs of a flight. */
export function makeSayings() {
  const said = [];  // by UAV: {t: [], what: []}, times [s] and reports
  return {
    /** Takes a line of the kind "activity" (view/story.hpp). */
    take({t, u, m, g, w, n}) {
      while (said.length <= u) said.push({t: [], what: []});
      said[u].t.push(t);
      said[u].what.push({mode: m, goal: g && {x: g[0] / 100, y: g[1] / 100, z: g[2] / 100}, waitsFor: w, noWay: n, since: t});
      thin([said[u].t, said[u].what], kMostSayings);
    },
    /** @returns all reports of a UAV, {t, what}, ordered by time; null: there are none. */
    of: (index) => said[index] ?? null,
    /** @returns a UAV's last report up to a time; null: there is none. */
    at(index, time) {
      const at = said[index] === undefined ? -1 : indexAt(said[index].t, time);
      return at < 0 ? null : said[index].what[at];
    },
  };
}

/** @returns the last report of a UAV up to a time; null: there is none. @param uav  its number on the page. */
export const saidAt = (uav, time) => data.saidAt?.(uav, time) ?? null;

/** @returns the distance from a pose to the goal of a report [m]; null: pose or goal is missing. */
export const toGoal = (what, pose) => what?.goal && pose ?
    Math.hypot(what.goal.x - pose.x, what.goal.y - pose.y, what.goal.z - pose.z) : null;

/**
 * @returns the numbers that a UAV reports about itself: speed [m/s], undelivered captures, CPU time per simulated second
 * [ms]; null: it reports none, or the page does not show the newest moment, for which alone they are known.
 */
export function numbersOf(index) {
  const now = moment.newest ? data.now?.a?.[index] : null;
  return now ? {speed: now[0] / 100, undelivered: now[1], cpu: now[2]} : null;
}

/** @returns in words for whom a UAV waits, and why it has found no path; empty: neither applies. */
export function whyOf(what) {
  if (what === null) return '';
  return [what.waitsFor && `waits for ${what.waitsFor}`, what.noWay && `no way: ${what.noWay}`].filter(Boolean).join('; ');
}

/** Shows an activity in a cell of a table, and the reason below it. */
export function showDoes(cell, text, what) {
  const why = whyOf(what);
  const key = `${text}\n${why}`;
  if (cell.dataset.key === key) return;
  cell.dataset.key = key;
  cell.replaceChildren(text, ...(why ? [element('small', {class: 'why'}, why)] : []));
}

/** @returns the rows about a UAV's activity for its panel: [name, text]. */
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
    ['waits for', what.waitsFor || 'no UAV'],
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
