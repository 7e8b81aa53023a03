// Checks which part of the quality the page names for points that are photographed too poorly. Needs no browser. Prints
// each problem as a line; prints nothing if all is well.
// usage: node poor.mjs
import {makeCustody, weakestPart} from '../../web/src/custody.js';

const expect = (good, what) => good || console.log(what);
const uav = {name: 'alpha', voided: Infinity};

/** Qualities of a point in a capture as a line of the flight has them (view/story.hpp); each part is from 0 to 1. */
const told = ({distance, tilt, blur}) =>
    [Math.round(1e6 * distance * tilt * blur), Math.round(1e3 * blur), Math.round(1e3 * distance)];

/** The tally of a flight in which each of the points is in one capture. */
function tallyOf(points) {
  const custody = makeCustody({uavs: [uav], end: 10});
  custody.beginPoints(points.length);
  points.forEach((point, i) => custody.take({t: i, u: 0, c: i, p: [i, ...told(point)]}));
  return {custody, tally: custody.tallyAt(10)};
}

const far = {distance: 0.15, tilt: 0.9, blur: 0.8}, askew = {distance: 0.9, tilt: 0.15, blur: 0.8};
const blurred = {distance: 0.9, tilt: 0.8, blur: 0.15}, good = {distance: 0.9, tilt: 0.9, blur: 0.9};
const {custody, tally} = tallyOf([far, askew, askew, blurred, blurred, blurred, good]);
expect(JSON.stringify(tally.poor) === '{"distance":1,"tilt":2,"blur":3}',
    `the tally of poor points is ${JSON.stringify(tally.poor)}`);
expect(tally.states.poor.points === 6 && tally.states.carried.points === 1, `states: ${JSON.stringify(tally.states)}`);
const early = custody.tallyAt(2).poor;
expect(JSON.stringify(early) === '{"distance":1,"tilt":2,"blur":0}',
    `after 2 s, the tally of poor points is ${JSON.stringify(early)}`);
custody.take({t: 9, u: 0, c: 9, p: [0, ...told(good)]});
expect(custody.tallyAt(10).poor.distance === 0, 'a point that a later capture shows well is still counted as poor');
expect(weakestPart(custody.custody(3, 10).taken) === 'blur',
    'the page does not name the weakest part of a chosen point');
expect(weakestPart({blur: 0, res: 0, distance: 0.9}) === 'blur',
    'a picture that is fully blurred must not count as one without resolution');
